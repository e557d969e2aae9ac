//! Texts that mean harm: scenes, models and materials.

use std::fmt::Write as _;

/// The files of a case by name; the first one is rendered.
pub(super) struct Case {
    pub(super) name: String,
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// Only read: a million faces over each other are work to draw, not harm.
    pub(super) heavy: bool,
}

#[derive(Default)]
pub(super) struct Corpus(pub(super) Vec<Case>);

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const FACES: &str = "f 1 2 3\nf 1 3 4\n";
const SCENE: &str = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n[[light.directional]]\ntoward = [0, 1, 1]\n\
    [[material]]\nname = \"a\"\n[[object.sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"a\"\n";

impl Corpus {
    fn add(&mut self, name: &str, files: &[(&str, &[u8])]) {
        let files = files.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec())).collect();
        self.0.push(Case { name: name.to_owned(), files, heavy: false });
    }

    fn scene(&mut self, name: &str, text: impl AsRef<[u8]>) {
        self.add(name, &[("scene.toml", text.as_ref())]);
    }

    /// The usual scene with one thing replaced.
    fn other(&mut self, from: &str, to: &str) {
        assert!(SCENE.contains(from), "{from}");
        self.scene(&format!("{to} for {from}"), SCENE.replacen(from, to, 1));
    }

    fn obj(&mut self, name: &str, text: impl AsRef<[u8]>) {
        self.add(name, &[("model.obj", text.as_ref())]);
    }

    fn heavy(&mut self, name: &str, text: impl AsRef<[u8]>) {
        self.obj(name, text);
        self.0.iter_mut().last().expect("a case").heavy = true;
    }

    fn mtl(&mut self, text: &str) {
        let obj = format!("mtllib a.mtl\n{CUBE}vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
        self.add(text, &[("model.obj", obj.as_bytes()), ("a.mtl", format!("newmtl m\n{text}\n").as_bytes())]);
    }

    pub(super) fn picture(&mut self, name: &str, file: &str, bytes: &[u8]) {
        let obj = format!("mtllib a.mtl\n{CUBE}vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
        let mtl = format!("newmtl m\nmap_Kd {file}\n");
        self.add(name, &[("model.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes()), (file, bytes)]);
    }
}

pub(super) fn scenes(corpus: &mut Corpus) {
    for (name, text) in [
        ("nothing", ""),
        ("a byte order mark", "\u{feff}"),
        ("a zero byte", "\0"),
        ("an open bracket", "["),
        ("no value", "camera ="),
        ("a table twice", "[camera]\n[camera]\n"),
        ("words", "a picture of a room, please"),
        ("XML", "<scene><camera/></scene>"),
    ] {
        corpus.scene(name, text);
    }
    corpus.scene("Windows' lines", SCENE.replace('\n', "\r\n"));
    corpus.scene("UTF-16", SCENE.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>());
    corpus.scene("Latin letters", b"# caf\xe9\n");
    corpus.scene(
        "random bytes",
        (0..4096_u32).map(|i| (i.wrapping_mul(2_654_435_769) >> 24) as u8).collect::<Vec<_>>(),
    );
    for (open, close) in [("[", "]"), ("{a=", "}")] {
        corpus.scene("deep lists", format!("a = {}{}", open.repeat(200_000), close.repeat(200_000)));
    }
    corpus.scene("deep names", format!("{}a = 1", "a.".repeat(100_000)));
    corpus.scene("deep tables", format!("[{}a]", "a.".repeat(100_000)));
    corpus.scene("a long word", format!("a = \"{}\"", "x".repeat(16 << 20)));
    corpus.scene("a long line", format!("# {}\n{SCENE}", "x".repeat(16 << 20)));
    corpus.scene("more than 64 MiB", vec![b'#'; (64 << 20) + 1]);
    let ball = "[[object.sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"a\"\n";
    corpus.scene("thousands in one place", SCENE.to_owned() + &ball.repeat(20_000));
    let light = "[[light.point]]\nposition = [0, 9, 0]\n";
    corpus.scene("a thousand lights", SCENE.to_owned() + &light.repeat(1000));
    let names = (0..20_000).fold(String::new(), |mut all, i| {
        let _ = writeln!(all, "[[material]]\nname = \"{i}\"");
        all
    });
    corpus.scene("thousands of materials", SCENE.to_owned() + &names);
    for to in [
        "nan",
        "inf",
        "-1",
        "0",
        "1e-9",
        "1e30",
        "1e999",
        "\"1\"",
        "[1]",
        "true",
        "1979-05-27",
        "9223372036854775808",
    ] {
        corpus.other("radius = 1", &format!("radius = {to}"));
    }
    for to in [
        "[0, 0, 0]",
        "[nan, 0, 5]",
        "[1e30, 0, 1e-30]",
        "[0, 0]",
        "[0, 0, 5, 5]",
        "5",
        "[[0, 0, 5]]",
        "[1e9, 1e9, 1e9]",
    ] {
        corpus.other("position = [0, 0, 5]", &format!("position = {to}"));
    }
    for line in [
        "fov = 0",
        "fov = 180",
        "near = 5\nfar = 1",
        "up = [0, 0, 0]",
        "up = [0, 0, 1]",
        "aspect = 1e9",
        "near = 1e-6\nfar = 1e9",
    ] {
        corpus.other("look_at = [0, 0, 0]\n", &format!("look_at = [0, 0, 0]\n{line}\n"));
    }
    for more in [
        "[film]\nsize = [0, 1]",
        "[film]\nsize = [65536, 65536]",
        "[film]\nsize = [4294967296, 4294967296]",
        "[trace]\nsamples = 9223372036854775807",
        "[trace]\ndepth = 4294967295",
        "[trace]\nsamples = -1",
        "[raster]\nsamples = 255",
        "[raster]\nshadow_size = 1000000",
        "[raster]\nblur = 1000",
        "[[light.point]]\nposition = [0, 0, 0]\nintensity = inf",
        "[[object.triangle]]\nvertices = [[0,0,0],[0,0,0],[0,0,0]]\nmaterial = \"a\"",
        "[[object.plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]\nmaterial = \"a\"",
        "[[material]]\nname = \"a\"",
        "[animation]\nframes = 0",
        "[animation]\nframes = 9223372036854775807",
        "[animation]\nframes = 2\n[[animation.track]]\ntarget = \"camera.fov\"\nkeys = [[-9223372036854775808, 1], [9223372036854775807, 1e308]]",
        "[animation]\nframes = 2\n[[animation.orbit]]\ntarget = \"camera\"",
        "[animation]\nframes = 2\n[[animation.track]]\ntarget = \"animation.frames\"\nkeys = [[1, 9]]",
    ] {
        corpus.scene(more, format!("{SCENE}{more}\n"));
    }
}

pub(super) fn meshes(corpus: &mut Corpus) {
    for path in [
        "/etc/passwd",
        "../../../../etc/passwd",
        "/dev/zero",
        "\\\\\\\\server\\\\share\\\\a.obj",
        "C:\\\\a.obj",
        "",
        ".",
        "..",
        "pipe",
        "link",
        "folder",
        "nul",
        "a\\u0000b",
    ] {
        let more = format!("[[object.mesh]]\npath = \"{path}\"\n");
        corpus.add(&more, &[("scene.toml", format!("method = \"raster\"\n{SCENE}{more}").as_bytes())]);
    }
    let grid = (0..300).flat_map(|y| (0..300).map(move |x| (x, y)));
    let grid = grid.fold(String::new(), |mut all, (x, y)| {
        let _ = writeln!(all, "v {x} {y} 0\nv {} {y} 0\nv {x} {} 0\nf -1 -2 -3", x + 1, y + 1);
        all
    });
    let many = "[[object.mesh]]\npath = \"grid.obj\"\n".repeat(20_000);
    for method in ["raster", "trace"] {
        let text = format!("method = \"{method}\"\n{SCENE}{many}");
        corpus.add(
            &format!("a model in 20,000 places, {method}"),
            &[("scene.toml", text.as_bytes()), ("grid.obj", grid.as_bytes())],
        );
    }
}

pub(super) fn models(corpus: &mut Corpus) {
    for text in [
        "",
        "f",
        "f 1 2 3",
        "f 0 0 0",
        "v",
        "v 1",
        "v 1 2 x",
        "vt",
        "vn 1",
        "usemtl",
        "g",
        "o",
        "s x",
        "mtllib",
        "l 1 2",
        "#",
        "f 1//-6148914691236517207 2//1 3//1",
        "f 18446744073709551616 1 1",
        "f -9223372036854775808 1 1",
        "f 1/1 2 3",
        "f 1 2",
        "f 1 1 1",
        "f 1/ 2/ 3/",
        "f 1//// 2 3",
        "f a b c",
        "f 1 2 \\",
        "\\",
        "f 1 2 \\\n3",
        "mtllib /dev/zero",
        "mtllib ../../../etc/passwd",
        "mtllib pipe",
        "mtllib folder",
        "mtllib link",
        "mtllib model.obj",
        "call other.obj",
        "v nan inf -inf\nf 1 2 5",
        "v 1e999 0 0\nf 1 2 5",
        "v 1e30 1e-30 1e38\nf 1 2 5",
        "v 0 0 0 1 x 1\nf 1 2 5",
        "curv 0 1 2",
        "f 1 2 3 # \u{0}",
        "usemtl \u{1f980}\nf 1 2 3",
    ] {
        corpus.obj(text, format!("{CUBE}{text}\n"));
    }
    corpus.obj("a Latin letter", [CUBE.as_bytes(), b"# caf\xe9\n", FACES.as_bytes()].concat());
    corpus.obj("no vertices", "f 1 2 3\n".repeat(1000));
    corpus.obj("a long line", format!("{CUBE}# {}\n{FACES}", "x".repeat(32 << 20)));
    corpus.obj("a long number", format!("v {} 0 0\n{CUBE}{FACES}", "9".repeat(500_000)));
    corpus.heavy("a polygon of thousands", format!("{CUBE}f{}\n", " 1 2 3 4".repeat(25_000)));
    corpus.obj("thousands of libraries", format!("{}{CUBE}{FACES}", "mtllib a.mtl\n".repeat(100_000)));
    corpus.obj(
        "thousands of groups",
        (0..100_000).fold(CUBE.to_owned(), |all, i| all + "g " + &i.to_string() + "\n") + FACES,
    );
    corpus.heavy("one place a million times", CUBE.to_owned() + &"f 1 2 3\n".repeat(1_000_000));
    corpus.obj("backslashes", format!("{CUBE}{}", "\\\n".repeat(1_000_000)));
}

pub(super) fn materials(corpus: &mut Corpus) {
    for text in [
        "Kd",
        "Kd 0.5",
        "Kd nan nan nan",
        "Kd spectral f.rfl",
        "Ks xyz 1 2 3",
        "Ka -1 -1 -1",
        "Ke 1e999 0 0",
        "illum 999",
        "illum -1",
        "Ns inf",
        "Ns -1",
        "d 2",
        "Tr x",
        "map_Kd",
        "map_Kd ",
        "newmtl",
        "newmtl m",
        "map_Kd -s 1 1 1 ../../etc/passwd",
        "map_Kd -s",
        "map_Kd /dev/zero",
        "map_Kd pipe",
        "map_Kd folder",
        "map_Kd link",
        "map_Kd a.mtl",
        "map_Bump -bm 1e999 x.png",
        "norm",
        "map_Kd -o nan nan nan x.png",
        "refl -type sphere x.png",
    ] {
        corpus.mtl(text);
    }
}
