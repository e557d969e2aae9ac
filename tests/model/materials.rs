//! MTL texts: what is taken, what is told.

use glam::{Vec2, Vec3};
use twinlight::scene::model::{Material, Model};

use crate::pictures::png;
use crate::scratch::{Scratch, check_promises, warnings};

const OBJ: &str = "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";

/// The model with this MTL text; `p.png` is red, `my pic.png` too.
fn model(mtl: impl AsRef<[u8]>) -> Model {
    let red = png(2, 2, |_, _| [255, 0, 0, 255]);
    let model = Scratch::new()
        .file("m.obj", OBJ)
        .file("m.mtl", mtl)
        .file("p.png", &red)
        .file("my pic.png", &red)
        .read("m.obj")
        .unwrap();
    check_promises(&model);
    model
}

fn material(mtl: &str) -> (Material, Vec<String>) {
    let model = model(format!("newmtl a\n{mtl}"));
    (model.materials[1].clone(), warnings(&model))
}

#[test]
fn numbers() {
    let (all, said) = material("Ka 0.1 0.2 0.3\nKd 1 0.5 .25\nKs 0.5\nKe 2 2 2\nNs 96.1\nNi 1.5\nd 0.5\nillum 2\n");
    assert_eq!(
        said,
        [
            "m.mtl:1: material `a` shines by itself (`Ke`), and is drawn as if it did not",
            "m.mtl:1: material `a` is partly transparent (`d` or `Tr`), and is drawn opaque",
        ]
    );
    assert_eq!((all.ambient, all.diffuse), (Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.0, 0.5, 0.25)));
    assert_eq!((all.specular, all.emission), (Vec3::splat(0.5), Vec3::splat(2.0)));
    assert_eq!((all.exponent, all.refraction_index, all.opacity, all.illumination), (96.1, 1.5, 0.5, Some(2)));
    assert_eq!(material("").0, Material::named("a"));
    let more = "m.mtl:2: `Kd` is more than 1, where 1 gives back all light: 255 is to be written as 1";
    assert_eq!((material("Kd 255 128 0").1, material("Kd 1 1 1").1.len()), (vec![more.to_owned()], 0));
    assert_eq!(material("Tr 0.25").0.opacity, 0.75);
    assert_eq!(material("d 1\nTr 1").0.opacity, 1.0);
    assert_eq!(material("d -halo 0.5").0.opacity, 0.5);
    assert_eq!(material("KD 1 0 0\nkd 0 1 0\n").0.diffuse, Vec3::Y);
    assert_eq!(material("illum 999").0.illumination, Some(999));
}

/// `#` belongs to a name that has it, and else begins a comment.
#[test]
fn comments_after_names() {
    let read = |library: &str, used: &str, defined: &str| {
        let faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
        let model = Scratch::new()
            .file("m.obj", format!("mtllib {library}\nusemtl {used}\n{faces}"))
            .file("m.mtl", format!("{defined}\nKd 1 0 0\nnewmtl other # thing\n"))
            .read("m.obj")
            .expect("a model");
        check_promises(&model);
        (model.materials[1].diffuse == Vec3::X, warnings(&model))
    };
    let none: [&str; 0] = [];
    assert_eq!(read("m.mtl", "Material #25", "newmtl Material #25"), (true, none.map(String::from).to_vec()));
    assert_eq!(read("m.mtl", "a#b", "newmtl a#b").1, none);
    for (used, defined, found, said) in [
        ("a # red", "newmtl a", true, "`a # red` is defined in no MTL file; `a` is used"),
        ("a", "newmtl a\t# red", true, "`a` is defined in no MTL file; `a\\t# red` is used"),
        (
            "Material #26",
            "newmtl Material #25",
            false,
            "`Material #26` is defined in no MTL file, and is drawn light gray",
        ),
        ("a#b", "newmtl a", false, "`a#b` is defined in no MTL file, and is drawn light gray"),
        ("# a", "newmtl a", false, "`# a` is defined in no MTL file, and is drawn light gray"),
    ] {
        assert_eq!(read("m.mtl", used, defined), (found, vec![format!("m.obj:2: material {said}")]), "{used}");
    }
    let (found, said) = read("m.mtl # of wood", "a", "newmtl a");
    assert!(found && said.len() == 1 && said[0].ends_with("`m.mtl` is used"), "{said:?}");
    for (line, picture) in [("p.png # wood", "p.png"), ("\"my pic.png\" # wood", "my pic.png")] {
        let model = model(format!("newmtl a\nmap_Kd {line}\n"));
        assert_eq!(model.textures[0].file, picture);
        let said = warnings(&model);
        assert!(said.len() == 1 && said[0].ends_with(&format!("`{picture}` is used")), "{said:?}");
    }
}

