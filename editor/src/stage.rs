//! What the material is seen on: mesh, light, camera, display. View state: no part of the document, and not undone.

use glam::{Quat, Vec3};
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ToneMap;
use halfvector_scene::scene::MeshSource;
use halfvector_scene::{BuiltinMesh, Camera, EnvironmentSource, Light};

/// Everything about a picture but the material.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// What wears the material.
    pub mesh: MeshSource,
    /// What surrounds it.
    pub environment: EnvironmentSource,
    /// Counter-clockwise seen from above [deg].
    pub environment_rotation: f32,
    /// Whether the environment is seen behind the object.
    pub shows_environment: bool,
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// Brighter by factors of two.
    pub exposure_stops: f32,
    /// Into the display's range.
    pub tone_map: ToneMap,
    /// Where it is seen from.
    pub orbit: Orbit,
    /// The method chosen for each term of shading.
    pub methods: Methods,
}

/// A camera that turns about a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// The point in the middle of the picture [m].
    pub target: Vec3,
    /// From the target [m], more than 0.
    pub distance: f32,
    /// Counter-clockwise seen from above, 0 on +Z [rad].
    pub yaw: f32,
    /// Above the horizon [rad], within a quarter turn.
    pub pitch: f32,
    /// Vertical [deg].
    pub vertical_fov: f32,
}

/// Just below a quarter turn: looking straight down leaves up undefined.
const MAX_PITCH: f32 = 1.55;

impl Default for Stage {
    /// The command line's: a sphere under `studio`, no punctual lights.
    fn default() -> Self {
        Stage {
            mesh: MeshSource::Builtin(BuiltinMesh::Sphere),
            environment: EnvironmentSource::Studio,
            environment_rotation: 0.0,
            shows_environment: false,
            lights: Vec::new(),
            exposure_stops: 0.0,
            tone_map: ToneMap::default(),
            orbit: Orbit::of(&Camera::default()),
            methods: Methods::default(),
        }
    }
}

impl Orbit {
    /// The orbit that a camera is on; its roll is lost.
    pub fn of(camera: &Camera) -> Orbit {
        let offset = camera.position - camera.target;
        let distance = offset.length().max(1e-12);
        Orbit {
            target: camera.target,
            distance,
            yaw: offset.x.atan2(offset.z),
            pitch: (offset.y / distance).clamp(-1.0, 1.0).asin().clamp(-MAX_PITCH, MAX_PITCH),
            vertical_fov: camera.vertical_fov,
        }
    }

    /// The camera itself.
    pub fn camera(&self) -> Camera {
        let turn = Quat::from_rotation_y(self.yaw) * Quat::from_rotation_x(-self.pitch);
        Camera {
            position: self.target + turn * (Vec3::Z * self.distance),
            target: self.target,
            up: Vec3::Y,
            vertical_fov: self.vertical_fov,
        }
    }

    /// Turned by a drag of the pointer [rad].
    pub fn turned(self, yaw: f32, pitch: f32) -> Orbit {
        Orbit { yaw: self.yaw + yaw, pitch: (self.pitch + pitch).clamp(-MAX_PITCH, MAX_PITCH), ..self }
    }

    /// Nearer by a factor.
    pub fn zoomed(self, factor: f32) -> Orbit {
        Orbit { distance: (self.distance / factor).clamp(1e-6, 1e9), ..self }
    }

    /// Moved across the view by shares of the picture's height.
    pub fn panned(self, right: f32, up: f32) -> Orbit {
        let camera = self.camera();
        let forward = (camera.target - camera.position).normalize_or(Vec3::NEG_Z);
        let across = forward.cross(Vec3::Y).normalize_or(Vec3::X);
        let height = 2.0 * self.distance * (0.5 * self.vertical_fov.to_radians()).tan();
        Orbit { target: self.target + (across * right + across.cross(forward) * up) * height, ..self }
    }
}
