//! items and a plane -> the same items, those left of it first

use rayon::prelude::*;

use super::Bounds;
use super::bins::Plane;
use super::split::{CHUNK, Item};

/// How many lie left, and around twice the middles on each side.
pub(super) struct Sides {
    pub(super) left: usize,
    pub(super) middles: [Bounds; 2],
}

/// Sorts items by their side.
pub(super) fn sort(items: &mut [Item], plane: &Plane) -> Sides {
    if items.len() < 2 * CHUNK {
        return sort_some(items, plane);
    }
    // Each chunk by itself; then what stands on the wrong side changes places.
    let chunks: Vec<Sides> = items.par_chunks_mut(CHUNK).map(|items| sort_some(items, plane)).collect();
    let left: usize = chunks.iter().map(|sides| sides.left).sum();
    let middles = [0, 1].map(|side| chunks.iter().fold(Bounds::NOTHING, |all, one| all.join(one.middles[side])));
    let (mut wrong_right, mut wrong_left): (Vec<&mut [Item]>, Vec<&mut [Item]>) = (Vec::new(), Vec::new());
    for (i, (own, sides)) in items.chunks_mut(CHUNK).zip(&chunks).enumerate() {
        let begin = i * CHUNK;
        let (lefts, rights) = own.split_at_mut(sides.left);
        // Lefts at or beyond `left`, rights before it.
        let (_, wrong) = lefts.split_at_mut(left.saturating_sub(begin).min(sides.left));
        wrong_left.push(wrong);
        let room = left.saturating_sub(begin + sides.left).min(rights.len());
        wrong_right.push(rights.split_at_mut(room).0);
    }
    pairs(wrong_left, wrong_right).into_par_iter().for_each(|(a, b)| a.swap_with_slice(b));
    Sides { left, middles }
}

/// Slices of two lists that hold as many items, cut so that each has a partner of its length.
fn pairs<'a>(a: Vec<&'a mut [Item]>, b: Vec<&'a mut [Item]>) -> Vec<(&'a mut [Item], &'a mut [Item])> {
    let (mut a, mut b) = (a.into_iter(), b.into_iter());
    let (mut one, mut other): (&mut [Item], &mut [Item]) = (&mut [], &mut []);
    let mut pairs = Vec::new();
    loop {
        if one.is_empty() {
            let Some(next) = a.next() else { return pairs };
            one = next;
        } else if other.is_empty() {
            let Some(next) = b.next() else { return pairs };
            other = next;
        } else {
            let length = one.len().min(other.len());
            let ((one_now, one_later), (other_now, other_later)) =
                (one.split_at_mut(length), other.split_at_mut(length));
            pairs.push((one_now, other_now));
            (one, other) = (one_later, other_later);
        }
    }
}

fn sort_some(items: &mut [Item], plane: &Plane) -> Sides {
    let mut sides = Sides { left: 0, middles: [Bounds::NOTHING; 2] };
    // Every item is exchanged with the first on the right, be it left or not: no branch to be guessed wrong.
    for i in 0..items.len() {
        let item = items[i];
        let is_left = plane.is_left(&item);
        let own = &mut sides.middles[usize::from(!is_left)];
        *own = own.join(Bounds::at(item.0.middle()));
        items[i] = items[sides.left];
        items[sides.left] = item;
        sides.left += usize::from(is_left);
    }
    sides
}
