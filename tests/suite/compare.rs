//! The comparer itself: it must fail on planted faults, or nothing that it passes is proven.

use twinlight::film::Film;
use twinlight::film::Transfer;
use twinlight::film::compare::{Standard, TOLERANCES, compare, side_by_side};
use twinlight::gpu::wgsl::Sources;

use super::{on_cpu, on_gpu, root, small, tables_of};

const ALL: [Standard; 3] = [Standard::Exact, Standard::Near, Standard::Random];

fn film() -> Film {
    on_cpu(&tables_of(&small(&root().join("scenes/room.toml"), [97, 61], 1)))
}

/// The same film with each pixel taken from elsewhere or changed.
fn changed(film: &Film, change: impl Fn(u32, u32) -> ([f32; 4], u32)) -> Film {
    let mut other = Film::new(film.width(), film.height());
    let pixels = (0..film.pixels()).map(|p| change(p % film.width(), p / film.width()));
    let (sums, ids): (Vec<_>, Vec<_>) = pixels.unzip();
    other.put(0, &sums, &ids);
    other
}

fn pixel(film: &Film, x: u32, y: u32) -> ([f32; 4], u32) {
    let p = (y.min(film.height() - 1)) * film.width() + x.min(film.width() - 1);
    let c = film.color(p);
    ([c.x, c.y, c.z, 1.0], film.id(p))
}

fn passes(a: &Film, b: &Film, standard: Standard) -> bool {
    compare(a, b, standard).expect("one size").passes()
}

#[test]
fn a_film_equals_itself() {
    let film = film();
    for standard in ALL {
        assert!(passes(&film, &film, standard), "{standard:?}");
    }
}

#[test]
fn one_bit_of_one_pixel_is_seen_where_bits_must_agree() {
    let film = film();
    let flipped = changed(&film, |x, y| {
        let (mut color, id) = pixel(&film, x, y);
        if (x, y) == (50, 30) {
            color[1] = f32::from_bits(color[1].to_bits() ^ 1);
        }
        (color, id)
    });
    assert!(!passes(&film, &flipped, Standard::Exact));
    assert!(passes(&film, &flipped, Standard::Near), "an ulp is what this standard allows");
    let relabeled = changed(&film, |x, y| {
        let (color, id) = pixel(&film, x, y);
        (color, if (x, y) == (3, 3) { id ^ 1 } else { id })
    });
    assert!(!passes(&film, &relabeled, Standard::Exact));
    let inner = compare(&film, &relabeled, Standard::Near).expect("one size");
    assert!(inner.passes(), "a lone other id is its own edge: {inner:?}");
}

#[test]
fn planted_faults_are_seen() {
    let film = film();
    let mirrored = changed(&film, |x, y| pixel(&film, film.width() - 1 - x, y));
    let swapped = changed(&film, |x, y| {
        let ([r, g, b, n], id) = pixel(&film, x, y);
        ([b, g, r, n], id)
    });
    let darker = changed(&film, |x, y| {
        let ([r, g, b, n], id) = pixel(&film, x, y);
        ([r * 0.98, g * 0.98, b * 0.98, n], id)
    });
    let shifted = changed(&film, |x, y| pixel(&film, x + 1, y));
    let broken = changed(&film, |x, y| {
        let ([r, g, b, n], id) = pixel(&film, x, y);
        ([if x < 3 { f32::NAN } else { r }, g, b, n], id)
    });
    let faults = [
        ("mirrored", mirrored),
        ("swapped channels", swapped),
        ("2 % darker", darker),
        ("shifted", shifted),
        ("NaN", broken),
        ("black", Film::new(film.width(), film.height())),
    ];
    for (name, fault) in faults {
        for standard in ALL {
            assert!(!passes(&film, &fault, standard), "{name} passes {standard:?}");
        }
    }
}

#[test]
fn another_scene_on_the_gpu_is_seen() {
    // The real harness with the wrong scene on one side: a comparer fed with one film twice would pass this.
    let mut scene = small(&root().join("scenes/room.toml"), [61, 43], 1);
    let cpu = on_cpu(&tables_of(&scene));
    scene.spheres[0].center.x -= 9.0;
    let gpu = on_gpu(&Sources::default(), &tables_of(&scene)).expect("a film");
    for standard in ALL {
        assert!(!passes(&cpu, &gpu, standard), "{standard:?}");
    }
}

#[test]
fn sizes_must_agree_and_pictures_stand_side_by_side() {
    let film = film();
    let turned = Film::new(film.height(), film.width());
    assert!(compare(&film, &turned, Standard::Exact).is_err());
    assert!(side_by_side(&film, &turned, Transfer::None, 1.0).is_err());
    let picture = side_by_side(&film, &Film::new(97, 61), Transfer::None, 1.0).expect("one size");
    assert_eq!(picture.dimensions(), (3 * 97, 61));
    let shown = film.to_rgb8(Transfer::None);
    assert_eq!(picture.get_pixel(10, 20), shown.get_pixel(10, 20));
    assert_eq!(picture.get_pixel(97 + 10, 20).0, [0, 0, 0]);
    assert_eq!(picture.get_pixel(2 * 97 + 10, 20), shown.get_pixel(10, 20), "the difference from black");
}

#[test]
fn each_tolerance_has_a_reason_and_each_standard_its_rows() {
    for tolerance in TOLERANCES {
        assert!(tolerance.reason.len() > 20, "{tolerance:?}");
    }
    for standard in ALL {
        assert!(TOLERANCES.iter().filter(|t| t.asked.contains(&standard)).count() >= 2, "{standard:?}");
    }
}
