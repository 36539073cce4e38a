//! Scene files, `*.scene.json`: which meshes wear which materials, seen from where, in which light. Paths are relative to
//! the file. The fields stand in `format`; each quantity has its unit in its name.
//!
//! ```json
//! {
//!   "halfvector": 1,
//!   "objects": [
//!     {"mesh": "sphere", "material": {"file": "surface.material.json", "set": {"metallic": 1}}},
//!     {"mesh": "model.glb", "materials": {"Glass": "glass.material.json"}, "transform": {"rotation_deg": [0, 30, 0]}}
//!   ],
//!   "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "vertical_fov_deg": 30},
//!   "lights": [{"type": "point", "position": [2, 3, 2], "intensity_cd": 40, "color": [1, 0.9, 0.8]}],
//!   "environment": {"source": "studio", "rotation_deg": 45},
//!   "background": "none",
//!   "exposure": {"stops": 0},
//!   "tone_map": "pbr-neutral",
//!   "preset": "default",
//!   "methods": {"compensation": "none"}
//! }
//! ```
//! Everything but `halfvector` and `objects` may be left out. A model keeps the materials that are not replaced, by name
//! or as `#N`; its lights join the scene's. Without `camera` the model's own is taken, else one that frames it; built-in
//! shapes have the default camera.

mod format;
mod lights;

use std::path::Path;
use std::sync::Arc;

use glam::{EulerRot, Mat4, Quat, Vec3};
use halfvector_graph::method::Methods;

use crate::camera::Camera;
use crate::environment::{Background, EnvironmentSource, read_limited};
use crate::gltf;
use crate::light::Light;
use crate::mesh::BuiltinMesh;
use crate::parameters::set_parameter;
use crate::scene::{Exposure, MeshSource, Scene, SceneError, SceneMaterial, neutral_material};
use crate::tone_map::tone_map_from_name;
use format::{
    BackgroundEntry, EnvironmentEntry, ExposureEntry, MaterialEntry, Numbers, ObjectEntry, ScaleEntry, SceneFile,
    TransformEntry, Version,
};
use lights::{finite_all, read_light};

/// The version of the format that this program writes and reads.
pub const SCENE_VERSION: u32 = 1;

/// Largest scene file that is read, in bytes.
const MAX_FILE_BYTES: u64 = 16 << 20;

/// Light of 1 W at 555 nm, where the eye is most sensitive, [lm]: how glTF exporters and Blender take watts to lumens.
pub const LUMENS_PER_WATT: f32 = 683.0;

/// What is wrong in the file and where, or what another file says.
enum Wrong {
    Here { place: String, reason: String },
    Elsewhere(SceneError),
}

impl<E: Into<SceneError>> From<E> for Wrong {
    fn from(error: E) -> Wrong {
        Wrong::Elsewhere(error.into())
    }
}

fn here(place: impl Into<String>, reason: impl Into<String>) -> Wrong {
    Wrong::Here { place: place.into(), reason: reason.into() }
}

/// Reads a scene file, and everything that it refers to but its environment.
pub fn load_scene(path: &Path) -> Result<Scene, SceneError> {
    let bytes =
        read_limited(path, MAX_FILE_BYTES).map_err(|reason| SceneError::Read { path: path.to_owned(), reason })?;
    from_json(&bytes, path.parent().unwrap_or(Path::new(""))).map_err(|wrong| match wrong {
        Wrong::Here { place, reason } => SceneError::InFile { path: path.to_owned(), place, reason },
        Wrong::Elsewhere(error) => error,
    })
}

fn from_json(bytes: &[u8], directory: &Path) -> Result<Scene, Wrong> {
    let syntax = |e: serde_json::Error| {
        let message = e.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        here(format!("line {}, column {}", e.line(), e.column()), message)
    };
    let version: Version = serde_json::from_slice(bytes).map_err(syntax)?;
    match version.halfvector.as_ref().map(serde_json::Value::as_u64) {
        Some(Some(version)) if version == u64::from(SCENE_VERSION) => {}
        Some(Some(version)) if version > u64::from(SCENE_VERSION) => {
            let reason = format!("the scene was written by a newer program (version {version}); this one reads 1");
            return Err(here("halfvector", reason));
        }
        _ => return Err(here("halfvector", "a scene begins with \"halfvector\": 1")),
    }
    let file: SceneFile = serde_json::from_slice(bytes).map_err(syntax)?;
    build(file, directory)
}

