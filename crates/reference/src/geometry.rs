//! What rays meet: triangles in world space under a bounding volume hierarchy, and spheres as they are.
//!
//! The hierarchy (crate `obvhs`) is f32 and decides only which triangles are looked at: its boxes are wide enough that
//! rounding hides none. Triangles and spheres are intersected in f64.

use std::borrow::Cow;
use std::f64::consts::{FRAC_1_PI, TAU};

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Vec3A};
use halfvector_scene::{Mesh, Object};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::ray::RayHit;
use pulp::{Arch, Simd, WithSimd};

use crate::directions::{BLOCK, Directions};
use crate::elementary::{atan2, choose};

/// A half line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    /// Unit.
    pub(crate) dir: DVec3,
}

/// What a ray is after, and where it comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// Distance along the ray.
    pub(crate) t: f64,
    /// Index of a triangle, or of a sphere after all triangles.
    pub(crate) primitive: u32,
}

/// The shortest way through a sphere's inside, in its own space.
const SPHERE_NEAREST: f64 = 1e-9;

/// No primitive: rays that start in empty space.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// A surface that rays meet.
#[derive(Debug)]
pub(crate) struct Body<'a> {
    /// Index of its material.
    pub(crate) material: usize,
    /// None where it is the sphere that the built-in mesh stands for.
    pub(crate) mesh: Option<Cow<'a, Mesh>>,
    /// Its vertices in world space, where its material displaces them.
    pub(crate) moved: Option<Vec<DVec3>>,
    /// Whether rays that meet its back go on.
    pub(crate) culled: bool,
    pub(crate) object: Object,
}

#[derive(Clone, Copy, Debug)]
struct Triangle {
    /// One corner and the ways to the other two, in world space.
    corner: DVec3,
    edges: [DVec3; 2],
    body: u32,
    culled: bool,
    /// Vertices of the mesh.
    vertices: [u32; 3],
}

#[derive(Clone, Copy, Debug)]
struct Sphere {
    body: u32,
    culled: bool,
    object_from_world: DMat4,
}

#[derive(Clone, Copy, Debug)]
struct Transform {
    world_from_object: DMat4,
    normal_from_object: DMat3,
    handedness: f64,
}

/// Everything that is drawn, ready for rays.
pub(crate) struct Geometry<'a> {
    pub(crate) bodies: Vec<Body<'a>>,
    transforms: Vec<Transform>,
    triangles: Vec<Triangle>,
    spheres: Vec<Sphere>,
    hierarchy: Bvh2,
    /// The shortest way that counts.
    nearest: f64,
}

/// What is asked of a point beside its position and normals.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Detail {
    /// Texture coordinates, and the position in object space.
    pub(crate) places: bool,
    pub(crate) tangents: bool,
    /// Colours of vertices.
    pub(crate) colors: bool,
}

impl Detail {
    /// What the one or the other asks for.
    pub(crate) fn and(self, other: Detail) -> Detail {
        Detail {
            places: self.places || other.places,
            tangents: self.tangents || other.tangents,
            colors: self.colors || other.colors,
        }
    }
}

/// What is known of a point of a surface.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Point {
    /// Index of what it lies on.
    pub(crate) body: u32,
    pub(crate) position: DVec3,
    /// The same before displacement.
    pub(crate) surface_position: DVec3,
    pub(crate) object_position: DVec3,
    /// Unit, of the face, outward.
    pub(crate) geometric_normal: DVec3,
    /// Unit, interpolated, outward.
    pub(crate) normal: DVec3,
    pub(crate) tangent: DVec4,
    pub(crate) uv0: DVec2,
    pub(crate) uv1: DVec2,
    /// Linear colour and alpha.
    pub(crate) color: DVec4,
    /// Unit, to the viewer.
    pub(crate) view_dir: DVec3,
}

