//! OBJ file + MTL files + pictures -> [`Model`]: plain indexed triangles, checked once and for all.
//!
//! Whoever holds a [`Model`] may index without looking: every index is in range, every number finite,
//! every normal one unit long. Whatever stood in the files and is not in the model is in
//! [`Model::warnings`], with its file and line; what no model can be made of is an [`Error`].
//!
//! ```text
//! bytes -> lines -> obj (polygon) -> normals -> find -> mtl -> texture (bump) -> Model
//! ```
//!
//! The parser is our own because tobj 4.0.5 loses what we promise to keep: it gives each material and
//! group positions of its own (so that shared edges stop being shared), drops smoothing groups, fans
//! concave polygons, names no line in its errors, refuses a blank `usemtl` and non-UTF-8 comments, and
//! panics on `Kd 0.5`. It is the oracle of our tests.

mod budget;
pub mod bump;
mod confined;
mod error;
mod far;
mod find;
mod library;
pub mod lines;
mod map;
pub mod mtl;
mod normals;
pub mod obj;
pub mod polygon;
pub mod texture;
mod warning;

use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use glam::{Vec2, Vec3};

pub use budget::{Budget, Limits};
pub use confined::{Confined, Refusal};
pub use error::Error;
pub use find::Finder;
pub(super) use find::read;
pub use warning::{Warning, Warnings};

/// The index that stands for "none given": see [`Corner::uv`].
pub const NONE: u32 = u32::MAX;

/// A model as it stands in memory.
///
/// Positions and normals are in model space, right-handed, y up, in the file's own unit of length.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Model {
    /// One for each `v` line, in the file's order, so that corners that share a `v` share an index.
    /// All finite. Some may belong to no triangle.
    pub positions: Vec<Vec3>,
    /// One for each `vt` line: u to the right, **v up**, 0..1 over the picture and beyond it.
    pub uvs: Vec<Vec2>,
    /// One for each `vn` line, made one unit long, then the ones that we worked out ourselves.
    pub normals: Vec<Vec3>,
    /// In the file's order, counterclockwise seen from outside.
    pub triangles: Vec<Triangle>,
    /// Number 0 is the default material, of triangles that name none.
    pub materials: Vec<Material>,
    /// The pictures that the materials' maps point into.
    pub textures: Vec<Texture>,
    /// The names of `o` and `g` lines; number 0 is "", of triangles before the first such line.
    pub groups: Vec<String>,
    /// What was passed over or replaced, at most [`Warnings::MOST`] different ones.
    pub warnings: Vec<Warning>,
}

impl Model {
    /// The corner's texture coordinates; (0, 0) where the file gives none.
    #[must_use]
    pub fn uv(&self, corner: Corner) -> Vec2 {
        self.uvs.get(corner.uv as usize).copied().unwrap_or(Vec2::ZERO)
    }
}

/// Three corners and what they are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Counterclockwise seen from outside.
    pub corners: [Corner; 3],
    /// Index into [`Model::materials`].
    pub material: u32,
    /// Index into [`Model::groups`].
    pub group: u32,
}

/// One corner of a triangle, as indices into the model's three lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// Index into [`Model::positions`].
    pub position: u32,
    /// Index into [`Model::uvs`], or [`NONE`]; [`Model::uv`] answers for both.
    pub uv: u32,
    /// Index into [`Model::normals`]; never [`NONE`] in a finished model.
    pub normal: u32,
}

/// A material of the MTL file. Colors stand as written: 0..1, neither converted nor clamped above.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name after `newmtl`; "" for the default material.
    pub name: String,
    /// `Ka`.
    pub ambient: Vec3,
    /// `Kd`; multiplies [`Material::diffuse_map`].
    pub diffuse: Vec3,
    /// `Ks`; multiplies [`Material::specular_map`].
    pub specular: Vec3,
    /// `Ke`.
    pub emission: Vec3,
    /// `Ns`, Phong's exponent, at least 0; multiplies [`Material::exponent_map`].
    pub exponent: f32,
    /// `d` or 1 - `Tr`: 1 hides what is behind, 0 is not there at all.
    pub opacity: f32,
    /// `Ni`: vacuum is 1, glass about 1.5.
    pub refraction_index: f32,
    /// `illum`, the illumination model's number, where the file names one. 0 and 1 are without highlights: `Ks` is 0.
    pub illumination: Option<u32>,
    /// `map_Kd`.
    pub diffuse_map: Option<Map>,
    /// `map_Ks`.
    pub specular_map: Option<Map>,
    /// `map_Ns`, one number a texel, to be read from red.
    pub exponent_map: Option<Map>,
    /// `map_d`: alpha where [`Texture::has_alpha`], else red.
    pub opacity_map: Option<Map>,
    /// `norm`, or `map_Bump`/`bump` (see [`bump`]): tangent space, +x along u, +y along v (up).
    pub normal_map: Option<Map>,
}

impl Material {
    /// Light gray and dull: a shape can be judged by it, and nobody takes it for a color of the file.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ambient: Vec3::ZERO,
            diffuse: Vec3::splat(0.8),
            specular: Vec3::ZERO,
            emission: Vec3::ZERO,
            exponent: 10.0,
            opacity: 1.0,
            refraction_index: 1.0,
            illumination: None,
            diffuse_map: None,
            specular_map: None,
            exponent_map: None,
            opacity_map: None,
            normal_map: None,
        }
    }

    fn has_pictures(&self) -> bool {
        let Self { diffuse_map, specular_map, exponent_map, opacity_map, normal_map, .. } = self;
        [diffuse_map, specular_map, exponent_map, opacity_map, normal_map].into_iter().any(Option::is_some)
    }
}

