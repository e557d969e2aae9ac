//! Pictures: what is decoded and how it lies, what is refused, what stands in for what is missing.

use std::io::Cursor;
use std::time::{Duration, Instant};

use image::{DynamicImage, ImageFormat, RgbaImage};
use twinlight::scene::model::bump::{Kind, kind, to_normals};
use twinlight::scene::model::texture::decode;
use twinlight::scene::model::{Budget, Content, Limits, Model};

use crate::scratch::{Scratch, check_promises, warnings};

pub fn encoded(format: ImageFormat, picture: impl Into<DynamicImage>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

pub fn png(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    encoded(ImageFormat::Png, RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y))))
}

/// A TGA of 3 x 2 texels, written by hand: rows as `descriptor` says, colors blue first.
pub fn tga(kind: u8, descriptor: u8, data: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0, 0, kind, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 24, descriptor];
    bytes.extend(data);
    bytes
}

pub fn jpeg() -> Vec<u8> {
    encoded(
        ImageFormat::Jpeg,
        image::RgbImage::from_fn(16, 16, |x, y| image::Rgb([(x * 9) as u8, (y * 9) as u8, 99])),
    )
}

fn open(bytes: &[u8], name: &str) -> Result<(u32, u32, Vec<[u8; 4]>), String> {
    let limits = Limits::default();
    decode(bytes, name, &limits, &mut Budget::new(&limits))
        .map(|picture| (picture.width, picture.height, picture.texels.to_vec()))
}

const TOP: [[u8; 4]; 3] = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]];
const BOTTOM: [[u8; 4]; 3] = [[1, 2, 3, 255]; 3];

/// The top row comes first, whichever way the file is written.
#[test]
fn orientation() {
    let wanted = (3, 2, [TOP, BOTTOM].concat());
    let top: Vec<u8> = TOP.iter().flat_map(|[r, g, b, _]| [*b, *g, *r]).collect();
    let bottom = [3, 2, 1].repeat(3);
    let (top_run, bottom_run) = ([vec![2], top.clone()].concat(), vec![0x82, 3, 2, 1]);
    let reversed: Vec<u8> = TOP.iter().rev().flat_map(|[r, g, b, _]| [*b, *g, *r]).collect();
    let files = [
        ("raw, bottom first", tga(2, 0, &[bottom.clone(), top.clone()].concat())),
        ("raw, top first", tga(2, 0x20, &[top.clone(), bottom.clone()].concat())),
        ("raw, top first, right to left", tga(2, 0x30, &[reversed, bottom].concat())),
        ("runs, bottom first", tga(10, 0, &[bottom_run.clone(), top_run.clone()].concat())),
        ("runs, top first", tga(10, 0x20, &[top_run, bottom_run].concat())),
        ("png", png(3, 2, |x, y| if y == 0 { TOP[x as usize] } else { BOTTOM[x as usize] })),
    ];
    for (name, file) in files {
        assert_eq!(open(&file, "p.TGA").unwrap(), wanted, "{name}");
    }
    let deep = image::ImageBuffer::from_fn(2, 1, |x, _| image::Luma([x as u16 * 0x8080]));
    assert_eq!(open(&encoded(ImageFormat::Png, deep), "p.png").unwrap().2, [[0, 0, 0, 255], [128, 128, 128, 255]]);
    assert_eq!(open(&jpeg(), "misnamed.png").unwrap().0, 16);
}

/// Files that lie, are cut short or are something else: a sentence, quickly and without their memory.
#[test]
fn refused() {
    let crc_png = |width: u32, height: u32| {
        let mut bytes = png(1, 1, |_, _| [0; 4]);
        bytes[16..20].copy_from_slice(&width.to_be_bytes());
        bytes[20..24].copy_from_slice(&height.to_be_bytes());
        let crc = crc32(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&crc.to_be_bytes());
        bytes
    };
    let mut wide = tga(2, 0, &[]);
    wide[12..16].copy_from_slice(&[0xFF, 0x3F, 0xFF, 0x0F]);
    let mut tall_jpeg = jpeg();
    let frame = tall_jpeg.windows(2).position(|pair| pair == [0xFF, 0xC0]).unwrap();
    tall_jpeg[frame + 5..frame + 9].copy_from_slice(&[0x1F, 0xFF, 0x1F, 0xFF]);
    let whole = png(64, 64, |x, y| [x as u8, y as u8, (x * y) as u8, 255]);
    let cases = [
        (crc_png(16_385, 16_385), "it"),
        (
            crc_png(16_384, 16_384),
            "it has 16384 x 16384 texels; at most 16384 a side and 67108864 in all are taken",
        ),
        (crc_png(8192, 8192), "it cannot hold the 8192 x 8192 texels that it promises in "),
        (crc_png(0, 5), "it"),
        (wide, "it cannot hold the 16383 x 4095 texels that it promises in 18 bytes"),
        (tall_jpeg, "it cannot hold the 8191 x 8191 texels that it promises in "),
        (whole[..whole.len() / 2].to_vec(), "it cannot be decoded"),
        (tga(10, 0, &[0xFF]), "it cannot be decoded"),
        (tga(2, 0, &[1, 2, 3]), "it cannot be decoded"),
        (tga(77, 0, &[0; 18]), "it cannot be decoded"),
        (b"\x89PNG\r\n\x1a\n".to_vec(), "it cannot be decoded"),
        (b"\xFF\xD8\xFF".to_vec(), "it cannot be decoded"),
        (Vec::new(), "it cannot be decoded"),
    ];
    for (at, (bytes, sentence)) in cases.iter().enumerate() {
        let start = Instant::now();
        let error = open(bytes, "p.tga").unwrap_err();
        assert!(error.starts_with(sentence), "case {at}: {error}");
        assert!(start.elapsed() < Duration::from_millis(500), "case {at}: {:?}", start.elapsed());
    }
    for other in ["GIF89a", "BM......", "DDS |...", "v/1\x01....", "#?RADIANCE", ""] {
        assert_eq!(open(other.as_bytes(), "p.png").unwrap_err(), "it is neither a PNG nor a JPEG nor a TGA file");
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xEDB8_8320 } else { crc >> 1 })
    })
}

