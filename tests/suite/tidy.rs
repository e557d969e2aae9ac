//! The tree itself, without a GPU: twins exist, floors hold, kernels are valid everywhere and within the limits.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use naga::valid::ModuleInfo;
use naga::{AddressSpace, Block, ImageClass, Module, Statement, TypeInner};
use twinlight::gpu::parse;
use twinlight::gpu::wgsl::{FILES, Sources, join};

use super::root;

fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    fn collect(folder: &Path, ending: &str, out: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                collect(&path, ending, out);
            } else if path.extension().is_some_and(|e| e == ending) {
                out.push(path);
            }
        }
    }
    let mut all = Vec::new();
    collect(&root().join(folder), ending, &mut all);
    all.sort();
    assert!(!all.is_empty(), "nothing in {folder}");
    all
}

/// What kernels are for beside the usual.
const VARIANTS: [(&str, &[&str]); 11] = [
    ("raster/split", &["eye"]),
    ("raster/split", &["eye", "wide"]),
    ("raster/cut", &["torn"]),
    ("raster/cover", &["eye"]),
    ("raster/cover", &["subgroups"]),
    ("raster/cover", &["eye", "subgroups"]),
    ("raster/cover", &["fours"]),
    ("raster/cover", &["eye", "fours"]),
    ("raster/lace", &["images"]),
    ("raster/shade", &["images"]),
    ("trace/follow", &["images"]),
];

pub(super) fn kernels() -> Vec<(&'static str, Module, ModuleInfo)> {
    let with_entry = FILES.iter().filter(|(_, text)| text.contains("@compute"));
    let with_entry = with_entry.flat_map(|(name, _)| {
        let named = VARIANTS.iter().filter(move |(n, _)| n == name).map(|(_, variant)| *variant);
        std::iter::once(&[] as &[&str]).chain(named).map(move |variant| (*name, variant))
    });
    let parsed = with_entry.map(|(name, variant)| {
        let sources = variant.iter().fold(Sources::default(), |sources, what| sources.for_what(what));
        let joined = join(&sources.with_count("rows", 2), name).unwrap_or_else(|e| panic!("{e}"));
        let (module, info) = parse(&joined, name).unwrap_or_else(|e| panic!("{e}"));
        (name, module, info)
    });
    let all: Vec<_> = parsed.collect();
    assert!(all.len() >= 3, "where are the kernels?");
    all
}

#[test]
fn every_wgsl_file_is_built_in_and_used() {
    let on_disk: BTreeSet<String> = files("wgsl", "wgsl")
        .iter()
        .map(|p| {
            let name = p.strip_prefix(root().join("wgsl")).expect("below wgsl").with_extension("");
            name.to_string_lossy().replace('\\', "/")
        })
        .collect();
    let built_in: Vec<String> = FILES.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(built_in, on_disk.into_iter().collect::<Vec<_>>());
    for (name, text) in FILES.iter().filter(|(_, text)| !text.contains("@compute")) {
        let import = format!("#import \"{name}.wgsl\"");
        assert!(FILES.iter().any(|(_, t)| t.contains(&import)), "nothing imports {name}: {text}");
    }
}

fn images(module: &Module) -> usize {
    let is_image =
        |ty| matches!(module.types[ty].inner, TypeInner::Image { class: ImageClass::Storage { .. }, .. });
    module.global_variables.iter().filter(|(_, v)| is_image(v.ty)).count()
}

#[test]
fn kernels_lower_to_every_language() {
    for (name, module, info) in kernels() {
        let bounds = naga::proc::BoundsCheckPolicies::default();
        naga::back::spv::write_vec(&module, &info, &naga::back::spv::Options::default(), None)
            .unwrap_or_else(|e| panic!("{name} to SPIR-V: {e}"));
        let mut msl =
            naga::back::msl::Options { lang_version: (2, 4), bounds_check_policies: bounds, ..Default::default() };
        msl.fake_missing_bindings = true;
        // Images are for adapters that are programs, which Metal has none of, and naga cannot hand them to functions there.
        if images(&module) == 0 {
            naga::back::msl::write_string(&module, &info, &msl, &naga::back::msl::PipelineOptions::default())
                .unwrap_or_else(|e| panic!("{name} to MSL: {e}"));
        }
        let options = naga::back::hlsl::Options { fake_missing_bindings: true, ..Default::default() };
        let pipeline = naga::back::hlsl::PipelineOptions::default();
        let mut hlsl = String::new();
        naga::back::hlsl::Writer::new(&mut hlsl, &options, &pipeline)
            .write(&module, &info, None)
            .unwrap_or_else(|e| panic!("{name} to HLSL: {e}"));
    }
}

