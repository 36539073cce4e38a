//! Materials as the reference evaluates them: the document's own `material(context) -> Surface`, run in f64 for many
//! points at once, and the height by which it is displaced.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::{DVec2, DVec3, DVec4};
use halfvector_graph::document::SurfaceSettings;
use halfvector_graph::library::Library;
use halfvector_maps::height::normal_from_height;
use halfvector_scene::{Scene, SceneMaterial};

use crate::ReferenceError;
use crate::function::{Frames, Function, Runner, Steps, component};
use crate::geometry::{Detail, Point};
use crate::texture::Textures;

/// The surface at one point, as the surface node gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surface {
    pub(crate) base_color: [f64; 3],
    pub(crate) metallic: f64,
    pub(crate) perceptual_roughness: f64,
    pub(crate) ior: f64,
    pub(crate) specular: f64,
    pub(crate) normal: [f64; 3],
    pub(crate) occlusion: f64,
    pub(crate) emission: [f64; 3],
    pub(crate) opacity: f64,
    pub(crate) coat_weight: f64,
    pub(crate) coat_color: [f64; 3],
    pub(crate) coat_roughness: f64,
    pub(crate) coat_ior: f64,
    pub(crate) coat_normal: [f64; 3],
    pub(crate) sheen_color: [f64; 3],
    pub(crate) sheen_roughness: f64,
    pub(crate) transmission_weight: f64,
    pub(crate) anisotropy: f64,
    pub(crate) anisotropy_rotation: f64,
    pub(crate) thin_film_weight: f64,
    pub(crate) thin_film_thickness: f64,
    pub(crate) thin_film_ior: f64,
}

/// The members of the shader's struct that are read, each with its number of components, in the order of [`Surface`].
const MEMBERS: [(&str, usize); 22] = [
    ("base_color", 3),
    ("metallic", 1),
    ("perceptual_roughness", 1),
    ("ior", 1),
    ("specular", 1),
    ("normal", 3),
    ("occlusion", 1),
    ("emission", 3),
    ("opacity", 1),
    ("coat_weight", 1),
    ("coat_color", 3),
    ("coat_roughness", 1),
    ("coat_ior", 1),
    ("coat_normal", 3),
    ("sheen_color", 3),
    ("sheen_roughness", 1),
    ("transmission_weight", 1),
    ("anisotropy", 1),
    ("anisotropy_rotation", 1),
    ("thin_film_weight", 1),
    ("thin_film_thickness", 1),
    ("thin_film_ior", 1),
];

/// Numbers of a [`Surface`].
const NUMBERS: usize = 38;

impl Surface {
    fn from_numbers(numbers: &[f64; NUMBERS]) -> Surface {
        let mut rest = numbers.iter().copied();
        let mut one = || rest.next().unwrap_or_default();
        Surface {
            base_color: [one(), one(), one()],
            metallic: one(),
            perceptual_roughness: one(),
            ior: one(),
            specular: one(),
            normal: [one(), one(), one()],
            occlusion: one(),
            emission: [one(), one(), one()],
            opacity: one(),
            coat_weight: one(),
            coat_color: [one(), one(), one()],
            coat_roughness: one(),
            coat_ior: one(),
            coat_normal: [one(), one(), one()],
            sheen_color: [one(), one(), one()],
            sheen_roughness: one(),
            transmission_weight: one(),
            anisotropy: one(),
            anisotropy_rotation: one(),
            thin_film_weight: one(),
            thin_film_thickness: one(),
            thin_film_ior: one(),
        }
    }

    fn is_finite(&self) -> bool {
        let vectors =
            [self.base_color, self.normal, self.emission, self.coat_color, self.coat_normal, self.sheen_color];
        let numbers = [
            self.metallic,
            self.perceptual_roughness,
            self.ior,
            self.specular,
            self.occlusion,
            self.opacity,
            self.coat_weight,
            self.coat_roughness,
            self.coat_ior,
            self.sheen_roughness,
            self.transmission_weight,
            self.anisotropy,
            self.anisotropy_rotation,
            self.thin_film_weight,
            self.thin_film_thickness,
            self.thin_film_ior,
        ];
        vectors.as_flattened().iter().chain(&numbers).all(|x| x.is_finite())
    }
}

