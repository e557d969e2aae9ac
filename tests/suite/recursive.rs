//! The spec's ray tracer, word for word: recursive, one object behind each pointer, on one thread.
//!
//! In f64 it is the oracle of the tests (`oracle.rs`), in f32 the peer of the bench (`benches/room.rs`): whoever
//! includes it says what `Real` and `Vector` are. It shares nothing with the twins but the scene.

use twinlight::scene::{Behavior, Light, Material, Scene, Specular};

use super::{Real, Vector, real, vector};

trait Object {
    /// The least distance above `least` at which a ray of length-one direction meets it.
    fn meet(&self, origin: Vector, direction: Vector, least: Real) -> Option<Real>;
    fn normal(&self, point: Vector) -> Vector;
    fn material(&self) -> &Material;
}

struct Sphere<'a> {
    center: Vector,
    radius: Real,
    material: &'a Material,
}

impl Object for Sphere<'_> {
    fn meet(&self, origin: Vector, direction: Vector, least: Real) -> Option<Real> {
        let e = origin - self.center;
        let b = direction.dot(e);
        let root = b * b - (e.dot(e) - self.radius * self.radius);
        if root < 0.0 {
            return None;
        }
        let root = root.sqrt();
        [-b - root, -b + root].into_iter().find(|&t| t > least)
    }

    fn normal(&self, point: Vector) -> Vector {
        (point - self.center).normalize()
    }

    fn material(&self) -> &Material {
        self.material
    }
}

struct Plane<'a> {
    point: Vector,
    normal: Vector,
    material: &'a Material,
}

impl Object for Plane<'_> {
    fn meet(&self, origin: Vector, direction: Vector, least: Real) -> Option<Real> {
        let t = self.normal.dot(self.point - origin) / self.normal.dot(direction);
        (t > least && t.is_finite()).then_some(t)
    }

    fn normal(&self, _: Vector) -> Vector {
        self.normal
    }

    fn material(&self) -> &Material {
        self.material
    }
}

struct Triangle<'a> {
    corners: [Vector; 3],
    normal: Vector,
    material: &'a Material,
}

impl Object for Triangle<'_> {
    fn meet(&self, origin: Vector, direction: Vector, least: Real) -> Option<Real> {
        let [a, b, c] = self.corners;
        let t = self.normal.dot(a - origin) / self.normal.dot(direction);
        let p = origin + direction * t;
        // The spec's inside test (2.3).
        let (ab, bc, ca) = ((a - p).cross(b - p), (b - p).cross(c - p), (c - p).cross(a - p));
        let inside = ab.dot(bc) > 0.0 && ab.dot(ca) > 0.0 && bc.dot(ca) > 0.0;
        (t > least && inside).then_some(t)
    }

    fn normal(&self, _: Vector) -> Vector {
        self.normal
    }

    fn material(&self) -> &Material {
        self.material
    }
}

/// A scene as a list of objects.
pub(crate) struct Recursive<'a> {
    scene: &'a Scene,
    objects: Vec<Box<dyn Object + 'a>>,
    /// How far a ray gets before it meets anything.
    least: Real,
}

impl<'a> Recursive<'a> {
    /// Primitives in the order of their ids: spheres, planes, triangles.
    pub(crate) fn new(scene: &'a Scene, least: Real) -> Self {
        let mut objects: Vec<Box<dyn Object + 'a>> = Vec::new();
        for s in &scene.spheres {
            let material = &scene.materials[s.material];
            objects.push(Box::new(Sphere { center: vector(s.center), radius: real(s.radius), material }));
        }
        for p in &scene.planes {
            let material = &scene.materials[p.material];
            objects.push(Box::new(Plane {
                point: vector(p.point),
                normal: vector(p.normal).normalize(),
                material,
            }));
        }
        for t in &scene.triangles {
            let corners = t.vertices.map(vector);
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize();
            objects.push(Box::new(Triangle { corners, normal, material: &scene.materials[t.material] }));
        }
        Self { scene, objects, least }
    }

    /// The nearest object and its distance.
    pub(crate) fn nearest(&self, origin: Vector, direction: Vector) -> Option<(usize, Real)> {
        let mut nearest = None;
        for (i, object) in self.objects.iter().enumerate() {
            if let Some(t) = object.meet(origin, direction, self.least)
                && nearest.is_none_or(|(_, best)| t < best)
            {
                nearest = Some((i, t));
            }
        }
        nearest
    }

    fn lit(&self, point: Vector, toward: Vector, reach: Real) -> bool {
        self.objects.iter().all(|object| object.meet(point, toward, self.least).is_none_or(|t| t >= reach))
    }

    /// The color of a ray (spec 2.1), `depth` rays from the end.
    pub(crate) fn trace(&self, origin: Vector, direction: Vector, inside: bool, depth: u32) -> Vector {
        let background = vector(self.scene.film.background);
        if depth == 0 {
            return background;
        }
        let Some((hit, t)) = self.nearest(origin, direction) else { return background };
        let object = &self.objects[hit];
        let point = origin + direction * t;
        let mut n = object.normal(point);
        if n.dot(direction) > 0.0 {
            n = -n;
        }
        let material = object.material();
        let mut sum = Vector::ZERO;
        if !inside {
            for light in &self.scene.lights {
                sum += self.local(material, point, n, -direction, light);
            }
        }
        let reflection = direction - n * (2.0 * n.dot(direction));
        let mut reflect = real(material.reflect);
        if material.behavior == Behavior::Glass {
            let ratio = if inside { real(material.index) } else { 1.0 / real(material.index) };
            let cosine = direction.dot(n);
            let root = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
            if root < 0.0 {
                reflect += real(material.refract);
            } else if material.refract > 0.0 {
                let refracted = (direction * ratio - n * (ratio * cosine + root.sqrt())).normalize();
                sum += self.trace(point, refracted, !inside, depth - 1) * real(material.refract);
            }
        }
        if reflect > 0.0 {
            sum += self.trace(point, reflection, inside, depth - 1) * reflect;
        }
        sum
    }

    fn local(&self, material: &Material, point: Vector, n: Vector, v: Vector, light: &Light) -> Vector {
        let (toward, reach, power) = match *light {
            Light::Point { position, power } => {
                let way = vector(position) - point;
                (way.normalize(), way.length(), power)
            }
            Light::Directional { toward, power, .. } => (vector(toward), Real::INFINITY, power),
        };
        if n.dot(toward) <= 0.0 || !self.lit(point, toward, reach) {
            return Vector::ZERO;
        }
        let cosine = match self.scene.trace.specular {
            Specular::Blinn => (toward + v).normalize().dot(n),
            Specular::Phong => (n * (2.0 * n.dot(toward)) - toward).dot(v),
        };
        let terms = n.dot(toward) + cosine.max(0.0).powf(real(material.exponent));
        vector(material.color) * vector(power) * (real(material.local) * terms)
    }
}