impl<'a> Geometry<'a> {
    /// Makes the hierarchy. `reach` is how far from the origin rays may start, in world space.
    pub(crate) fn new(bodies: Vec<Body<'a>>, reach: f64) -> Geometry<'a> {
        let mut geometry = Geometry {
            transforms: Vec::new(),
            triangles: Vec::new(),
            spheres: Vec::new(),
            hierarchy: Bvh2::default(),
            nearest: 0.0,
            bodies,
        };
        for (index, body) in geometry.bodies.iter().enumerate() {
            let world_from_object = body.object.world_from_object.as_dmat4();
            let handedness = f64::from(body.object.handedness());
            geometry.transforms.push(Transform {
                world_from_object,
                normal_from_object: body.object.normal_from_object().as_dmat3(),
                handedness,
            });
            let (body_index, culled) = (index as u32, body.culled);
            let Some(mesh) = &body.mesh else {
                geometry.spheres.push(Sphere {
                    body: body_index,
                    culled,
                    object_from_world: world_from_object.inverse(),
                });
                continue;
            };
            let place = |i: u32| match &body.moved {
                Some(moved) => moved[i as usize],
                None => world_from_object.transform_point3(DVec3::from(mesh.positions[i as usize].map(f64::from))),
            };
            for corners in mesh.indices.chunks_exact(3) {
                // A mirror turns the order of the corners over.
                let vertices = if handedness < 0.0 {
                    [corners[0], corners[2], corners[1]]
                } else {
                    [corners[0], corners[1], corners[2]]
                };
                let [a, b, c] = vertices.map(place);
                let edges = [b - a, c - a];
                if edges[0].cross(edges[1]) != DVec3::ZERO {
                    geometry.triangles.push(Triangle { corner: a, edges, body: body_index, culled, vertices });
                }
            }
        }
        let extent = geometry.triangles.iter().fold(reach, |most, t| {
            t.corners().iter().fold(most, |most: f64, corner| most.max(corner.abs().max_element()))
        });
        geometry.nearest = 1e-11 * extent;
        // f32 has 24 bits: places of up to `extent` are off by 6e-8 of it, and so is every step of the box test.
        let margin = Vec3A::splat((1e-6 * extent) as f32);
        let boxes: Vec<Aabb> = geometry
            .triangles
            .iter()
            .map(|t| {
                let mut bounds = Aabb::empty();
                for corner in t.corners() {
                    bounds.extend(Vec3A::from(corner.as_vec3()));
                }
                Aabb::new(bounds.min - margin, bounds.max + margin)
            })
            .collect();
        if !boxes.is_empty() {
            let indices = (0..boxes.len() as u32).collect();
            geometry.hierarchy =
                PlocBuilder::new().build(PlocSearchDistance::Medium, &boxes, indices, SortPrecision::U64, 0);
        }
        // In the order of the leaves: a leaf's triangles lie side by side in memory.
        geometry.triangles =
            geometry.hierarchy.primitive_indices.iter().map(|i| geometry.triangles[*i as usize]).collect();
        geometry
    }

    /// The first surface that a ray meets, but the one that it starts on.
    pub(crate) fn first(&self, ray: &Ray, from: u32) -> Option<Hit> {
        let mut best = self.spheres_first(ray, from).unwrap_or(Hit { t: f64::INFINITY, primitive: NOWHERE });
        if !self.triangles.is_empty() {
            self.triangles_first(ray, from, &mut best);
        }
        best.t.is_finite().then_some(best)
    }

    /// Puts a triangle that is nearer in the place of a hit.
    fn triangles_first(&self, ray: &Ray, from: u32, best: &mut Hit) {
        let quick = quick_ray(ray, best.t);
        self.hierarchy.ray_traverse(quick, &mut RayHit::none(), |_, index| match self.meets(ray, index, from) {
            Some(hit) if hit.t < best.t => {
                *best = hit;
                above(hit.t)
            }
            _ => f32::INFINITY,
        });
    }

    /// Whether something stands in the way of a ray before a distance.
    pub(crate) fn is_blocked(&self, ray: &Ray, from: u32, distance: f64) -> bool {
        if self.spheres_first(ray, from).is_some_and(|hit| hit.t < distance) {
            return true;
        }
        !self.triangles.is_empty()
            && !self.hierarchy.ray_traverse_miss(quick_ray(ray, distance), |_, index| {
                match self.meets(ray, index, from) {
                    Some(hit) if hit.t < distance => 0.0,
                    _ => f32::INFINITY,
                }
            })
    }

    /// The body that a hit is on.
    pub(crate) fn body(&self, hit: &Hit) -> usize {
        let index = hit.primitive as usize;
        match self.triangles.get(index) {
            Some(triangle) => triangle.body as usize,
            None => self.spheres[index - self.triangles.len()].body as usize,
        }
    }

    /// Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
    fn meets(&self, ray: &Ray, index: usize, from: u32) -> Option<Hit> {
        if index as u32 == from {
            return None;
        }
        let triangle = &self.triangles[index];
        let [ab, ac] = triangle.edges;
        let p = ray.dir.cross(ac);
        // Positive where the front is seen.
        let determinant = ab.dot(p);
        if determinant == 0.0 || (triangle.culled && determinant < 0.0) {
            return None;
        }
        let inverse = 1.0 / determinant;
        let away = ray.origin - triangle.corner;
        let u = away.dot(p) * inverse;
        let q = away.cross(ab);
        let v = ray.dir.dot(q) * inverse;
        // A hair beyond the edges: neighbours overlap, and no ray slips through between them.
        const EDGE: f64 = 1e-12;
        if u < -EDGE || v < -EDGE || u + v > 1.0 + EDGE {
            return None;
        }
        let t = ac.dot(q) * inverse;
        (t > self.nearest).then_some(Hit { t, primitive: index as u32 })
    }

    fn spheres_first(&self, ray: &Ray, from: u32) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        for (index, sphere) in self.spheres.iter().enumerate() {
            let primitive = (self.triangles.len() + index) as u32;
            if primitive == from && sphere.culled {
                continue;
            }
            let origin = sphere.object_from_world.transform_point3(ray.origin);
            let dir = sphere.object_from_world.transform_vector3(ray.dir);
            let t = if primitive == from {
                // On it: the other meeting is the far side, if the ray goes inwards at all.
                let leave = -2.0 * origin.dot(dir) / dir.length_squared();
                choose(leave > SPHERE_NEAREST, leave, f64::INFINITY)
            } else {
                sphere.meets(origin.to_array(), dir.to_array(), self.nearest)
            };
            if t < best.map_or(f64::INFINITY, |hit| hit.t) {
                best = Some(Hit { t, primitive });
            }
        }
        best
    }

