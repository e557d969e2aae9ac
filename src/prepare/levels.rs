//! a picture -> all its levels, made once for as long as anybody has the picture

use std::ptr::addr_eq;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use rayon::prelude::*;

use crate::film::Transfer;
use crate::scene::model::{Content, Texture};

/// Levels that were made, finest first, each row by row from the top.
struct Made {
    of: Weak<[[u8; 4]]>,
    size: [u32; 2],
    content: Content,
    transfer: Transfer,
    levels: Arc<[u32]>,
}

/// They take a third of what a small frame of a sequence takes on the host, and frames share their models.
static MADE: Mutex<Vec<Made>> = Mutex::new(Vec::new());

/// How many levels a picture has, each half as wide and high as the one before, down to one texel.
pub(super) fn count(texture: &Texture) -> u32 {
    texture.width.max(texture.height).max(1).ilog2() + 1
}

/// Every level of a picture as words, each texel the mean of four of the level before, in linear light.
pub(super) fn levels(texture: &Texture, transfer: Transfer) -> Arc<[u32]> {
    let transfer = if texture.content == Content::Color { transfer } else { Transfer::None };
    let (size, content) = ([texture.width, texture.height], texture.content);
    let lock = || MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut all = lock();
    all.retain(|made| made.of.strong_count() > 0);
    let same = |made: &&Made| {
        let picture = addr_eq(made.of.as_ptr(), Arc::as_ptr(&texture.texels)) && made.size == size;
        picture && made.content == content && made.transfer == transfer
    };
    if let Some(made) = all.iter().find(same) {
        return Arc::clone(&made.levels);
    }
    drop(all);
    let levels: Arc<[u32]> = make(texture, transfer).into();
    let of = Arc::downgrade(&texture.texels);
    lock().push(Made { of, size, content, transfer, levels: Arc::clone(&levels) });
    levels
}

fn make(texture: &Texture, transfer: Transfer) -> Vec<u32> {
    let curve: Vec<f32> = (0..=255).map(|byte| transfer.decode(byte)).collect();
    let (mut width, mut height) = (texture.width, texture.height);
    let mut all: Vec<u32> = Vec::new();
    let mut level: Vec<[u8; 4]> = texture.texels.to_vec();
    // Opacity is in alpha, or else in red.
    if texture.content == Content::Scalar && !texture.has_alpha {
        for texel in &mut level {
            texel[3] = texel[0];
        }
    }
    for left in (0..count(texture)).rev() {
        all.extend(level.iter().map(|t| u32::from_le_bytes(*t)));
        if left == 0 {
            break;
        }
        let (wide, high) = ((width / 2).max(1), (height / 2).max(1));
        let at = |x: u32, y: u32| level[(y.min(height - 1) * width + x.min(width - 1)) as usize];
        let mean = |x: u32, y: u32| {
            let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
            std::array::from_fn(|i| {
                let sum: f32 = four.iter().map(|t| curve[t[i] as usize]).sum();
                transfer.encode(sum * 0.25)
            })
        };
        let next = (0..wide * high).into_par_iter().map(|i| mean(i % wide * 2, i / wide * 2));
        level = next.collect();
        (width, height) = (wide, high);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(content: Content, texels: Arc<[[u8; 4]]>) -> Texture {
        Texture { file: String::new(), content, width: 5, height: 2, texels, has_alpha: false }
    }

    #[test]
    fn levels_are_made_once_for_each_use_of_a_picture() {
        let texels: Arc<[[u8; 4]]> = (0..10).map(|i| [i * 20, 255 - i, 7, 255]).collect();
        let color = texture(Content::Color, Arc::clone(&texels));
        let (first, again) = (levels(&color, Transfer::Srgb), levels(&color, Transfer::Srgb));
        assert!(Arc::ptr_eq(&first, &again));
        assert_eq!((count(&color), first.len()), (3, 10 + 2 + 1));
        let linear = levels(&texture(Content::Scalar, Arc::clone(&texels)), Transfer::Srgb);
        let plain = levels(&color, Transfer::None);
        assert!(linear != first && linear != plain, "other numbers, and opacity in alpha");
        assert!(linear.iter().zip(&*plain).all(|(a, b)| a & 0x00ff_ffff == b & 0x00ff_ffff), "of the same means");
        assert_eq!((linear[1] >> 24, plain[1] >> 24), (20, 255));
        // Another picture in the same place of memory would not be taken for this one.
        drop((color, texels));
        let other: Arc<[[u8; 4]]> = [[9; 4]; 10].into();
        assert!(levels(&texture(Content::Color, other), Transfer::Srgb).iter().all(|word| *word == 0x0909_0909));
    }
}