/// A material ready to be evaluated.
pub(crate) struct Material {
    surface: Function,
    /// Where each output of it goes in the numbers of a [`Surface`].
    outputs: Vec<Option<usize>>,
    /// How far a vertex is moved along its normal; none where the surface is not displaced.
    pub(crate) height: Option<Function>,
    /// The derivatives of the height, where they bend the normals.
    change: Option<Function>,
    /// Whether its own text takes derivatives, beside those that choose a texture's level.
    pub(crate) derives: bool,
    /// Points at which it was evaluated, and those of them at which it gave no finite surface.
    looked_at: [AtomicU64; 2],
    /// Vertices that it was to move, and those of them whose height is no length.
    pub(crate) moved: [u64; 2],
    /// What it asks of points; tangents where it is brushed along them, too.
    pub(crate) detail: Detail,
    /// What opacity does, and whether both sides are seen.
    pub(crate) settings: SurfaceSettings,
}

impl Material {
    /// Compiles a material of a scene.
    pub(crate) fn new(
        scene: &Scene,
        material: &SceneMaterial,
        frames: &Arc<Frames>,
        textures: &mut Textures,
    ) -> Result<Material, ReferenceError> {
        let (document, library, methods) = (&material.document, Library::standard(), &scene.methods);
        let wrong = |error: halfvector_codegen::CodegenError| ReferenceError::Material {
            material: document.name.clone(),
            why: error.to_string(),
        };
        let mut function = |shader: &halfvector_codegen::Shader, name: &str| {
            Function::new(scene, material, shader, name, frames, textures)
        };
        let surface = halfvector_codegen::material(document, library, methods).map_err(wrong)?;
        let surface = function(&surface, "material")?;
        let (mut height, mut change) = (None, None);
        if let Some(found) = halfvector_codegen::height(document, library, methods).map_err(wrong)? {
            height = Some(function(&found.vertex, "height")?);
            // Where the surface's normals are none of the mesh's there is nothing to bend.
            if let Some(found) = found.change.filter(|_| surface.reads_normal()) {
                change = Some(function(&found, "height_change")?);
            }
        }
        let place = |name: &str| {
            let mut path = name.split('.');
            let (member, component) = (path.next()?, component(path.next())?);
            let before = MEMBERS.iter().position(|(known, _)| *known == member)?;
            Some(MEMBERS[..before].iter().map(|(_, count)| count).sum::<usize>() + component)
        };
        let mut made = Material {
            outputs: surface.outputs().map(place).collect(),
            derives: surface.derives,
            looked_at: Default::default(),
            moved: [0; 2],
            detail: surface.detail,
            settings: document.surface,
            surface,
            height,
            change,
        };
        if let Some(change) = &made.change {
            made.detail = made.detail.and(change.detail);
        }
        made.detail.tangents |= made.is_brushed()?;
        Ok(made)
    }

    /// Evaluates some points: a brushed surface needs tangents.
    fn is_brushed(&self) -> Result<bool, ReferenceError> {
        let points: Vec<Point> = (0..64)
            .map(|i| {
                let (u, v) = (f64::from(i % 8) / 8.0 + 0.03, f64::from(i / 8) / 8.0 + 0.05);
                let place = DVec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, 0.5);
                Point {
                    body: 0,
                    position: place,
                    surface_position: place,
                    object_position: place,
                    uv0: DVec2::new(u, v),
                    uv1: DVec2::new(u, v),
                    normal: DVec3::Z,
                    geometric_normal: DVec3::Z,
                    view_dir: DVec3::Z,
                    tangent: DVec3::X.extend(1.0),
                    color: DVec4::ONE,
                }
            })
            .collect();
        let mut runner = self.surface.runner()?;
        runner.run(&points, None)?;
        let slot = self.surface.outputs().position(|name| name == "anisotropy");
        let column = slot.and_then(|slot| runner.result(slot));
        Ok(column.is_some_and(|numbers| numbers.iter().any(|x| *x != 0.0)))
    }

    /// Whether [`Evaluator::surfaces`] wants the points beside the ones that are shaded.
    pub(crate) fn wants_steps(&self) -> bool {
        self.derives || self.change.is_some()
    }

    /// The share of the points so far at which it gave no finite surface.
    pub(crate) fn share_not_finite(&self) -> f64 {
        let [all, not_finite] = [0, 1].map(|i| self.looked_at[i].load(Ordering::Relaxed) as f64);
        if not_finite > 0.0 { not_finite / all } else { 0.0 }
    }

    /// The machines that evaluate it: one for each thread.
    pub(crate) fn evaluator(&self) -> Result<Evaluator<'_>, ReferenceError> {
        Ok(Evaluator {
            material: self,
            surface: self.surface.runner()?,
            change: self.change.as_ref().map(Function::runner).transpose()?,
            normals: Vec::new(),
        })
    }
}

