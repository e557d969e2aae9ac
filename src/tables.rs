//! What both sides read: arrays of plain structs, equal to those of `wgsl/tables` name by name, offset by offset
//! (`tests/suite/layout.rs` holds them together).
//!
//! Each vector of three is followed by a scalar, so that no padding hides between them.

mod instance;
mod leaf;
mod lens;
mod light;
mod material;
mod mesh;
mod node;
mod paint;
mod path;
mod piece;
mod plane;
mod print;
mod settings;
mod slice;
mod sphere;
mod status;
mod texel;
mod view;

pub use instance::Instance;
pub use leaf::{INSTANCE, Leaf, PLANE, SPHERE, TRIANGLE};
pub use lens::{BIN, CELL, DEEP, Lens, MOST_ENTRIES, MOST_LENSES, NO_DEPTH, REGION, STEEPEST, TILE};
pub use light::{DIRECTIONAL, Light, NESTED, POINT};
pub use material::{DIFFUSE, GLASS, MIRROR, Material};
pub use mesh::{CUT_OUT, Face, ONE_SIDED, Part, Vertex};
pub use node::Node;
pub use paint::{
    BILINEAR, CLAMPED, Canvas, Lamp, MIPMAP, Map, NEAREST, Paint, SHOW_ALBEDO, SHOW_AMBIENT, SHOW_COLOR,
    SHOW_DEPTH, SHOW_DIFFUSE, SHOW_ID, SHOW_NORMAL, SHOW_SHADOW, SHOW_SPECULAR, SHOW_TILES, SHOW_UV, SHOW_WIRE,
};
pub use path::{DONE, FAR, IDLE, LIT, Path, SEEK, Waiting};
pub use piece::{Corner, MOST_CORNERS, PLANES, Piece, Tally};
pub use plane::Plane;
pub use print::{AS_IT_IS, Print, SRGB};
pub use settings::{BLINN, NONE, PHONG, Settings};
pub use slice::{GROUP, MOST_TURNS, Slice};
pub use sphere::Sphere;
pub use status::{CUT_SHORT, STACK_FULL, Status};
pub use texel::ROW;
pub use view::View;

/// A scene as both sides read it. Primitives are counted through: spheres, planes, triangles, then the models' own.
#[derive(Debug, Clone)]
pub struct Tables {
    /// The eye and the film.
    pub view: View,
    /// What is the same for every ray.
    pub settings: Settings,
    /// Samples a pixel.
    pub samples: u32,
    /// Primitives from number 0, for scenes of few things.
    pub spheres: Vec<Sphere>,
    /// Primitives after the spheres, for scenes of few things.
    pub planes: Vec<Plane>,
    /// All primitives: planes, then the others in the order of the tree, with boxes of instances among them; then
    /// those of the models that stand there, as the model has them.
    pub leaves: Vec<Leaf>,
    /// The tree over all primitives but planes, and over the boxes of instances; the root is the first. After it, the
    /// trees of the models that stand there.
    pub nodes: Vec<Node>,
    /// The most that a walk's stack holds: nodes on the longest way from the root down. With instances two for each,
    /// those of the deepest model's tree, and one place, the last, that says in which of the instances the walk is.
    pub deep: u32,
    /// The models' trees in their places, those with the lower ids first.
    pub instances: Vec<Instance>,
    /// What the primitives are made of.
    pub materials: Vec<Material>,
    /// What pictures are laid over each of the materials.
    pub paints: Vec<Paint>,
    /// All triangles, in the order of their numbers: the first is the one after the planes. After those that stand
    /// once, those of instances, as the model has them.
    pub faces: Vec<Face>,
    /// What they share.
    pub vertices: Vec<Vertex>,
    /// As a [`Drawing`]'s.
    pub texels: Vec<u32>,
    /// Where light comes from.
    pub lights: Vec<Light>,
    /// Whether a frame is made by the one stage for scenes of few things ([`Tables::are_few`]).
    pub few: bool,
    /// Whether the picture shows how many steps each ray takes.
    pub steps: bool,
}

/// The most spheres, planes, materials and lights, each, of a scene of few things.
pub const FEW: usize = 16;
/// The most intersection tests that a kernel is written out for: each light asks every primitive once more. On
/// lavapipe 21 take 0.1 s to compile, 40 take 0.8 s and 340 take 8 s.
const FEW_TESTS: usize = 48;