    /// The first surface that each ray from one point in empty space meets, where its distance is finite.
    pub(crate) fn first_from(&self, origin: DVec3, dirs: &Directions, hits: &mut Vec<Hit>) {
        hits.clear();
        hits.resize(dirs.len(), Hit { t: f64::INFINITY, primitive: NOWHERE });
        Arch::new().dispatch(MeetSpheres { geometry: self, origin, dirs, hits });
        if !self.triangles.is_empty() {
            for (index, hit) in hits.iter_mut().enumerate() {
                let ray = Ray { origin, dir: DVec3::from(dirs.at(index)) };
                self.triangles_first(&ray, NOWHERE, hit);
            }
        }
    }

    /// What is known of the point that a ray has met. Of a sphere all but the
    /// texture coordinates, which [`Self::wrap`] makes for many points at once.
    pub(crate) fn point(&self, ray: &Ray, hit: &Hit, detail: Detail) -> Point {
        self.point_at(ray.origin + hit.t * ray.dir, -ray.dir, hit, detail)
    }

    /// The attributes at a point near a hit in the plane of its face, as they go on beyond the face.
    pub(crate) fn point_at(&self, position: DVec3, view_dir: DVec3, hit: &Hit, detail: Detail) -> Point {
        let index = hit.primitive as usize;
        match self.triangles.get(index) {
            Some(triangle) => self.point_of_triangle(triangle, position, view_dir, detail),
            None => self.point_of_sphere(&self.spheres[index - self.triangles.len()], position, view_dir, detail),
        }
    }