fn model(mtl: &str, files: &[(&str, Vec<u8>)]) -> Model {
    let scratch = Scratch::new();
    scratch
        .file(
            "m.obj",
            "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 2/1\n",
        )
        .file("m.mtl", mtl);
    for (name, bytes) in files {
        scratch.file(name, bytes);
    }
    let model = scratch.read("m.obj").unwrap();
    check_promises(&model);
    model
}

/// A picture is decoded once and shared, also under two names and for two uses.
#[test]
fn sharing() {
    let red = png(2, 2, |_, _| [255, 0, 0, 128]);
    let model = model("newmtl a\nmap_Kd p.png\nmap_d p.png\nnewmtl b\nmap_Kd ./x/../P.png\n", &[("p.png", red)]);
    assert_eq!(model.materials[1].diffuse_map, model.materials[2].diffuse_map);
    assert_eq!(model.textures.len(), 2);
    assert!(std::sync::Arc::ptr_eq(&model.textures[0].texels, &model.textures[1].texels));
    assert_eq!([model.textures[0].content, model.textures[1].content], [Content::Color, Content::Scalar]);
    assert!(model.textures[0].has_alpha);
    assert_eq!(warnings(&model), ["m.mtl:5: the picture `./x/../P.png`: there is no such file; `p.png` is used"]);
}

/// A picture in color that has an alpha channel is as opaque as that says, wholly so included; a gray one without a hole
/// in it is a mask, and so is a TGA file whose fourth byte is no alpha.
#[test]
fn what_says_how_opaque_a_picture_is() {
    let opaque = |texel: [u8; 4]| {
        let model = model("newmtl a\nmap_d p.png\n", &[("p.png", png(2, 2, move |_, _| texel))]);
        model.textures[0].has_alpha
    };
    assert_eq!([[40, 120, 30, 255], [40, 40, 40, 200], [40, 40, 40, 255]].map(opaque), [true, true, false]);
    let tga = |bits_of_alpha: u8| {
        let mut bytes = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, bits_of_alpha];
        bytes.extend([10, 20, 30, 0]);
        model("newmtl a\nmap_d p.tga\n", &[("p.tga", bytes)]).textures[0].has_alpha
    };
    assert_eq!([0, 8].map(tga), [false, true]);
}