/// 0 and 1 are without highlights, whatever stands beside them.
#[test]
fn illumination() {
    for (lines, specular, said) in [
        ("Ks 1 1 1\nillum 2\n", 1.0, &[][..]),
        ("Ks 0 0 0\nillum 1\n", 0.0, &[]),
        ("illum 1\nmap_Ks p.png\n", 0.0, &[]),
        (
            "illum 1\nKs 1 1 1\n",
            0.0,
            &["m.mtl:1: `illum 1` of material `a` is without highlights: its `Ks` is not used"],
        ),
        (
            "illum 0\n",
            0.0,
            &["m.mtl:1: material `a` is to be in its plain color (`illum 0`), and is lit like others"],
        ),
    ] {
        let (material, warnings) = material(lines);
        assert_eq!(material.specular, Vec3::splat(specular), "{lines}");
        assert_eq!(warnings, said, "{lines}");
    }
}

/// Pictures on faces that say no place in them.
#[test]
fn pictures_without_a_place() {
    let read = |face: &str, mtl: &str| {
        let obj = format!("{OBJ}usemtl b\n{face}");
        let red = png(2, 2, |_, _| [255, 0, 0, 255]);
        let mtl = format!("newmtl a\nnewmtl b\n{mtl}");
        let model = Scratch::new().file("m.obj", obj).file("m.mtl", mtl).file("p.png", &red).read("m.obj").unwrap();
        warnings(&model)
    };
    let said = "m.obj:8: 2 triangles of material `b`, which has pictures, have no `vt`: each is one color";
    for map in ["map_Kd", "map_Ks", "map_Ns", "map_d", "norm"] {
        let mtl = format!("{map} p.png\n");
        assert_eq!(read("f 1 2 3\nf 1/1 2/1 3/1\nf 1 3 2\n", &mtl), [said], "{map}");
        assert_eq!(read("f 1/1 2/1 3/1\n", &mtl), [""; 0], "{map}");
    }
    assert_eq!(read("f 1 2 3\n", "Kd 1 0 0\n"), [""; 0]);
}

#[test]
fn what_cannot_be_taken_is_told() {
    let cases = [
        ("Kd", "m.mtl:2: `Kd`: wanted one number or three, not 0; the color is not changed"),
        ("Kd 0.5 0.5", "m.mtl:2: `Kd`: wanted one number or three, not 2; the color is not changed"),
        (
            "Kd spectral f.rfl 1",
            "m.mtl:2: `Kd`: `spectral` colors are not known, wanted `r g b`; the color is not changed",
        ),
        ("Ks xyz 1 1 1", "m.mtl:2: `Ks`: `xyz` colors are not known, wanted `r g b`; the color is not changed"),
        ("Kd nan 0 0", "m.mtl:2: `Kd`: wanted numbers of at least 0, not `nan`; the color is not changed"),
        ("Kd -1 0 0", "m.mtl:2: `Kd`: wanted numbers of at least 0, not `-1`; the color is not changed"),
        ("Ns inf", "m.mtl:2: `Ns` wants a number of at least 0, not `inf`; it is not changed"),
        ("illum -1", "m.mtl:2: `illum` wants a number of at least 0, not `-1`; it is not changed"),
        ("d", "m.mtl:2: `d` wants a number of at least 0, not ``; it is not changed"),
        ("Tf 1 1 1", "m.mtl:2: `Tf` is not used"),
        ("wobble 3", "m.mtl:2: the statement `wobble` is not known, and is passed over"),
        ("map_Kd", "m.mtl:2: `map_Kd` names no file"),
        ("map_Kd -s 1 1 1", "m.mtl:2: `map_Kd` names no file"),
        ("d 0", "m.mtl:1: material `a` is wholly transparent (`d` or `Tr`), and is drawn opaque"),
        ("map_Ks no.png", "m.mtl:2: the picture `no.png`: there is no such file; it is left out"),
        ("newmtl a", "m.mtl:2: material `a` is defined again, and the later one is used"),
    ];
    for (line, sentence) in cases {
        let (material, said) = material(line);
        assert_eq!(said, [sentence], "{line}");
        if !line.starts_with('d') && !line.starts_with("map_Ks") {
            assert_eq!(material, Material::named("a"), "{line}");
        }
    }
    assert_eq!(
        warnings(&model("Kd 1 1 1\nnewmtl a\n")),
        ["m.mtl:1: `Kd` before the first `newmtl` belongs to nothing"]
    );
    assert_eq!(warnings(&model(b"\xFF\xFEn\0")).len(), 2);
}

