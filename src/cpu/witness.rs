//! what a twin has in hand where a color comes about -> whoever asks how it does

use glam::{Vec2, Vec3, Vec4};
use serde::Serialize;

use crate::cpu::trace::scatter::Branch;
use crate::cpu::trace::surface::Surface;
use crate::cpu::trace::tree::Lit;
use crate::tables::Path;

/// Is told what the twins compute with, while they compute: what it hears is what the picture is made of.
///
/// Pictures are made before `()`, which listens to nothing and costs nothing.
pub trait Witness {
    /// What a map says at the fragment in hand.
    fn texel(&mut self, _of: Picture, _value: Vec3) {}
    /// T and B of the tangent space at the fragment in hand; N is its smooth normal.
    fn tangents(&mut self, _tangents: [Vec3; 2]) {}
    /// A fragment, before any light is asked.
    fn fragment(&mut self, _told: &Fragment) {}
    /// Where the light in hand looks for what stands between; not told of a light that casts no shadow.
    fn shadow(&mut self, _told: &Sight) {}
    /// What a light gives to the fragment in hand.
    fn lamp(&mut self, _told: &Term) {}
    /// What is added to the pixel's sum.
    fn color(&mut self, _color: Vec3) {}

    /// What a ray of the tree meets: told once or more, before anything comes of it.
    fn met(&mut self, _ray: &Path, _t: f32, _surface: &Surface) {}
    /// A ray that meets nothing, and the light that it gets from the background.
    fn missed(&mut self, _ray: &Path, _light: Vec3) {}
    /// What a light gives to the surface in hand, and whether it gets there.
    fn light(&mut self, _told: &Lit, _arrives: bool) {}
    /// The two ways on from the surface in hand.
    fn fork(&mut self, _told: &Fork) {}
}

impl Witness for () {}

/// The ways on from a surface, as a ray tree takes them.
#[derive(Debug, Clone, Copy)]
pub struct Fork {
    /// Two numbers in [0, 1) of the ray's own.
    pub random: Vec2,
    /// The way that counts for more, and the other; their weights are those in the pixel.
    pub ways: [Branch; 2],
    /// Whether the first of them is the refracted one.
    pub swapped: bool,
    /// Which of them are followed: those that count for more than the cutoff.
    pub goes: [bool; 2],
    /// Whether the branch ends here, at the greatest depth, and gets the background for what is not followed.
    pub ends: Option<Vec3>,
}

/// A picture laid over a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Picture {
    /// Colors.
    Diffuse,
    /// Weights of the specular term.
    Specular,
    /// Shares of the exponent, in x.
    Exponent,
    /// Normals in tangent space, as n/2 + 1/2.
    Normal,
}

/// A point of a face, as the light falls onto it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Fragment {
    /// The face's corners A, B, C in clip space; w is their distance along the view, the spec's Z.
    pub clip: [Vec4; 3],
    /// alpha, beta, gamma of Eq. 1.5.
    pub weights: Vec3,
    /// In world space.
    pub point: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// The surface's own color: the spec's "diffuse".
    pub albedo: Vec3,
    /// Weight of the specular term.
    pub specular: Vec3,
    /// The specular exponent k.
    pub exponent: f32,
    /// The corners' normals by their weights, of length one: N of the tangent space.
    pub smooth: Vec3,
    /// The normal that light falls onto, of length one, on the eye's side.
    pub normal: Vec3,
    /// To the eye, of length one.
    pub view: Vec3,
}

/// A fragment as a light sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sight {
    /// Which of the lights' lenses.
    pub lens: u32,
    /// In the light's clip space.
    pub clip: Vec4,
    /// Where on its shadow map; nothing if it lies beyond what the light sees, and so is lit.
    pub texel: Option<Texel>,
}

/// A fragment's place on a shadow map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Texel {
    /// From the left.
    pub column: i32,
    /// From the top.
    pub row: i32,
    /// The fragment's depth less the lens's bias, of [`DEEP`](crate::tables::DEEP).
    pub depth: u32,
    /// Of the texels that are asked, those where nothing stands before the fragment.
    pub open: u32,
    /// Texels that are asked: one, or with blur those around it as well.
    pub asked: u32,
}

/// What one light gives to a fragment.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Term {
    /// To the light, of length one.
    pub toward: Vec3,
    /// The share of the light that reaches the fragment, from 0 to 1.
    pub share: f32,
    /// Color times intensity, after the shadow.
    pub power: Vec3,
    /// max(0, cos theta) and max(0, cos^k alpha).
    pub phong: [f32; 2],
    /// The diffuse term, before the surface's own color.
    pub diffuse: Vec3,
    /// The specular term, before the surface's own color.
    pub specular: Vec3,
}