/// A scene of few things as one value: a uniform is read once for all lanes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Few {
    /// Primitives from number 0.
    pub spheres: [Sphere; FEW],
    /// Primitives after the spheres.
    pub planes: [Plane; FEW],
    /// What the primitives are made of.
    pub materials: [Material; FEW],
    /// Where light comes from.
    pub lights: [Light; FEW],
}

impl Tables {
    /// Whether there are so few things that it pays to write the kernel out for each of them.
    #[must_use]
    pub fn are_few(&self) -> bool {
        let most = [self.spheres.len(), self.planes.len(), self.materials.len(), self.lights.len()];
        let tests = (self.spheres.len() + self.planes.len()) * (1 + self.lights.len());
        self.leaves.len() == self.spheres.len() + self.planes.len()
            && most.into_iter().all(|count| count <= FEW)
            && tests <= FEW_TESTS
            && self.paints.iter().all(Paint::is_bare)
    }

    /// All bytes that a picture hangs on, part by part.
    pub fn each_bytes(&self, to: &mut dyn FnMut(&[u8])) {
        // Taken apart by name, so that what is added to the tables is not forgotten here.
        let Self {
            view,
            settings,
            samples,
            spheres,
            planes,
            leaves,
            nodes,
            deep: _,
            instances,
            materials,
            paints,
            faces,
            vertices,
            texels,
            lights,
            few: _,
            steps,
        } = self;
        to(bytemuck::bytes_of(view));
        to(bytemuck::bytes_of(settings));
        to(bytemuck::bytes_of(samples));
        to(bytemuck::cast_slice(spheres));
        to(bytemuck::cast_slice(planes));
        to(bytemuck::cast_slice(leaves));
        to(bytemuck::cast_slice(nodes));
        to(bytemuck::cast_slice(instances));
        to(bytemuck::cast_slice(materials));
        to(bytemuck::cast_slice(paints));
        to(bytemuck::cast_slice(faces));
        to(bytemuck::cast_slice(vertices));
        to(bytemuck::cast_slice(texels));
        to(bytemuck::cast_slice(lights));
        to(&[u8::from(*steps)]);
    }

    /// The first [`FEW`] of everything; the rest is zero.
    #[must_use]
    pub fn scene(&self) -> Few {
        fn first<T: bytemuck::Zeroable + Copy>(of: &[T]) -> [T; FEW] {
            std::array::from_fn(|i| of.get(i).copied().unwrap_or_else(T::zeroed))
        }
        Few {
            spheres: first(&self.spheres),
            planes: first(&self.planes),
            materials: first(&self.materials),
            lights: first(&self.lights),
        }
    }
}

/// A scene as the rasterizer reads it.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// The eye's lenses: for each region of the film, row by row, one for each sample of a pixel.
    pub eyes: Vec<Lens>,
    /// Pixels that are drawn at once, at most.
    pub most: u32,
    /// The lights' lenses, at most [`MOST_LENSES`]; their depths lie one after the other in one buffer.
    pub lenses: Vec<Lens>,
    /// How pixels are colored.
    pub canvas: Canvas,
    /// What faces share.
    pub vertices: Vec<Vertex>,
    /// What is drawn.
    pub faces: Vec<Face>,
    /// What faces are made of.
    pub paints: Vec<Paint>,
    /// Where light comes from.
    pub lamps: Vec<Lamp>,
    /// 256 words of the curve by which colors are decoded, as bits of f32; then texels, red in the lowest byte.
    pub texels: Vec<u32>,
}

impl Drawing {
    /// All bytes that a picture hangs on, part by part.
    pub fn each_bytes(&self, to: &mut dyn FnMut(&[u8])) {
        // How much is drawn at once does not show.
        let Self { eyes, most: _, lenses, canvas, vertices, faces, paints, lamps, texels } = self;
        to(bytemuck::cast_slice(eyes));
        to(bytemuck::cast_slice(lenses));
        to(bytemuck::bytes_of(canvas));
        to(bytemuck::cast_slice(vertices));
        to(bytemuck::cast_slice(faces));
        to(bytemuck::cast_slice(paints));
        to(bytemuck::cast_slice(lamps));
        to(bytemuck::cast_slice(texels));
    }

    /// Whether any face is cut out.
    #[must_use]
    pub fn laced(&self) -> bool {
        self.faces.iter().any(|face| face.paint & CUT_OUT != 0)
    }

    /// Words of all the lights' depths.
    #[must_use]
    pub fn shadow_words(&self) -> usize {
        self.lenses.iter().map(Lens::pixels).sum::<u32>() as usize
    }
}