#[test]
fn map_lines() {
    let cases = [
        ("p.png", 1.0, 0.0, 1.0),
        ("  \"p.png\"  ", 1.0, 0.0, 1.0),
        ("my pic.png", 1.0, 0.0, 1.0),
        ("-s 2 3 1 p.png", 2.0, 0.0, 1.0),
        ("-s 2 p.png", 2.0, 0.0, 1.0),
        ("-o 0.5 0.25 0 -s 2 2 2 my pic.png", 2.0, 0.5, 1.0),
        ("-bm 0.3 p.png", 1.0, 0.0, 0.3),
        ("p.png -bm 0.3", 1.0, 0.0, 0.3),
        ("-clamp off -blendu on -mm 0 1 -t 0 0 0 p.png", 1.0, 0.0, 1.0),
        (".\\p.png", 1.0, 0.0, 1.0),
        ("./sub/../p.png", 1.0, 0.0, 1.0),
    ];
    for (rest, scale, offset, strength) in cases {
        let (diffuse, said) = material(&format!("map_Kd {rest}"));
        assert_eq!(said, [""; 0], "{rest}");
        let map = diffuse.diffuse_map.unwrap();
        assert_eq!((map.scale.x, map.offset.x, map.clamp), (scale, offset, false), "{rest}");
        let (normal, said) = material(&format!("norm {rest}"));
        assert_eq!(said, [""; 0], "{rest}");
        assert_eq!(normal.normal_map.unwrap().strength, strength, "{rest}");
    }
    let (clamped, _) = material("map_Kd -clamp on -s 2 5 p.png");
    let map = clamped.diffuse_map.unwrap();
    assert!(map.clamp && map.scale == Vec2::new(2.0, 5.0));
    let (_, said) = material("map_Ns -imfchan r -texres 512 p.png");
    assert_eq!(said, ["m.mtl:2: the option `-imfchan` is not used", "m.mtl:2: the option `-texres` is not used"]);
}

/// A map multiplies its color, and shows when the color is left away or, in error, black.
#[test]
fn colors_beside_maps() {
    assert_eq!(material("map_Kd p.png").0.diffuse, Vec3::ONE);
    assert_eq!(material("Kd 0.5 0.5 0.5\nmap_Kd p.png").0.diffuse, Vec3::splat(0.5));
    assert_eq!(material("map_Ks p.png").0.specular, Vec3::ONE);
    let (black, said) = material("Kd 0 0 0\nmap_Kd p.png");
    assert_eq!(black.diffuse, Vec3::ONE);
    assert_eq!(said, ["m.mtl:1: `Kd 0 0 0` would make `map_Kd` black; it is taken as `Kd 1 1 1`"]);
}

/// The ways in which MTL files are named.
#[test]
fn libraries() {
    let (red, blue) = ("newmtl a\nKd 1 0 0\n", "newmtl b\nKd 0 0 1\n");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n";
    for line in [
        "mtllib a.mtl b b.mtl",
        "mtllib a.mtl\nmtllib b b.mtl",
        "mtllib a.mtl \"b b.mtl\"",
        "mtllib .\\a.mtl\nmtllib \"b b.mtl\"",
    ] {
        let scratch = Scratch::new();
        let model = scratch
            .file("a.mtl", red)
            .file("b b.mtl", blue)
            .file("m.obj", format!("{line}\n{triangle}"))
            .read("m.obj")
            .unwrap();
        assert_eq!((model.materials[1].diffuse, model.materials[2].diffuse), (Vec3::X, Vec3::Z), "{line}");
        assert_eq!(warnings(&model), [""; 0], "{line}");
    }
    // At the end of the text, in other capitals, with another machine's path, not named at all.
    let after = Scratch::new();
    after.file("x/M.MTL", format!("{red}{blue}"));
    for (name, obj) in [
        ("x/a.obj", format!("{triangle}mtllib m.mtl\n")),
        ("x/b.obj", format!("mtllib C:\\work\\m.mtl\n{triangle}")),
        ("x/m.obj", triangle.to_owned()),
    ] {
        let model = after.file(name, obj).read(name).unwrap();
        assert_eq!(model.materials[1].diffuse, Vec3::X, "{name}");
        assert_eq!(model.warnings.len(), 1, "{name}");
        assert!(model.warnings[0].to_string().contains("M.MTL` is used"), "{:?}", model.warnings);
    }
    // Latin-1 names find each other, and two of them stay two.
    let latin = Scratch::new();
    latin.file("m.obj", b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \xe9\nf 1 2 3\nusemtl \xe8\nf 1 2 3\n");
    let model = latin.file("m.mtl", b"newmtl \xe9\nKd 1 0 0\nnewmtl \xe8\nKd 0 0 1\n").read("m.obj").unwrap();
    assert_eq!((model.materials[1].diffuse, model.materials[2].diffuse), (Vec3::X, Vec3::Z));
}
