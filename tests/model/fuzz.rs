//! Seeds + random changes -> all parsers: no panic, no hang, and what is accepted keeps its promises.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use crate::parsers;
use crate::pictures::{jpeg, png, tga};

/// xorshift64 (Marsaglia 2003).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub fn below(&mut self, limit: usize) -> u64 {
        self.next() % limit as u64
    }

    fn choose<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.below(list.len()) as usize]
    }
}

const WORDS: &[&[u8]] = &[
    b"-1",
    b"0",
    b"1/1/1",
    b"//",
    b"-6148914691236517207",
    b"4294967296",
    b"nan",
    b"1e999",
    b"1e-45",
    b"\\\n",
    b"\r",
    b"\n",
    b"\0",
    b"#",
    b"\"",
    b"\xff",
    b"f 1 2 3 4 5\n",
    b"f -1 -2 -3\n",
    b"v 0 0 0\n",
    b"usemtl ",
    b"mtllib a b.mtl\n",
    b"s off\n",
    b"newmtl x\n",
    b"map_Kd -s 1 1 ",
    b"-bm ",
    b"Kd 0.5\n",
    b"spectral",
];

fn change(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(6) {
        let at = random.below(bytes.len() + 1) as usize;
        let end = (at + random.below(12) as usize).min(bytes.len());
        match random.below(6) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            1 if at < bytes.len() => bytes[at] = random.next() as u8,
            2 => drop(bytes.splice(at..end, random.choose(WORDS).iter().copied())),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1) as usize;
                bytes.splice(to..to, piece);
            }
            _ => drop(bytes.splice(at..at, random.choose(WORDS).iter().copied())),
        }
    }
    if random.below(16) == 0 {
        bytes.truncate(random.below(bytes.len() + 1) as usize);
    }
    bytes
}

fn seconds() -> f64 {
    std::env::var("TWINLIGHT_FUZZ_SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(2.5)
}

/// Runs for `TWINLIGHT_FUZZ_SECONDS` (2.5 by default); returns how many inputs, and how many were accepted.
fn hunt(seeds: &[Vec<u8>], mut seed: u64, target: impl Fn(&[u8]) -> bool) -> (u64, u64) {
    seed ^= std::env::var("TWINLIGHT_FUZZ_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    let mut random = Random(seed);
    let start = Instant::now();
    let (mut count, mut accepted) = (0, 0);
    while start.elapsed().as_secs_f64() < seconds() {
        let from = random.below(seeds.len()) as usize;
        let input = change(&seeds[from], &mut random);
        let begin = Instant::now();
        match catch_unwind(AssertUnwindSafe(|| target(&input))) {
            Ok(taken) => accepted += u64::from(taken),
            Err(_) => panic!("input {count} of seed {seed}: {:?}", String::from_utf8_lossy(&input)),
        }
        assert!(
            begin.elapsed() < Duration::from_secs(1),
            "slow: {:?} {:?}",
            begin.elapsed(),
            String::from_utf8_lossy(&input)
        );
        count += 1;
    }
    (count, accepted)
}

#[test]
fn obj_texts() {
    let seeds: [&[u8]; 4] = [
        b"mtllib a.mtl b.mtl\no x\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl m\ns 1\nf 1/1/1 2/2/1 3/1/1 4/2/1\nl 1 2\n",
        b"v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nv 0.5 0.5 1e-3\ns off\nf 1 2 3 4\nf -1 -2 -3\ng a b\nf 1 2 5\nf 2 3 5\n",
        b"# c\\\nv 0 0 0 1\r\nv 1 0 \\\r\n0\r\nv 0 1 0 1 1 1\r\nvt 0\r\nf 1/1 2/1 3/1\r\ncurv 0 1 1 2\r\n",
        b"v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8\nf 8 7 6 5 4 3 2 1\n",
    ];
    let seeds = seeds.map(<[u8]>::to_vec);
    let (count, accepted) = hunt(&seeds, 0x0B5, parsers::obj);
    println!("{count} OBJ texts, {accepted} accepted");
    assert!(count > 500 && accepted * 10 > count && accepted < count, "{count} {accepted}");
}

#[test]
fn mtl_texts() {
    let seeds: [&[u8]; 2] = [
        b"newmtl a\nKa 1 1 1\nKd 0.5 0.5 0.5\nKs 1\nNs 20\nd 1\nTr 0\nillum 2\nNi 1.5\nmap_Kd -s 2 2 2 -o 0.1 a b.png\nmap_Bump -bm 0.5 n.png\n",
        b"newmtl b\nKd spectral f.rfl 1\nKs xyz 1 1 1\nd -halo 0.5\nnorm \"n n.png\"\nmap_Ks x.png -clamp on -mm 0 1\nmap_d -imfchan m d.tga\n",
    ];
    let seeds = seeds.map(<[u8]>::to_vec);
    let (count, accepted) = hunt(&seeds, 0x317, parsers::mtl);
    println!("{count} MTL texts, {accepted} accepted");
    assert!(count > 500 && accepted * 2 > count && accepted < count, "{count} {accepted}");
}

#[test]
fn picture_files() {
    let runs = [0x82, 3, 2, 1, 2, 1, 2, 3, 4, 5, 6, 7, 8, 9];
    let seeds = [png(9, 5, |x, y| [x as u8, y as u8, 9, 200]), jpeg(), tga(2, 0, &[7; 18]), tga(10, 0x20, &runs)];
    let (count, accepted) = hunt(&seeds, 0x717, parsers::picture);
    println!("{count} pictures, {accepted} accepted");
    assert!(count > 500 && accepted * 50 > count && accepted < count, "{count} {accepted}");
}
