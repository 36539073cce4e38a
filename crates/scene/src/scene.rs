//! The scene as plain data, and the ways to make one that need no scene file: a bare material on a mesh.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{Mat3, Mat4};
use halfvector_graph::document::{Document, Node};
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ToneMap;
use halfvector_graph::value::Value;

use crate::camera::Camera;
use crate::environment::{Background, EnvironmentError, EnvironmentSource};
use crate::gltf::{self, GltfError};
use crate::images::{ImageError, ImageStore};
use crate::light::Light;
use crate::mesh::{Bounds, BuiltinMesh, Mesh};
use crate::parameters::ParameterError;

/// Everything that a picture is made of.
#[derive(Clone, Debug)]
pub struct Scene {
    /// For people.
    pub name: String,
    /// Surfaces, shared by objects. The same `Arc` is the same mesh: renderers keep what they made of it.
    pub meshes: Vec<Arc<Mesh>>,
    /// Materials, shared by objects.
    pub materials: Vec<SceneMaterial>,
    /// What is drawn.
    pub objects: Vec<Object>,
    /// The pictures that the materials refer to.
    pub images: ImageStore,
    /// Where the scene is seen from.
    pub camera: Camera,
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// What surrounds the scene.
    pub environment: EnvironmentSource,
    /// Turns the environment counter-clockwise seen from above [deg]: world direction d reads the map at Ry(-angle) d.
    pub environment_rotation: f32,
    /// What is seen where no object is.
    pub background: Background,
    /// Radiance to display.
    pub exposure: Exposure,
    /// How radiance is brought into the display's range.
    pub tone_map: ToneMap,
    /// The method chosen for each term of shading.
    pub methods: Methods,
    /// What was passed over in the files that the scene was made from, in the user's words.
    pub notes: Vec<String>,
}

/// A material of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMaterial {
    /// What it is.
    pub document: Document,
    /// Where its relative paths start.
    pub directory: PathBuf,
}

/// A mesh with a material at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// For people, and to give it a material in a scene file.
    pub name: String,
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// World from object space; may mirror and scale unevenly.
    pub world_from_object: Mat4,
}

impl Object {
    /// Takes normals to world space up to their length, outward ones to outward ones.
    pub fn normal_from_object(&self) -> Mat3 {
        let columns = Mat3::from_mat4(self.world_from_object).to_cols_array_2d();
        Mat3::from_cols_array_2d(&halfvector_maps::frame::normal_from_object(columns))
    }

    /// Object from world space; zero where the object is scaled flat, so that there is no way back.
    pub fn object_from_world(&self) -> Mat4 {
        let inverse = self.world_from_object.inverse();
        if inverse.is_finite() { inverse } else { Mat4::ZERO }
    }

    /// -1 where the transform mirrors, else 1: front faces turn over, and the w of tangents changes its sign.
    pub fn handedness(&self) -> f32 {
        halfvector_maps::frame::handedness(Mat3::from_mat4(self.world_from_object).to_cols_array_2d())
    }
}

/// How radiance becomes display light, before the tone map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Factor 2^stops.
    Stops(f32),
    /// Exposure value at ISO 100: factor 1 / (1.2 * 2^EV100), the radiance at which a film of saturation-based speed
    /// saturates (ISO 12232; Lagarde and de Rousiers 2014, "Moving Frostbite to PBR", section 5.1).
    Ev100(f32),
}

impl Exposure {
    /// The factor on radiance.
    pub fn factor(self) -> f32 {
        match self {
            Exposure::Stops(stops) => stops.exp2(),
            Exposure::Ev100(ev100) => (-ev100).exp2() / 1.2,
        }
    }
}

/// What a mesh is made from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeshSource {
    /// A built-in shape.
    Builtin(BuiltinMesh),
    /// A `.glb` or `.gltf` file.
    File(PathBuf),
}

impl MeshSource {
    /// The name of a built-in shape, or the path of a `.glb` or `.gltf` file relative to `directory`.
    pub fn parse(text: &str, directory: &Path) -> Result<MeshSource, String> {
        if let Some(shape) = BuiltinMesh::from_name(text) {
            return Ok(MeshSource::Builtin(shape));
        }
        if gltf::has_gltf_extension(text) {
            return Ok(MeshSource::File(directory.join(text)));
        }
        let names: Vec<_> = BuiltinMesh::ALL.iter().map(|m| m.name()).collect();
        Err(format!("there is no mesh `{text}`; choose {}, or a .glb or .gltf file", names.join(", ")))
    }
}