/// A material and the memory to evaluate it.
pub(crate) struct Evaluator<'m> {
    material: &'m Material,
    surface: Runner<'m>,
    change: Option<Runner<'m>>,
    /// Of the displaced surface, by point.
    normals: Vec<DVec3>,
}

impl Evaluator<'_> {
    /// The surface at each point. `steps` are needed where the material [derives](Material::derives); without them normals
    /// are not bent. The tangents of points on a displaced surface become those of that surface.
    pub(crate) fn surfaces(
        &mut self,
        points: &mut [Point],
        steps: Option<Steps<'_>>,
        surfaces: &mut Vec<Surface>,
    ) -> Result<(), ReferenceError> {
        surfaces.clear();
        if points.is_empty() {
            return Ok(());
        }
        self.surface.run(points, steps)?;
        self.read(points.len(), |_, surface| surfaces.push(surface));
        if self.bend(points, steps)? {
            self.surface.run_bent(&self.normals, points)?;
            self.read(points.len(), |i, bent| {
                (surfaces[i].normal, surfaces[i].coat_normal) = (bent.normal, bent.coat_normal);
            });
        }
        let strange = surfaces.iter().filter(|surface| !surface.is_finite()).count();
        let [all, not_finite] = &self.material.looked_at;
        all.fetch_add(points.len() as u64, Ordering::Relaxed);
        not_finite.fetch_add(strange as u64, Ordering::Relaxed);
        Ok(())
    }

    /// Gives each surface of the last run.
    fn read(&self, count: usize, mut take: impl FnMut(usize, Surface)) {
        let places = self.material.outputs.iter().enumerate();
        let columns: Vec<(usize, &[f64])> =
            places.filter_map(|(output, place)| place.zip(self.surface.result(output))).collect();
        let mut numbers = [0.0; NUMBERS];
        for i in 0..count {
            for (place, column) in &columns {
                numbers[*place] = column[i];
            }
            take(i, Surface::from_numbers(&numbers));
        }
    }

    /// Finds the displaced surface's normals and tangents, if the material has such.
    ///
    /// The displaced position is p + h n, whose part across the normal n changes by h n' more than p: with its steps the
    /// gradient of the height is exact where the surface is curved, too.
    fn bend(&mut self, points: &mut [Point], steps: Option<Steps<'_>>) -> Result<bool, ReferenceError> {
        let (Some(change), Some([right, down])) = (&mut self.change, steps) else { return Ok(false) };
        change.run(points, steps)?;
        let (Some(along_x), Some(along_y)) = (change.result(0), change.result(1)) else { return Ok(false) };
        self.normals.clear();
        self.normals.extend(points.iter_mut().enumerate().map(|(i, point)| {
            let rise = [along_x[i], along_y[i]];
            // What is no number stays none, and is told.
            if !rise.iter().all(|x| x.is_finite()) {
                return DVec3::NAN;
            }
            let beside = [&right[i], &down[i]];
            let [ddx, ddy] = beside.map(|beside| beside.position - point.position);
            if self.material.detail.tangents {
                let before = beside.map(|beside| beside.surface_position - point.surface_position);
                point.tangent = moved(point.tangent.truncate(), point.normal, before, [ddx, ddy], rise)
                    .unwrap_or(point.tangent.truncate())
                    .extend(point.tangent.w);
            }
            normal_from_height(ddx.to_array(), ddy.to_array(), point.normal.to_array(), along_x[i], along_y[i]).into()
        }));
        Ok(true)
    }
}

/// Where displacement takes a tangent of the mesh, not unit: the same way on the surface, t = a p_x + b p_y in the plane across
/// the normal, is a P_x + b P_y of the steps P of the displaced position there, and rises by a h_x + b h_y along the normal. `None` for
/// a footprint of no area.
fn moved(tangent: DVec3, normal: DVec3, before: [DVec3; 2], after: [DVec3; 2], rise: [f64; 2]) -> Option<DVec3> {
    let [x, y] = before;
    let (across_x, across_y) = (y.cross(normal), normal.cross(x));
    let area = x.dot(across_x);
    let (a, b) = (tangent.dot(across_x) / area, tangent.dot(across_y) / area);
    let along = after[0] * a + after[1] * b;
    let found = along + normal * (a * rise[0] + b * rise[1] - along.dot(normal));
    (found.is_finite() && found.length_squared() > 0.0).then_some(found)
}