#[test]
fn kernels_keep_to_webgpus_default_limits() {
    for (name, module, info) in kernels() {
        let used = info.get_entry_point(0);
        let storage = module.global_variables.iter().filter(|(handle, _)| !used[*handle].is_empty());
        let storage = storage.filter(|(_, v)| matches!(v.space, AddressSpace::Storage { .. })).count();
        assert!(storage <= 8, "{name} binds {storage} storage buffers");
        let handles = module.global_variables.iter().filter(|(_, v)| v.space == AddressSpace::Handle).count();
        assert!(handles <= 16, "{name} binds {handles} textures");
        // More than WebGPU's four: such kernels are for adapters that have eight.
        assert!(images(&module) <= 8, "{name} binds {} images", images(&module));
        let shared = module.global_variables.iter().filter(|(_, v)| v.space == AddressSpace::WorkGroup);
        let bytes: u32 = shared.map(|(_, v)| module.types[v.ty].inner.size(module.to_ctx())).sum();
        assert!(bytes <= 16 << 10, "{name} takes {bytes} bytes of workgroup memory");
        for entry in &module.entry_points {
            assert_eq!(entry.name, "main", "{name}");
            assert!(entry.workgroup_size.iter().product::<u32>() <= 256, "{name}");
            // Their loops' bounds are the same for a whole workgroup: a constant, and a tile's list in a `read` binding.
            let uniform = ["raster/scan", "raster/cover"].contains(&name);
            assert!(!barrier_inside(&entry.function.body, false, uniform), "{name}: a barrier in a branch or loop");
        }
        for (_, function) in module.functions.iter() {
            assert!(!barrier_inside(&function.body, true, false), "{name}: a barrier in a function");
        }
    }
}

/// naga does not check that barriers stand in uniform control flow; this asks for the plainest form of it.
fn barrier_inside(block: &Block, inside: bool, uniform_loops: bool) -> bool {
    let within = |block: &Block, inside: bool| barrier_inside(block, inside, uniform_loops);
    block.iter().any(|statement| match statement {
        Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => inside,
        Statement::Block(block) => within(block, inside),
        Statement::If { accept, reject, .. } => within(accept, true) || within(reject, true),
        Statement::Loop { body, continuing, .. } => {
            let inside = inside || !uniform_loops;
            within(body, inside) || within(continuing, inside)
        }
        Statement::Switch { cases, .. } => cases.iter().any(|case| within(&case.body, true)),
        _ => false,
    })
}

#[test]
fn a_barrier_in_a_branch_is_seen() {
    let text = "@compute @workgroup_size(64) fn main(@builtin(local_invocation_index) i: u32) {
        if (i < 32u) { workgroupBarrier(); } }";
    let module = naga::front::wgsl::parse_str(text).expect("valid, as naga sees it");
    assert!(barrier_inside(&module.entry_points[0].function.body, false, true));
}

/// Where the twins of a folder of `wgsl/` stand in `src/`.
const TWINS: [(&str, &str); 6] = [
    ("film", "cpu/film"),
    ("math", "math"),
    ("raster", "cpu/raster"),
    ("shade", "cpu/shade"),
    ("tables", "tables"),
    ("trace", "cpu/trace"),
];

#[test]
fn every_wgsl_file_has_a_twin_and_every_twin_its_wgsl() {
    for (wgsl, rust) in TWINS {
        let stems = |folder: String, ending: &str| -> BTreeSet<String> {
            let direct = files(&folder, ending);
            direct.iter().map(|p| p.file_stem().expect("a name").to_string_lossy().into_owned()).collect()
        };
        let kernels = stems(format!("wgsl/{wgsl}"), "wgsl");
        let twins = stems(format!("src/{rust}"), "rs");
        assert_eq!(kernels, twins, "wgsl/{wgsl} and src/{rust}");
    }
    let known: BTreeSet<_> = TWINS.iter().map(|(wgsl, _)| *wgsl).collect();
    for (name, _) in FILES {
        assert!(known.contains(name.split('/').next().unwrap_or_default()), "{name} has no place for its twin");
    }
}

