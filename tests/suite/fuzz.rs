//! Any bytes as a scene: an error or a picture, never a panic. The long run: `TWINLIGHT_FUZZ_SECONDS=3600`,
//! and another one with `TWINLIGHT_FUZZ_SEED=2`.

use std::panic::catch_unwind;
use std::time::{Duration, Instant};

use twinlight::film::ledger::{Subject, written};
use twinlight::film::{Film, Run, Transfer, exr};

use super::{Dice, on_cpu, parsers, scenes, tables_of};

const WORDS: &[&str] = &[
    "nan",
    "inf",
    "-inf",
    "1e999",
    "-0.0",
    "1e-45",
    "9223372036854775807",
    "[",
    "]",
    "\"",
    "[[",
    "]]",
    "=",
    "{",
    "}",
    "\n",
    "#",
    "material",
    "[camera]",
    "[[object.sphere]]",
    "radius = 1\n",
    "true",
    "1979-05-27",
    "'''",
    "\"\"\"",
    "\\u",
    "\0",
    "\u{feff}",
    "🦀",
    "fov = 179\n",
    "depth = 32\n",
    "samples = 65536\n",
    "size = [1, 65536]\n",
    "0, 0, 0",
];

fn mutate(dice: &mut Dice, seeds: &[String]) -> Vec<u8> {
    let mut bytes = seeds[dice.below(seeds.len())].clone().into_bytes();
    for _ in 0..=dice.below(6) {
        let at = dice.below(bytes.len() + 1);
        match dice.below(6) {
            0 if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
            1 => drop(bytes.drain(at..(at + dice.below(40)).min(bytes.len()))),
            2 => drop(bytes.splice(at..at, WORDS[dice.below(WORDS.len())].bytes())),
            3 => bytes.truncate(at),
            4 => {
                let from = dice.below(bytes.len() + 1);
                let piece = bytes[from..(from + dice.below(60)).min(bytes.len())].to_vec();
                drop(bytes.splice(at..at, piece));
            }
            _ => {
                let end = (at + 4).min(bytes.len());
                let number = format!("{}e{}", dice.within(-9.0, 9.0), dice.below(80) as i32 - 40);
                drop(bytes.splice(at..end, number.bytes()));
            }
        }
    }
    bytes
}

fn seconds() -> u64 {
    std::env::var("TWINLIGHT_FUZZ_SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(4)
}

/// Of a run of one's own, which sees other inputs than the short one.
fn own_seed() -> u32 {
    let own = std::env::var("TWINLIGHT_FUZZ_SEED").ok().and_then(|s| s.parse().ok());
    own.unwrap_or(u32::from(seconds() > 4))
}

#[test]
fn no_text_makes_it_panic_or_hang() {
    let seconds = seconds();
    let seeds: Vec<_> = scenes().iter().map(|p| std::fs::read_to_string(p).expect("a scene")).collect();
    let (mut tried, mut rendered) = (0_u64, 0_u64);
    let end = Instant::now() + Duration::from_secs(seconds);
    let mut dice = Dice(own_seed(), 0);
    while Instant::now() < end {
        let bytes = mutate(&mut dice, &seeds);
        let Ok(text) = String::from_utf8(bytes) else { continue };
        let start = Instant::now();
        let outcome = catch_unwind(|| {
            parsers::scene(text.as_bytes()).is_some_and(|mut scene| {
                scene.resize([3, 2]).expect("six pixels fit");
                scene.trace.samples = 1;
                scene.trace.depth = scene.trace.depth.min(4);
                let film = on_cpu(&tables_of(&scene));
                film.to_rgb8(scene.film.transfer).width() == 3
            })
        });
        let picture = outcome.unwrap_or_else(|_| panic!("this text panics:\n{text}"));
        rendered += u64::from(picture);
        assert!(start.elapsed() < Duration::from_secs(2), "this text takes {:?}:\n{text}", start.elapsed());
        tried += 1;
    }
    println!("{tried} scenes, {rendered} rendered");
    assert!(tried > 100 && rendered > 10, "{tried} tried, {rendered} rendered: that is no fuzzing");
}

/// Bytes with a few of them changed, left out or doubled.
fn bend(dice: &mut Dice, seed: &[u8]) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=dice.below(4) {
        let at = dice.below(bytes.len() + 1);
        let end = (at + dice.below(9)).min(bytes.len());
        match dice.below(4) {
            0 if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
            1 => bytes[at..end].fill([0, 255, 127][dice.below(3)]),
            2 => drop(bytes.drain(at..end)),
            _ => {
                let piece = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, piece));
            }
        }
    }
    bytes
}

#[test]
fn no_file_of_our_own_makes_it_panic_when_it_is_bent() {
    let subject = Subject {
        stamp: "s".to_owned(),
        width: 3,
        columns: 0..3,
        rows: 0..2,
        samples: 2,
        transfer: Transfer::None,
        from: 0,
        to: 2,
    };
    let mut run = Run::new(0..6, 0);
    run.add(2, &[[1.0; 4]; 6], &[0.5; 6], &[7; 6]);
    let part = written(&subject, &[run]);
    let picture = exr::encode(&Film::new(3, 2), &[], "stamp").expect("a picture");
    for (name, seed, takes) in
        [("parts", part, &parsers::part as &dyn Fn(&[u8]) -> bool), ("EXR heads", picture, &parsers::exr)]
    {
        assert!(takes(&seed), "{name}: the seed itself");
        let mut dice = Dice(0xE, own_seed());
        let end = Instant::now() + Duration::from_secs(seconds().div_ceil(4));
        let (mut tried, mut taken) = (0_u64, 0_u64);
        while Instant::now() < end {
            taken += u64::from(takes(&bend(&mut dice, &seed)));
            tried += 1;
        }
        println!("{tried} {name}, {taken} taken");
        assert!(tried > 1000 && taken < tried, "{tried} {name}, {taken} taken");
    }
}