/// The last part of another machine's path, beside the MTL file and beside the OBJ file.
#[test]
fn other_machines_paths() {
    let red = png(2, 2, |_, _| [255, 0, 0, 255]);
    let scratch = Scratch::new();
    scratch.file("m.obj", "mtllib x/m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    scratch
        .file("x/m.mtl", "newmtl a\nmap_Kd C:\\tex\\P.png\nmap_Ks /home/me/q.png\n")
        .file("x/p.png", &red)
        .file("q.png", &red);
    let said = warnings(&scratch.read("m.obj").unwrap());
    assert!(
        said.len() == 2 && said[0].ends_with("`x/p.png` is used") && said[1].ends_with("`q.png` is used"),
        "{said:?}"
    );
}

/// A model in a folder of its own, whose picture lies in the scene's, or in one that is searched: both are roots.
#[test]
fn pictures_beside_the_scene() {
    let scratch = Scratch::new();
    scratch
        .file("a/m.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
        .file("a/m.mtl", "newmtl a\nmap_Kd p.png\nmap_Ks ../../else/t/q.png\n")
        .file("p.png", png(2, 2, |_, _| [255, 0, 0, 255]))
        .file("q.png", png(2, 2, |_, _| [0, 255, 0, 255]));
    let model = scratch.read("a/m.obj").unwrap();
    let said = warnings(&model);
    assert!(
        said.len() == 2 && said[0].ends_with("`p.png` is used") && said[1].ends_with("`q.png` is used"),
        "{said:?}"
    );
    assert_eq!(model.textures.len(), 2);
}

/// What is missing or broken is told, and the surface is a checkerboard.
#[test]
fn stand_ins() {
    let model = model(
        "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd torn.png\nmap_Bump torn.png\n",
        &[("torn.png", b"\x89PNG\r\n\x1a\n....".to_vec())],
    );
    assert_eq!(model.materials[1].diffuse_map, model.materials[2].diffuse_map);
    assert!(model.materials[1].diffuse_map.is_some() && model.materials[2].normal_map.is_none());
    assert_eq!((model.textures.len(), model.textures[0].width), (1, 8));
    assert_ne!(model.textures[0].texels[0], model.textures[0].texels[8]);
    assert_eq!(model.textures[0].texels.iter().filter(|texel| **texel == [255, 0, 255, 255]).count(), 32);
    let said = warnings(&model);
    assert_eq!(said[0], "m.mtl:2: the picture `gone.png`: there is no such file; a checkerboard is drawn instead");
    assert!(
        said[1].starts_with("m.mtl:4: the picture `torn.png`: it cannot be decoded (")
            && said[1].ends_with("; a checkerboard is drawn instead")
    );
    assert!(
        said[2].starts_with("m.mtl:5: the picture `torn.png`: it cannot be decoded (")
            && said[2].ends_with("; it is left out")
    );
    let cut = jpeg();
    let short = self::model("newmtl a\nmap_Kd c.jpg\n", &[("c.jpg", cut[..cut.len() - 20].to_vec())]);
    assert!(
        warnings(&short)
            .iter()
            .any(|line| line == "m.mtl:2: the picture `c.jpg`: it is cut short; what is there is used"
                || line.contains("cannot be decoded"))
    );
}

#[test]
fn bump_pictures() {
    let gray = |at: u32| {
        let g = (at % 200) as u8;
        [g, g, g, 255]
    };
    let texels: Vec<_> = (0..64).map(gray).collect();
    assert_eq!(kind(&texels), Kind::Heights);
    // Light gray has the length of a normal, and is one of the traps.
    assert_eq!(kind(&[[201, 201, 201, 255]; 9]), Kind::Heights);
    assert_eq!(kind(&[[128, 128, 255, 255]; 9]), Kind::Normals);
    assert_eq!(kind(&[[200, 128, 230, 255]; 9]), Kind::Normals);
    assert_eq!(kind(&[[255, 128, 0, 255]; 9]), Kind::Neither);
    // A hill whose height grows to the right and upward leans to the left and downward.
    let slope: Vec<_> = (0..16 * 16)
        .map(|at| {
            let g = (at % 16 * 8 + (15 - at / 16) * 4) as u8;
            [g, g, g, 255]
        })
        .collect();
    let normals = to_normals(&slope, 16, 1.0, true);
    let [r, g, b, a] = normals[5 * 16 + 7];
    // Rises 8/255 a texel of 1/16: 0.01 * 16 * 8/255 = 0.0050 -> 127.5 - 0.64 ...
    assert_eq!([r, g, b, a], [127, 127, 255, 255]);
    let steep = to_normals(&slope, 16, 100.0, true)[5 * 16 + 7];
    let n =
        glam::Vec3::new(-0.01 * 100.0 * 16.0 * 8.0 / 255.0, -0.01 * 100.0 * 16.0 * 4.0 / 255.0, 1.0).normalize();
    for (axis, value) in n.to_array().into_iter().enumerate() {
        assert!((f32::from(steep[axis]) - (value * 0.5 + 0.5) * 255.0).abs() <= 0.51, "{steep:?} {n}");
    }
    // Repeating, the rim sees the other side; clamped, it does not.
    assert_ne!(to_normals(&slope, 16, 100.0, false)[0], to_normals(&slope, 16, 100.0, true)[0]);
    assert_eq!(to_normals(&[[9, 9, 9, 255]], 1, 1.0, false), [[128, 128, 255, 255]]);

    let bluish = png(2, 2, |_, _| [128, 128, 255, 255]);
    let orange = png(2, 2, |_, _| [255, 128, 0, 255]);
    let heights = png(4, 4, |x, _| {
        [x as u8 * 60; 3].map(|g| g).into_iter().chain([255]).collect::<Vec<_>>().try_into().unwrap()
    });
    let model = model(
        "newmtl a\nmap_Bump -bm 2 n.png\nnewmtl b\nbump -bm 2 h.png\n",
        &[("n.png", bluish), ("h.png", heights)],
    );
    assert_eq!([1, 2].map(|at| model.materials[at].normal_map.unwrap().strength), [2.0, 1.0]);
    assert_eq!(warnings(&model), [""; 0]);
    assert!(model.textures.iter().all(|texture| texture.content == Content::Normal));
    assert_eq!(kind(&model.textures[1].texels), Kind::Normals);
    let odd = self::model("newmtl a\nmap_bump o.png\nnewmtl b\n", &[("o.png", orange)]);
    assert_eq!(
        warnings(&odd),
        [
            "m.mtl:2: the picture `o.png`: it is neither gray (heights) nor bluish (normals); its brightness is taken as heights"
        ]
    );
}
