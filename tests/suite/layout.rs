//! Rust tables equal WGSL structs: names, offsets, sizes and constants.

use naga::{Literal, Module, TypeInner};
use twinlight::gpu::wgsl::{FILES, Sources, join};
use twinlight::tables::{
    self, Canvas, Corner, Face, Few, Instance, Lamp, Leaf, Lens, Light, Map, Material, Node, Paint, Part, Path,
    Piece, Plane, Print, Settings, Slice, Sphere, Status, Tally, Vertex, View, Waiting,
};

/// All tables in one module.
fn module() -> Module {
    let tables = FILES.iter().filter(|(name, _)| name.starts_with("tables/"));
    let imports: Vec<_> = tables.map(|(name, _)| format!("#import \"{name}.wgsl\"\n")).collect();
    let text =
        join(&Sources::default().with("all", imports.concat()), "all").unwrap_or_else(|e| panic!("{e}")).text;
    naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)))
}

#[derive(Debug, PartialEq)]
struct Layout {
    fields: Vec<(String, u32)>,
    size: u32,
}

fn in_wgsl(module: &Module, name: &str) -> Layout {
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let (_, ty) = found.unwrap_or_else(|| panic!("wgsl/tables has no struct {name}"));
    let TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
    let fields = members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect();
    Layout { fields, size: *span }
}

macro_rules! mirror {
    ($module:expr, $ty:ident { $($field:ident),+ $(,)? }) => {{
        // A field that is forgotten here does not compile.
        let _ = |$ty { $($field: _),+ }: $ty| ();
        let fields = vec![$((stringify!($field).to_owned(), core::mem::offset_of!($ty, $field) as u32)),+];
        let rust = Layout { fields, size: size_of::<$ty>() as u32 };
        assert_eq!(in_wgsl(&$module, stringify!($ty)), rust, "{}", stringify!($ty));
        1
    }};
}

#[test]
#[expect(clippy::too_many_lines, reason = "one list of all tables")]
fn structs_are_the_same() {
    let module = module();
    let mirrored = [
        mirror!(module, Light { place, kind, power, pad }),
        mirror!(
            module,
            Material { color, local_weight, tint, reflect_weight, refract_weight, exponent, index, behavior }
        ),
        mirror!(
            module,
            Path {
                origin,
                leaves,
                direction,
                t,
                weight,
                depth,
                radiance,
                inside,
                state,
                sample,
                hit,
                next,
                light,
                waiting,
                rays,
                seen
            }
        ),
        mirror!(module, Waiting { origin, leaves, direction, depth, weight, inside }),
        mirror!(module, Plane { point, material, normal, pad }),
        mirror!(
            module,
            Settings {
                background,
                max_depth,
                spheres,
                planes,
                lights,
                specular,
                low,
                cutoff,
                high,
                zero,
                filtering,
                instances,
                loose,
                pad
            }
        ),
        mirror!(module, Slice { first, count, samples, budget }),
        mirror!(module, Sphere { center, radius, material, pad_a, pad_b }),
        mirror!(module, Status { groups, pixels, flags, turns }),
        mirror!(
            module,
            Instance { x, root, y, leaves, z, id, origin, face, low, material, high, shrink, margin, count, pad }
        ),
        mirror!(module, Leaf { a, id, b, material, c, kind }),
        mirror!(
            module,
            Node { corner, steps, children, leaves, inner, held, low_x, low_y, low_z, high_x, high_y, high_z }
        ),
        mirror!(
            module,
            Lens {
                x,
                y,
                z,
                w,
                width,
                height,
                first,
                columns,
                cull,
                zero,
                bias,
                slope,
                guard_x,
                guard_y,
                small,
                round,
                span_x,
                span_y,
                left,
                top
            }
        ),
        mirror!(module, Vertex { position, u, normal, v }),
        mirror!(module, Face { a, b, c, paint }),
        mirror!(module, Part { first, faces, vertices, begin }),
        mirror!(module, Corner { at, code }),
        mirror!(module, Piece { a, id, b, column, c, row }),
        mirror!(module, Tally { late, pieces, entries, longest, busy, groups, shown, bare }),
        mirror!(module, Map { first, width, height, levels, scale, shift }),
        mirror!(
            module,
            Paint {
                color,
                exponent,
                specular,
                bump,
                diffuse_map,
                normal_map,
                specular_map,
                exponent_map,
                opacity_map
            }
        ),
        mirror!(module, Lamp { place, kind, power, lens }),
        mirror!(
            module,
            Canvas {
                eye,
                lamps,
                background,
                specular,
                ambient,
                shade,
                filtering,
                blur,
                show,
                depth_times,
                depth_plus,
                depth_least,
                depth_most,
                pad
            }
        ),
        mirror!(module, Print { width, height, across, down, pitch, transfer, pad }),
        mirror!(module, View { eye, width, right, height, up, grid, back, seed, inside, pad_a, pad_b }),
    ];
    let structs = module.types.iter().filter(|(_, ty)| matches!(ty.inner, TypeInner::Struct { .. })).count();
    assert_eq!(mirrored.len(), structs, "a struct of wgsl/tables has no mirror here");
}

