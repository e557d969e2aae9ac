//! paints, and how their pictures are read -> what kernels are written out for

use super::wgsl::Sources;
use crate::tables::{BILINEAR, BLINN, MIPMAP, Map, NEAREST, NONE, PHONG, Paint};

/// What no paint has is left out, and so are the ways to read that are not asked for: lavapipe runs both sides of every
/// `if`.
pub(super) fn looks(sources: Sources, paints: &[Paint], filtering: u32, specular: u32) -> Sources {
    let has = |map: fn(&Paint) -> &Map| paints.iter().any(|paint| map(paint).first != NONE);
    let needs = [
        ("nearest", filtering == NEAREST),
        ("bilinear", filtering == BILINEAR),
        ("mipmap", filtering == MIPMAP),
        ("phong", specular == PHONG),
        ("blinn", specular == BLINN),
        ("colors", has(|paint| &paint.diffuse_map)),
        ("bumps", has(|paint| &paint.normal_map)),
        ("gloss", has(|paint| &paint.specular_map)),
        ("sharpness", has(|paint| &paint.exponent_map)),
    ];
    needs.into_iter().fold(sources, |all, (kind, is)| all.with_count(kind, u32::from(is)))
}