/// Why a scene was not made.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// A scene file could not be read.
    #[error("{} could not be read: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A scene file says something that cannot be.
    #[error("{}: {place}: {reason}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// Line and column, or the field.
        place: String,
        /// What is wrong and what to write instead.
        reason: String,
    },
    /// A material document was refused.
    #[error(transparent)]
    Material(#[from] halfvector_graph::file::FileError),
    /// A glTF file was refused.
    #[error(transparent)]
    Gltf(#[from] GltfError),
    /// An image was refused.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// An environment was refused.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// A parameter was refused.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

impl Default for Scene {
    /// Nothing, seen by the default camera under `studio`, without punctual lights.
    fn default() -> Self {
        Scene {
            name: String::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
            images: ImageStore::default(),
            camera: Camera::default(),
            lights: Vec::new(),
            environment: EnvironmentSource::Studio,
            environment_rotation: 0.0,
            background: Background::default(),
            exposure: Exposure::Stops(0.0),
            tone_map: ToneMap::default(),
            methods: Methods::default(),
            notes: Vec::new(),
        }
    }
}

impl Scene {
    /// A bare material on a mesh, under `studio`, without punctual lights; its images are loaded. `directory` is where the
    /// document's relative paths start. All parts of a glTF model wear the material, and the camera frames it.
    pub fn from_material(document: Document, directory: &Path, mesh: &MeshSource) -> Result<Scene, SceneError> {
        let mut scene = Scene { name: document.name.clone(), ..Scene::default() };
        scene.materials.push(SceneMaterial { document, directory: directory.to_owned() });
        scene.set_mesh(mesh)?;
        scene.load_images()?;
        Ok(scene)
    }

    /// A glTF model as it is: its own materials, lights and camera (else one that frames it), under `studio`.
    pub fn from_model(path: &Path) -> Result<Scene, SceneError> {
        let model = gltf::load(path)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut scene = Scene {
            name,
            meshes: shared(model.meshes),
            materials: model.materials,
            objects: model.objects,
            lights: model.lights,
            notes: model.notes,
            ..Scene::default()
        };
        scene.camera = model.camera.filter(|camera| camera.check().is_ok()).unwrap_or_else(|| scene.framing_camera());
        scene.load_images()?;
        Ok(scene)
    }

    /// Replaces all objects by this mesh; it wears the scene's first material. The camera becomes the mesh's default.
    pub fn set_mesh(&mut self, mesh: &MeshSource) -> Result<(), SceneError> {
        self.meshes.clear();
        self.objects.clear();
        self.materials.truncate(1);
        match mesh {
            MeshSource::Builtin(shape) => {
                self.camera = Camera::default();
                self.add_builtin(*shape, 0, shape.preview_transform());
            }
            MeshSource::File(path) => {
                let model = gltf::load(path)?;
                self.notes.extend(model.notes);
                self.meshes = shared(model.meshes);
                self.objects = model.objects;
                for object in &mut self.objects {
                    object.material = 0;
                }
                self.camera = model.camera.unwrap_or_else(|| self.framing_camera());
            }
        }
        Ok(())
    }

    /// Adds a built-in shape that wears the material of this index; parts that stay neutral get a grey one.
    pub fn add_builtin(&mut self, shape: BuiltinMesh, material: usize, world_from_object: Mat4) {
        let mut grey = None;
        for part in shape.parts() {
            let material = if part.takes_material {
                material
            } else {
                *grey.get_or_insert_with(|| {
                    self.materials.push(neutral_material());
                    self.materials.len() - 1
                })
            };
            self.objects.push(Object {
                name: part.name.to_owned(),
                mesh: self.meshes.len(),
                material,
                world_from_object,
            });
            self.meshes.push(Arc::new(part.mesh));
        }
    }

    /// Loads the images of all materials that are not loaded yet, and takes over what is to be told about them.
    pub fn load_images(&mut self) -> Result<(), SceneError> {
        let told = self.images.notes().len();
        self.images.load(&self.materials)?;
        self.notes.extend_from_slice(&self.images.notes()[told..]);
        Ok(())
    }

    /// Loads them with a checker in place of each image that cannot be read, and those anew whose files have changed since: for
    /// pictures that follow what a person does. Why images are missing is not told here.
    pub fn load_images_or_stand_ins(&mut self) {
        self.images.forget_changed();
        drop(self.images.load_or_stand_in(&self.materials));
    }

    /// The smallest box around all objects in world space; `None` when there is nothing.
    pub fn bounds(&self) -> Option<Bounds> {
        let boxes = self.meshes.iter().map(|mesh| mesh.bounds()).collect::<Vec<_>>();
        let in_world = self.objects.iter().filter_map(|object| {
            let bounds = boxes.get(object.mesh).copied().flatten()?;
            Some(bounds.transformed(&object.world_from_object))
        });
        in_world.reduce(Bounds::union)
    }

    /// A camera that has everything in view; the default one when there is nothing.
    pub fn framing_camera(&self) -> Camera {
        self.bounds().map_or_else(Camera::default, Camera::framing)
    }
}

fn shared(meshes: Vec<Mesh>) -> Vec<Arc<Mesh>> {
    meshes.into_iter().map(Arc::new).collect()
}

/// What the parts of a shape that show no material are made of: grey, rather rough.
pub(crate) fn neutral_material() -> SceneMaterial {
    let values = [("base_color", Value::Vec3([0.18; 3])), ("perceptual_roughness", Value::Number(0.55))];
    SceneMaterial { document: surface_document("Neutral grey", values), directory: PathBuf::new() }
}

/// A document with nothing but a surface node named `surface`.
pub(crate) fn surface_document<const N: usize>(name: &str, values: [(&str, Value); N]) -> Document {
    let node = Node {
        node: "surface/surface".into(),
        label: None,
        values: values.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        unknown: Default::default(),
    };
    let mut document = Document::new(name);
    document.graph.nodes.insert("surface".to_owned(), node);
    document
}