fn build(file: SceneFile, directory: &Path) -> Result<Scene, Wrong> {
    let mut scene = Scene { name: file.name.unwrap_or_default(), ..Scene::default() };
    let mut model_camera = None;
    let mut has_model = false;
    if file.objects.is_empty() {
        return Err(here("objects", "there is nothing to see; add {\"mesh\": \"sphere\", \"material\": ...}"));
    }
    for (index, object) in file.objects.iter().enumerate() {
        let place = format!("objects[{index}]");
        let world_from_object = transform(&object.transform).map_err(|r| here(format!("{place}.transform"), r))?;
        let source = MeshSource::parse(&object.mesh, directory).map_err(|r| here(format!("{place}.mesh"), r))?;
        match source {
            MeshSource::Builtin(shape) => {
                add_shape(&mut scene, object, shape, world_from_object, directory, &place)?;
            }
            MeshSource::File(path) => {
                has_model = true;
                let model = gltf::load(&path)?;
                let camera = model.camera.map(|camera| moved(camera, &world_from_object));
                model_camera = model_camera.or(camera.filter(|c| c.check().is_ok()));
                add_model(&mut scene, object, model, world_from_object, directory, &place)?;
            }
        }
    }
    for (index, light) in file.lights.iter().enumerate() {
        scene.lights.push(read_light(light).map_err(|reason| here(format!("lights[{index}]"), reason))?);
    }
    match file.environment {
        Some(EnvironmentEntry::Source(source)) => scene.environment = EnvironmentSource::parse(&source, directory),
        Some(EnvironmentEntry::Turned { source, rotation_deg }) => {
            scene.environment = EnvironmentSource::parse(&source, directory);
            scene.environment_rotation = finite(rotation_deg).map_err(|r| here("environment.rotation_deg", r))?;
        }
        None => {}
    }
    scene.background = match file.background {
        None => Background::Environment,
        Some(BackgroundEntry::Color(color)) => Background::Color(finite_all(color).map_err(|r| here("background", r))?),
        Some(BackgroundEntry::Name(name)) => match name.as_str() {
            "env" => Background::Environment,
            "none" => Background::None,
            _ => return Err(here("background", format!("`{name}` is none of env, none, [R, G, B]"))),
        },
    };
    scene.exposure = match file.exposure {
        None => Exposure::Stops(0.0),
        Some(ExposureEntry::Stops(stops)) => Exposure::Stops(finite(stops).map_err(|r| here("exposure", r))?),
        Some(ExposureEntry::Ev100(ev100)) => Exposure::Ev100(finite(ev100).map_err(|r| here("exposure", r))?),
    };
    if let Some(name) = &file.tone_map {
        scene.tone_map = tone_map_from_name(name).map_err(|reason| here("tone_map", reason))?;
    }
    scene.methods = match file.preset.as_deref() {
        None | Some("default") => Methods::default(),
        Some("report") => Methods::report(),
        Some(other) => return Err(here("preset", format!("`{other}` is none of default, report"))),
    };
    for (term, method) in &file.methods {
        scene.methods.set(term, method).map_err(|e| here("methods", e.to_string()))?;
    }
    scene.camera = match file.camera {
        Some(entry) => {
            let camera = Camera {
                position: entry.position.into(),
                target: entry.target.into(),
                up: entry.up.into(),
                vertical_fov: entry.vertical_fov_deg,
            };
            camera.check().map_err(|reason| here("camera", reason))?;
            camera
        }
        None if has_model => model_camera.unwrap_or_else(|| scene.framing_camera()),
        None => Camera::default(),
    };
    scene.load_images()?;
    Ok(scene)
}

fn add_shape(
    scene: &mut Scene,
    object: &ObjectEntry,
    shape: BuiltinMesh,
    world_from_object: Mat4,
    directory: &Path,
    place: &str,
) -> Result<(), Wrong> {
    let material = match &object.material {
        Some(material) => read_material(material, directory, &format!("{place}.material"))?,
        None => neutral_material(),
    };
    scene.materials.push(material);
    let first = scene.objects.len();
    scene.add_builtin(shape, scene.materials.len() - 1, world_from_object);
    for (part, material) in &object.materials {
        let place = format!("{place}.materials.{part}");
        let material = read_material(material, directory, &place)?;
        let Some(found) = scene.objects[first..].iter_mut().find(|o| o.name == *part) else {
            let names: Vec<_> = scene.objects[first..].iter().map(|o| o.name.as_str()).collect();
            return Err(here(place, format!("the {} has the parts {}", shape.name(), names.join(", "))));
        };
        found.material = scene.materials.len();
        scene.materials.push(material);
    }
    if let Some(name) = &object.name {
        for part in &mut scene.objects[first..] {
            part.name = format!("{name}.{}", part.name);
        }
    }
    Ok(())
}

