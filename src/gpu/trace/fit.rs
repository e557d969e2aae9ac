//! a scene -> the tracer's kernels, written out for it

use crate::gpu::looks::looks;
use crate::gpu::wgsl::Sources;
use crate::tables::{CUT_OUT, DIFFUSE, GLASS, ONE_SIDED, PLANE, Tables};

/// The tracer's kernels for a scene: what it has none of is left out.
#[must_use]
pub fn fit(sources: &Sources, tables: &Tables) -> Sources {
    let has = |behavior| tables.materials.iter().any(|material| material.behavior == behavior);
    let pierced = |by| tables.leaves.iter().any(|leaf| leaf.kind > PLANE && leaf.kind & by != 0);
    let written_out = [
        ("diffuse", usize::from(has(DIFFUSE))),
        ("glass", usize::from(has(GLASS))),
        ("spheres", tables.spheres.len()),
        ("planes", tables.planes.len()),
        ("materials", tables.materials.len()),
        ("lights", tables.lights.len()),
        ("spheres_below", tables.spheres.len().min(1)),
        ("copies", tables.instances.len().min(1)),
        ("halvings", tables.instances.len().next_power_of_two().ilog2() as usize),
        ("pierced", usize::from(pierced(ONE_SIDED | CUT_OUT))),
        ("one_sided", usize::from(pierced(ONE_SIDED))),
        ("cut_out", usize::from(pierced(CUT_OUT))),
        ("deep", tables.deep as usize),
    ];
    let settings = &tables.settings;
    let sources = looks(sources.clone(), &tables.paints, settings.filtering, settings.specular);
    written_out.into_iter().fold(sources, |all, (kind, count)| all.with_count(kind, count as u32))
}
