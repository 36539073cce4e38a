//! What the material is seen on: mesh, light, camera, display. View state: no part of the document, and not undone.

use glam::{Quat, Vec3};
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ToneMap;
use halfvector_scene::mesh::Bounds;
use halfvector_scene::scene::MeshSource;
use halfvector_scene::{BuiltinMesh, Camera, Display, EnvironmentSource, Light};

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
    pub lamps: Vec<Lamp>,
    /// Brighter by factors of two.
    pub exposure_stops: f32,
    /// Into the display's range.
    pub tone_map: ToneMap,
    /// Where it is seen from.
    pub orbit: Orbit,
    /// The method chosen for each term of shading.
    pub methods: Methods,
}

/// A punctual light as a person sets it: colour and brightness apart, and what the other kinds need kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Which kind it is.
    pub kind: LampKind,
    /// Where it is [m]; of a directional one the direction towards it.
    pub place: Vec3,
    /// What a spot shines at [m].
    pub target: Vec3,
    /// Linear Rec. 709; multiplies the brightness.
    pub color: [f32; 3],
    /// lx of a directional one, cd of the others.
    pub brightness: f32,
    /// Full and no light of a spot, from its axis [deg].
    pub cone: [f32; 2],
    /// Whether it shines.
    pub is_on: bool,
}

/// Kinds of punctual lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LampKind {
    /// Parallel rays.
    Directional,
    /// All directions alike.
    Point,
    /// A cone.
    Spot,
}

impl LampKind {
    /// All, in the order shown.
    pub const ALL: [LampKind; 3] = [LampKind::Directional, LampKind::Point, LampKind::Spot];

    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            LampKind::Directional => "Directional",
            LampKind::Point => "Point",
            LampKind::Spot => "Spot",
        }
    }

    /// The unit of its brightness.
    pub fn unit(self) -> &'static str {
        match self {
            LampKind::Directional => " lx",
            LampKind::Point | LampKind::Spot => " cd",
        }
    }
}

impl Lamp {
    /// A lamp of a kind, from the upper right before the object.
    pub fn new(kind: LampKind) -> Lamp {
        let brightness = match kind {
            LampKind::Directional => 3.0,
            LampKind::Point => 8.0,
            LampKind::Spot => 16.0,
        };
        Lamp {
            kind,
            place: Vec3::new(0.9, 0.9, 1.4),
            target: Vec3::ZERO,
            color: [1.0; 3],
            brightness,
            cone: [15.0, 25.0],
            is_on: true,
        }
    }

    /// The light of scenes.
    pub fn light(&self) -> Light {
        let intensity = Vec3::from(self.color) * self.brightness;
        match self.kind {
            LampKind::Directional => {
                Light::Directional { direction_to_light: self.place.normalize_or(Vec3::Y), illuminance: intensity }
            }
            LampKind::Point => Light::Point { position: self.place, intensity },
            LampKind::Spot => Light::Spot {
                position: self.place,
                direction: (self.target - self.place).normalize_or(Vec3::NEG_Y),
                intensity,
                inner_angle: self.cone[0].min(self.cone[1]).to_radians(),
                outer_angle: self.cone[1].to_radians(),
            },
        }
    }

    /// Where its handle is: itself, or a place in the direction of a directional one, seen from the target of the view.
    pub fn handle(&self, orbit: &Orbit) -> Vec3 {
        match self.kind {
            LampKind::Directional => orbit.target + self.place.normalize_or(Vec3::Y) * (0.25 * orbit.distance),
            LampKind::Point | LampKind::Spot => self.place,
        }
    }

    /// Moves the handle across the view by shares of the picture's height.
    pub fn drag(&mut self, orbit: &Orbit, right: f32, up: f32) {
        let handle = self.handle(orbit);
        let moved = handle + orbit.across(orbit.depth(handle), right, up);
        self.place = match self.kind {
            LampKind::Directional => (moved - orbit.target).normalize_or(Vec3::Y),
            LampKind::Point | LampKind::Spot => moved,
        };
    }
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
            lamps: Vec::new(),
            exposure_stops: 0.0,
            tone_map: ToneMap::default(),
            orbit: Orbit::of(&Camera::default()),
            methods: Methods::default(),
        }
    }
}

impl Stage {
    /// The lamps that are on, as the scene has them.
    pub fn lights(&self) -> Vec<Light> {
        self.lamps.iter().filter(|lamp| lamp.is_on).map(Lamp::light).collect()
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
        Orbit { target: self.target + self.across(self.distance, right, up), ..self }
    }

    /// The way across the view at a distance in front of the camera, by shares of the picture's height.
    pub fn across(&self, depth: f32, right: f32, up: f32) -> Vec3 {
        let [across, upward, _] = self.axes();
        let height = 2.0 * depth * (0.5 * self.vertical_fov.to_radians()).tan();
        (across * right + upward * up) * height
    }

    /// As it is seen in a picture of this width over height: what a square one shows is whole in a narrow one, too.
    pub fn within(self, aspect: f32) -> Orbit {
        let wider = if aspect.is_finite() && aspect > 0.0 { (1.0 / aspect).clamp(1.0, 8.0) } else { 1.0 };
        let half = (0.5 * self.vertical_fov.to_radians()).tan() * wider;
        Orbit { vertical_fov: 2.0 * half.atan().to_degrees(), ..self }
    }

    /// How far in front of the camera a point is.
    pub fn depth(&self, point: Vec3) -> f32 {
        (point - self.camera().position).dot(self.axes()[2])
    }

    /// Where a point is in the picture, in shares of its height from its middle, right and up; none behind the camera.
    pub fn project(&self, point: Vec3) -> Option<[f32; 2]> {
        let [across, upward, forward] = self.axes();
        let offset = point - self.camera().position;
        let depth = offset.dot(forward);
        let height = 2.0 * depth * (0.5 * self.vertical_fov.to_radians()).tan();
        (depth > 1e-6 * self.distance).then(|| [offset.dot(across) / height, offset.dot(upward) / height])
    }

    /// Right, up and forward, unit.
    fn axes(&self) -> [Vec3; 3] {
        let camera = self.camera();
        let forward = (camera.target - camera.position).normalize_or(Vec3::NEG_Z);
        let across = forward.cross(Vec3::Y).normalize_or(Vec3::X);
        [across, across.cross(forward), forward]
    }

    /// Looking at a box from the same side, with all of it in a square picture.
    pub fn framing(self, bounds: Bounds) -> Orbit {
        let framed = Orbit::of(&Camera::framing(bounds));
        let radius = 0.5 * (bounds.max - bounds.min).length();
        let distance = 1.05 * radius / (0.5 * framed.vertical_fov.to_radians()).sin();
        Orbit { yaw: self.yaw, pitch: self.pitch, distance: distance.max(1e-6), ..framed }
    }
}

impl Stage {
    /// How its radiance is shown.
    pub fn display(&self) -> Display {
        if self.methods.is("encode", "report") {
            return Display::AsIs;
        }
        Display::ToneMapped { exposure: self.exposure_stops.exp2(), tone_map: self.tone_map }
    }
}