/// A picture laid over a material: texel at `(uv * scale + offset)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    /// Index into [`Model::textures`].
    pub texture: u32,
    /// `-s`, 1 by default.
    pub scale: Vec2,
    /// `-o`, 0 by default.
    pub offset: Vec2,
    /// `-clamp on`: outside 0..1 the texels of the edge go on, as what most programs make of it; otherwise the picture
    /// repeats.
    pub clamp: bool,
    /// `-bm` of a normal map: multiplies its x and y. 1 for all else (a height map's is already in it).
    pub strength: f32,
}

/// A decoded picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// Where it came from, relative to the scene's folder; "" for the checkerboard of missing files.
    pub file: String,
    /// What the numbers mean.
    pub content: Content,
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row by row, **top row first** (so v = 1 is at the start), red green blue alpha. Two textures of
    /// one file but of different content share them.
    pub texels: Arc<[[u8; 4]]>,
    /// Whether its alpha says how opaque it is: it has an alpha channel, and is in color or not opaque everywhere.
    pub has_alpha: bool,
}

/// What a texture's numbers mean, and so whether they are gamma-encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Content {
    /// Colors in sRGB encoding.
    Color,
    /// Plain numbers 0..1, linear.
    Scalar,
    /// Unit vectors n as n/2 + 1/2, linear.
    Normal,
}

/// Reads the OBJ file `path` (relative to `folder`) and all that it refers to.
///
/// # Errors
/// [`Error`] names file and line, what was found and what would be right. What can be passed over or
/// replaced (a missing MTL file or picture, an unknown statement, a vertex that is not finite) is a
/// warning instead.
pub fn read_model(path: &Path, folder: &Confined, limits: &Limits) -> Result<Model, Error> {
    let name = path.display().to_string();
    let as_text = path.to_str().ok_or(Refusal::Missing);
    let relative = as_text.and_then(|path| Confined::relative(Path::new(""), path));
    let relative = relative.map_err(|why| Error::unread(&name, &why))?;
    let opened = folder.open(&relative).map_err(|why| Error::unread(&name, &why))?;
    if opened.bytes > limits.obj_bytes {
        return Err(Error::too_much(&name, 0, "bytes in this file", limits.obj_bytes));
    }
    let (mut warnings, mut budget) = (Warnings::default(), Budget::new(limits));
    // The file may grow while it is read; what is beyond the limit is never looked at.
    let source = opened.file.take(limits.obj_bytes);
    let mesh = mesh(source, &name, limits, &mut budget, &mut warnings)?;

    let mut finder = Finder::new(folder, &relative);
    let sheets = finder.libraries(&mesh, &name, limits, &mut warnings);
    let written = library::Library::read(&sheets, limits, &mut warnings);
    let mut pictures = texture::Pictures::new(finder, limits, &mut budget);
    let mut materials = Vec::with_capacity(mesh.materials.len());
    for (wanted, line) in &mesh.materials {
        materials.push(match written.find(wanted, &name, *line, &mut warnings) {
            Some(found) => pictures.dress(found, &mut warnings),
            None => Material::named(wanted),
        });
    }
    for (number, flat) in without_places(&mesh, &materials) {
        let (material, line) = &mesh.materials[number];
        let material = lines::quote(material.as_bytes());
        let text =
            format!("{flat} triangles of material {material}, which has pictures, have no `vt`: each is one color");
        warnings.add(&name, *line, text);
    }
    let textures = pictures.into_textures();
    Ok(model(mesh, materials, textures, warnings))
}

/// Which of the materials have pictures, and on how many triangles these have no place.
fn without_places(mesh: &obj::Mesh, materials: &[Material]) -> Vec<(usize, usize)> {
    let mut counts = vec![0; materials.len()];
    let bare = |t: &&Triangle| t.corners.iter().any(|corner| corner.uv == NONE);
    for triangle in mesh.triangles.iter().filter(bare) {
        counts[triangle.material as usize] += 1;
    }
    let counts = counts.into_iter().enumerate();
    counts.filter(|&(i, count)| count > 0 && materials[i].has_pictures()).collect()
}

/// Reads an OBJ text that has no folder around it; `file` is its name in messages. Nothing else is read:
/// its materials have their names and are light gray.
///
/// # Errors
/// As [`read_model`].
pub fn read_text(source: impl Read, file: &str, limits: &Limits) -> Result<Model, Error> {
    let mut warnings = Warnings::default();
    let mesh = mesh(source, file, limits, &mut Budget::new(limits), &mut warnings)?;
    for (_, line) in &mesh.libraries {
        warnings.add(file, *line, "a text without a folder has no MTL files");
    }
    let materials = mesh.materials.iter().map(|(name, _)| Material::named(name)).collect();
    Ok(model(mesh, materials, Vec::new(), warnings))
}

fn mesh(
    source: impl Read,
    file: &str,
    limits: &Limits,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<obj::Mesh, Error> {
    let mut mesh = obj::parse(source, file, limits, budget, warnings)?;
    normals::complete(&mut mesh, file, budget, warnings)?;
    Ok(mesh)
}

fn model(mesh: obj::Mesh, materials: Vec<Material>, textures: Vec<Texture>, warnings: Warnings) -> Model {
    Model {
        positions: mesh.positions,
        uvs: mesh.uvs,
        normals: mesh.normals,
        triangles: mesh.triangles,
        materials,
        textures,
        groups: mesh.groups,
        warnings: warnings.into_vec(),
    }
}