#[test]
fn twins_open_with_the_same_arrow() {
    for (wgsl, rust) in TWINS.into_iter().filter(|(wgsl, _)| *wgsl != "tables") {
        for path in files(&format!("wgsl/{wgsl}"), "wgsl") {
            let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let first = |path: &Path| {
                let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
                text.lines().next().unwrap_or_default().to_owned()
            };
            let kernel = first(&path);
            let twin = first(&root().join(format!("src/{rust}/{stem}.rs")));
            assert!(kernel.starts_with("// ") && kernel.contains(" -> "), "{}: {kernel}", path.display());
            assert_eq!(kernel.trim_start_matches("// "), twin.trim_start_matches("//! "), "{wgsl}/{stem}");
        }
    }
}

/// The numbers with a point and more digits than a few in a source text, without its comments and its tests.
fn numbers(text: &str) -> BTreeSet<u32> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default().lines();
    let code: Vec<_> = code.map(|line| line.split("//").next().unwrap_or_default()).collect();
    let code = code.join("\n").replace("f32::MAX", "3.4028235e38").replace('_', "");
    let words = code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.'));
    let words = words.filter(|word| word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('.'));
    // Those of a few digits are written in many ways: 1.0 in one, ONE in another.
    words.filter_map(|word| word.parse().ok()).map(f32::to_bits).filter(|bits| bits & 0xffff != 0).collect()
}

#[test]
fn twins_are_written_with_the_same_numbers() {
    let mut all = 0;
    for (wgsl, rust) in TWINS {
        for path in files(&format!("wgsl/{wgsl}"), "wgsl") {
            let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
            // Its twin's numbers are those of `film::Transfer`.
            if stem == "develop" {
                continue;
            }
            let read = |path: &Path| fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            let kernel = numbers(&read(&path));
            assert_eq!(kernel, numbers(&read(&root().join(format!("src/{rust}/{stem}.rs")))), "{wgsl}/{stem}");
            all += kernel.len();
        }
    }
    assert!(all > 20, "{all} numbers");
    let [one, other] = ["let a = 0.577_078; // 0.3", "let a = 0.5 * 0.57707802;"].map(numbers);
    assert_eq!(one.len(), 1);
    assert_ne!(one, other, "the next number of f32");
}

/// The floors: a file may use those below its own, never those above or beside it.
const FLOORS: [&[&str]; 8] = [
    &["math"],
    &["film", "scene", "tables"],
    &["prepare"],
    &["raster", "trace"],
    &["cpu", "gpu"],
    &["explain", "render"],
    &["view"],
    &["bin"],
];

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&module))
}

/// The modules of this crate that a source text names.
fn named(text: &str) -> BTreeSet<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let mut names = BTreeSet::new();
    for line in code {
        for prefix in ["crate::", "twinlight::"] {
            for after in line.split(prefix).skip(1) {
                let inner = after.strip_prefix('{').unwrap_or(after);
                let name: String = inner.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                names.insert(name);
            }
        }
    }
    names
}

#[test]
fn arrows_point_down() {
    for path in files("src", "rs") {
        let inside = path.strip_prefix(root().join("src")).expect("below src");
        let top = inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
        let module = top.trim_end_matches(".rs").to_owned();
        if module == "lib" {
            continue;
        }
        let own = floor(&module).unwrap_or_else(|| panic!("{module} stands on no floor"));
        let text = fs::read_to_string(&path).expect("a source file");
        for used in named(&text) {
            let Some(theirs) = floor(&used) else { continue };
            // Nouns may know each other; the rest of a floor are strangers.
            let beside = theirs == own && used != module && own != 1;
            assert!(theirs <= own && !beside, "{}: uses {used}", inside.display());
        }
        let alone = [("wgpu", "gpu"), ("naga", "gpu"), ("toml", "scene"), ("image", "film"), ("egui", "bin")];
        for (library, home) in alone {
            let used = text.contains(&format!("use {library}::")) || text.contains(&format!(" {library}::"));
            assert!(
                !used || module == home || (library == "image" && module == "scene"),
                "{}: {library}",
                inside.display()
            );
        }
    }
    assert_eq!(named("use crate::cpu::x;\n// crate::gpu\nlet a = crate::film::Film;").len(), 2);
}

#[test]
fn files_stay_small_and_promise_nothing_that_no_test_holds() {
    for (folder, ending, most) in [("src", "rs", 330), ("tests", "rs", 330), ("wgsl", "wgsl", 220)] {
        for path in files(folder, ending) {
            let text = fs::read_to_string(&path).expect("a source file");
            let lines = text.lines().count();
            assert!(lines <= most, "{}: {lines} lines: it is asking to be two", path.display());
            let banned = ["keep in ", "sync"].concat();
            assert!(!text.contains(&banned), "{}: write the test instead", path.display());
        }
    }
}