#[test]
fn the_scene_as_one_uniform_is_the_same() {
    let text = join(&Sources::default(), "trace/few").unwrap_or_else(|e| panic!("{e}")).text;
    let module = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    mirror!(module, Few { spheres, planes, materials, lights });
}

#[test]
fn constants_are_the_same() {
    let module = module();
    let value = |name: &str| {
        let found = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some(name));
        let (_, constant) = found.unwrap_or_else(|| panic!("wgsl/tables has no constant {name}"));
        match module.global_expressions[constant.init] {
            naga::Expression::Literal(Literal::U32(n)) => n,
            naga::Expression::Literal(Literal::F32(x)) => x.to_bits(),
            ref other => panic!("{name} is {other:?}"),
        }
    };
    macro_rules! same {
        ($($name:ident),+ $(,)?) => {
            [$({
                assert_eq!(value(stringify!($name)), tables::$name as u32, "{}", stringify!($name));
            }),+].len()
        };
    }
    assert_eq!(value("FAR"), tables::FAR.to_bits());
    let checked = 1 + same!(
        TRIANGLE,
        SPHERE,
        PLANE,
        INSTANCE,
        POINT,
        DIRECTIONAL,
        NESTED,
        MIRROR,
        DIFFUSE,
        GLASS,
        IDLE,
        SEEK,
        LIT,
        DONE,
        PHONG,
        BLINN,
        NONE,
        MOST_TURNS,
        GROUP,
        CUT_SHORT,
        STACK_FULL,
        DEEP,
        NO_DEPTH,
        CELL,
        TILE,
        BIN,
        MOST_ENTRIES,
        REGION,
        ROW,
        MOST_LENSES,
        STEEPEST,
        ONE_SIDED,
        CUT_OUT,
        PLANES,
        MOST_CORNERS,
        CLAMPED,
        NEAREST,
        BILINEAR,
        MIPMAP,
        SHOW_COLOR,
        SHOW_DEPTH,
        SHOW_SHADOW,
        SHOW_NORMAL,
        SHOW_UV,
        SHOW_ALBEDO,
        SHOW_AMBIENT,
        SHOW_DIFFUSE,
        SHOW_SPECULAR,
        SHOW_ID,
        SHOW_TILES,
        SHOW_WIRE,
        AS_IT_IS,
        SRGB
    );
    assert_eq!(checked, module.constants.iter().count(), "a constant of wgsl/tables is not checked here");
}

#[test]
fn a_swapped_field_is_seen() {
    let text = "struct Slice { count: u32, first: u32, samples: u32, budget: u32 }
        @compute @workgroup_size(1) fn main() { var s: Slice; s.first = 1u; }";
    let swapped = naga::front::wgsl::parse_str(text).expect("valid");
    assert_ne!(in_wgsl(&swapped, "Slice"), in_wgsl(&module(), "Slice"));
}