    fn point_of_triangle(&self, triangle: &Triangle, position: DVec3, view_dir: DVec3, detail: Detail) -> Point {
        let body = &self.bodies[triangle.body as usize];
        let transform = &self.transforms[triangle.body as usize];
        let Some(mesh) = &body.mesh else { return Point::default() };
        let [ab, ac] = triangle.edges;
        let across = ab.cross(ac);
        let away = position - triangle.corner;
        let area = across.length_squared();
        let (u, v) = (away.cross(ac).dot(across) / area, ab.cross(away).dot(across) / area);
        let weights = [1.0 - u - v, u, v];
        let [i, j, k] = triangle.vertices.map(|v| v as usize);
        let vertices = [i, j, k];
        let vector = |all: &[[f32; 3]]| -> DVec3 {
            vertices.iter().zip(weights).map(|(i, w)| w * DVec3::from(all[*i].map(f64::from))).sum()
        };
        let normal: DVec3 = vertices
            .iter()
            .zip(weights)
            .map(|(i, w)| {
                let normal = transform.normal_from_object * DVec3::from(mesh.normals[*i].map(f64::from));
                w * normal.normalize_or_zero()
            })
            .sum();
        let geometric_normal = across.normalize();
        let mut point = Point {
            body: triangle.body,
            position,
            surface_position: position,
            geometric_normal,
            normal: normal.try_normalize().unwrap_or(geometric_normal),
            view_dir,
            ..Point::default()
        };
        if body.moved.is_some() {
            point.surface_position = transform.world_from_object.transform_point3(vector(&mesh.positions));
        }
        if detail.places {
            let pair = |all: &[[f32; 2]]| -> DVec2 {
                vertices.iter().zip(weights).map(|(i, w)| w * DVec2::from(all[*i].map(f64::from))).sum()
            };
            point.object_position = vector(&mesh.positions);
            (point.uv0, point.uv1) = (pair(&mesh.uv0), pair(&mesh.uv1));
        }
        if detail.tangents {
            let tangent: DVec3 = vertices
                .iter()
                .zip(weights)
                .map(|(i, w)| {
                    let [x, y, z, _] = mesh.tangents[*i].map(f64::from);
                    w * transform.world_from_object.transform_vector3(DVec3::new(x, y, z)).normalize_or_zero()
                })
                .sum();
            let w = f64::from(mesh.tangents[i][3]) * transform.handedness;
            point.tangent = tangent.extend(w);
        }
        if detail.colors {
            let colors = vertices.iter().zip(weights).map(|(i, w)| w * DVec4::from(mesh.colors[*i].map(f64::from)));
            point.color = colors.sum();
        }
        point
    }

    /// Texture coordinates of those points that lie on spheres: the picture's middle is at +Z, its seam at -Z, its top edge
    /// the pole at +Y.
    pub(crate) fn wrap(&self, points: &mut [Point]) {
        if !self.spheres.is_empty() {
            Arch::new().dispatch(Wrap { geometry: self, points });
        }
    }

    fn point_of_sphere(&self, sphere: &Sphere, position: DVec3, view_dir: DVec3, detail: Detail) -> Point {
        let transform = &self.transforms[sphere.body as usize];
        let local = sphere.object_from_world.transform_point3(position).normalize_or(DVec3::Y);
        let normal = (transform.normal_from_object * local).normalize_or(local);
        let body = sphere.body;
        let mut point = Point {
            body,
            position,
            surface_position: position,
            geometric_normal: normal,
            normal,
            view_dir,
            ..Point::default()
        };
        if detail.places {
            point.object_position = local;
        }
        if detail.tangents {
            let tangent = DVec3::new(local.z, 0.0, -local.x).normalize_or(DVec3::X);
            let tangent = transform.world_from_object.transform_vector3(tangent).normalize_or(DVec3::X);
            point.tangent = tangent.extend(transform.handedness);
        }
        if detail.colors {
            point.color = DVec4::ONE;
        }
        point
    }
}