fn add_model(
    scene: &mut Scene,
    object: &ObjectEntry,
    model: gltf::Model,
    world_from_object: Mat4,
    directory: &Path,
    place: &str,
) -> Result<(), Wrong> {
    let mut materials = model.materials;
    if let Some(material) = &object.material {
        let material = read_material(material, directory, &format!("{place}.material"))?;
        materials.fill(material);
    }
    let names: Vec<String> = materials.iter().map(|m| m.document.name.clone()).collect();
    for (key, material) in &object.materials {
        let place = format!("{place}.materials.{key}");
        let material = read_material(material, directory, &place)?;
        let by_number = key.strip_prefix('#').and_then(|n| n.parse().ok()).filter(|&n: &usize| n < names.len());
        let found: Vec<usize> = match by_number {
            Some(number) => vec![number],
            None => (0..names.len()).filter(|&i| names[i] == *key).collect(),
        };
        if found.is_empty() {
            let known: Vec<_> = names.iter().enumerate().map(|(i, name)| format!("#{i} {name}")).collect();
            return Err(here(place, format!("the model has the materials {}", known.join(", "))));
        }
        for index in found {
            materials[index] = material.clone();
        }
    }
    let (first_mesh, first_material) = (scene.meshes.len(), scene.materials.len());
    scene.meshes.extend(model.meshes.into_iter().map(Arc::new));
    scene.materials.extend(materials);
    scene.objects.extend(model.objects.into_iter().map(|mut part| {
        part.mesh += first_mesh;
        part.material += first_material;
        part.world_from_object = world_from_object * part.world_from_object;
        if let Some(name) = &object.name {
            part.name = format!("{name}.{}", part.name);
        }
        part
    }));
    scene.lights.extend(model.lights.into_iter().map(|light| moved_light(light, &world_from_object)));
    scene.notes.extend(model.notes.into_iter().map(|note| format!("{}: {note}", object.mesh)));
    Ok(())
}

fn read_material(entry: &MaterialEntry, directory: &Path, place: &str) -> Result<SceneMaterial, Wrong> {
    let (file, set) = match entry {
        MaterialEntry::Path(file) => (file, None),
        MaterialEntry::WithParameters { file, set } => (file, Some(set)),
    };
    let path = directory.join(file);
    let mut document = halfvector_graph::file::load(&path)?;
    for (name, numbers) in set.into_iter().flatten() {
        let numbers = match numbers {
            Numbers::Switch(on) => vec![f64::from(u8::from(*on))],
            Numbers::One(x) => vec![*x],
            Numbers::Many(list) => list.clone(),
        };
        set_parameter(&mut document, name, &numbers).map_err(|e| here(format!("{place}.set"), e.to_string()))?;
    }
    let directory = path.parent().unwrap_or(Path::new("")).to_owned();
    Ok(SceneMaterial { document, directory })
}

fn transform(entry: &TransformEntry) -> Result<Mat4, String> {
    let matrix = match (&entry.matrix, entry.translation, entry.rotation_deg, entry.scale) {
        (Some(matrix), None, None, None) => Mat4::from_cols_array(matrix),
        (Some(_), ..) => return Err("a matrix stands alone; leave out translation, rotation_deg and scale".into()),
        (None, translation, rotation, scale) => {
            let [x, y, z] = rotation.unwrap_or_default().map(f32::to_radians);
            let scale = match scale {
                Some(ScaleEntry::Even(s)) => Vec3::splat(s),
                Some(ScaleEntry::ByAxis(s)) => Vec3::from(s),
                None => Vec3::ONE,
            };
            let rotation = Quat::from_euler(EulerRot::ZXY, z, x, y);
            Mat4::from_scale_rotation_translation(scale, rotation, translation.unwrap_or_default().into())
        }
    };
    if matrix.is_finite() { Ok(matrix) } else { Err("the transform is not finite".into()) }
}

fn moved(camera: Camera, world_from_object: &Mat4) -> Camera {
    Camera {
        position: world_from_object.transform_point3(camera.position),
        target: world_from_object.transform_point3(camera.target),
        up: world_from_object.transform_vector3(camera.up),
        vertical_fov: camera.vertical_fov,
    }
}

/// The light under the transform of the model that it comes with. Its strength does not scale (KHR_lights_punctual).
fn moved_light(light: Light, world_from_object: &Mat4) -> Light {
    let turned = |v: Vec3| world_from_object.transform_vector3(v).normalize_or(v);
    match light {
        Light::Directional { direction_to_light, illuminance } => {
            Light::Directional { direction_to_light: turned(direction_to_light), illuminance }
        }
        Light::Point { position, intensity } => {
            Light::Point { position: world_from_object.transform_point3(position), intensity }
        }
        Light::Spot { position, direction, intensity, inner_angle, outer_angle } => Light::Spot {
            position: world_from_object.transform_point3(position),
            direction: turned(direction),
            intensity,
            inner_angle,
            outer_angle,
        },
    }
}

fn finite(x: f32) -> Result<f32, String> {
    if x.is_finite() { Ok(x) } else { Err("the number is too large".into()) }
}
