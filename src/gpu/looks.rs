//! paints, and how their pictures are read -> what kernels are written out for

use super::wgsl::Sources;
use crate::tables::{Map, NONE, Paint};

/// What no paint has is left out, and what is the same for all of a frame is a constant: lavapipe runs both sides of
/// every `if`, and compiles a kernel anew for every dispatch in which one hangs on uniforms alone.
pub(super) fn looks(sources: Sources, paints: &[Paint], filtering: u32, specular: u32) -> Sources {
    let has = |map: fn(&Paint) -> &Map| paints.iter().any(|paint| map(paint).first != NONE);
    let needs = [
        ("colors", has(|paint| &paint.diffuse_map)),
        ("bumps", has(|paint| &paint.normal_map)),
        ("gloss", has(|paint| &paint.specular_map)),
        ("sharpness", has(|paint| &paint.exponent_map)),
    ];
    let sources = sources.with_count("filtering", filtering).with_count("specular", specular);
    needs.into_iter().fold(sources, |all, (kind, is)| all.with_count(kind, u32::from(is)))
}