impl Sphere {
    /// How far a ray in object space goes until it meets the unit sphere; infinite where it does not. It starts elsewhere.
    #[inline(always)]
    fn meets(&self, origin: [f64; 3], dir: [f64; 3], nearest: f64) -> f64 {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (a, b, c) = (dot(dir, dir), dot(origin, dir), dot(origin, origin) - 1.0);
        let discriminant = b * b - a * c;
        let root = discriminant.sqrt();
        let far = choose(b > 0.0, -b - root, root - b);
        let (one, other) = (far / a, c / far);
        let (enter, leave) = (choose(one < other, one, other), choose(one < other, other, one));
        let within = choose((leave > SPHERE_NEAREST) & !self.culled, leave, f64::INFINITY);
        let t = choose(enter > nearest, enter, within);
        choose(discriminant > 0.0, t, f64::INFINITY)
    }
}

/// The work of [`Geometry::first_from`] on spheres.
struct MeetSpheres<'a> {
    geometry: &'a Geometry<'a>,
    origin: DVec3,
    dirs: &'a Directions,
    hits: &'a mut [Hit],
}

impl WithSimd for MeetSpheres<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let MeetSpheres { geometry, origin, dirs, hits } = self;
        for (index, sphere) in geometry.spheres.iter().enumerate() {
            let primitive = (geometry.triangles.len() + index) as u32;
            let start = sphere.object_from_world.transform_point3(origin).to_array();
            let columns = [0, 1, 2].map(|i| sphere.object_from_world.col(i).truncate().to_array());
            for (number, hits) in hits.chunks_mut(BLOCK).enumerate() {
                let ([x, y, z], mut t) = (dirs.block(number * BLOCK), [0.0; BLOCK]);
                for i in 0..BLOCK {
                    let along = |k: usize| columns[0][k] * x[i] + columns[1][k] * y[i] + columns[2][k] * z[i];
                    t[i] = sphere.meets(start, [along(0), along(1), along(2)], geometry.nearest);
                }
                for (hit, t) in hits.iter_mut().zip(t) {
                    if t < hit.t {
                        *hit = Hit { t, primitive };
                    }
                }
            }
        }
    }
}

/// The work of [`Geometry::wrap`].
struct Wrap<'a> {
    geometry: &'a Geometry<'a>,
    points: &'a mut [Point],
}

impl WithSimd for Wrap<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for points in self.points.chunks_mut(BLOCK) {
            let (mut x, mut y, mut z) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
            for (i, point) in points.iter().enumerate() {
                [x[i], y[i], z[i]] = point.object_position.to_array();
            }
            let (mut u, mut v) = ([0.0; BLOCK], [0.0; BLOCK]);
            for i in 0..BLOCK {
                u[i] = atan2(x[i], z[i]) * (1.0 / TAU) + 0.5;
                v[i] = atan2((x[i] * x[i] + z[i] * z[i]).sqrt(), y[i]) * FRAC_1_PI;
            }
            for (i, point) in points.iter_mut().enumerate() {
                let body = point.body as usize;
                if self.geometry.bodies[body].mesh.is_none() {
                    (point.uv0, point.uv1) = (DVec2::new(u[i], v[i]), DVec2::new(u[i], v[i]));
                }
            }
        }
    }
}

impl Triangle {
    fn corners(&self) -> [DVec3; 3] {
        [self.corner, self.corner + self.edges[0], self.corner + self.edges[1]]
    }
}

/// The ray as the hierarchy takes it.
fn quick_ray(ray: &Ray, distance: f64) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.as_vec3a(), ray.dir.as_vec3a(), 0.0, above(distance))
}

/// A distance in f32 that is not below it by rounding.
fn above(t: f64) -> f32 {
    if t.is_finite() { (t * (1.0 + 1e-6)) as f32 } else { f32::INFINITY }
}
