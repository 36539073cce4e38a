//! The scene graph: nodes, meshes, lights and cameras of a glTF file in world space.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use glam::{Mat3, Mat4, Quat, Vec3};
use gltf::json::camera::Type as CameraType;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as GltfLight, Type as LightType};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::scene::Node;
use gltf::json::validation::Checked;
use rayon::prelude::*;

use super::accessor::{count, read_colors, read_indices, read_vectors};
use super::asset::Asset;
use super::material::{default_material, document, normal_uv_set, tinted_materials};
use super::{Fault, GltfError, Result, entry};
use crate::camera::Camera;
use crate::light::Light;
use crate::mesh::{Bounds, MAX_ELEMENTS, Mesh, MeshData};
use crate::scene::{Object, SceneMaterial};

/// Largest number of objects of a model.
const MAX_OBJECTS: usize = 1 << 18;

/// What a glTF file holds, in world space.
#[derive(Clone, Debug)]
pub struct Model {
    /// One per primitive that is drawn.
    pub meshes: Vec<Mesh>,
    /// As in the file, then glTF's default material if a primitive has none.
    pub materials: Vec<SceneMaterial>,
    /// One per node and primitive, named after the node.
    pub objects: Vec<Object>,
    /// KHR_lights_punctual.
    pub lights: Vec<Light>,
    /// The first perspective camera, if any.
    pub camera: Option<Camera>,
    /// What was passed over.
    pub notes: Vec<String>,
}

/// Reads a `.glb` or `.gltf` file. Images are not read yet: the documents refer to them.
pub fn load(path: &Path) -> std::result::Result<Model, GltfError> {
    from_asset(&Asset::open(path)?)
}

/// The model in a file that is in memory already.
pub fn from_asset(asset: &Asset) -> std::result::Result<Model, GltfError> {
    build(asset).map_err(|fault| fault.of(asset.path()))
}

fn build(asset: &Asset) -> Result<Model> {
    let mut notes = asset.notes.clone();
    let instances = instances(asset)?;
    let directory = asset.path().parent().unwrap_or(Path::new("")).to_owned();
    let mut materials = Vec::new();
    let tinted = tinted_materials(asset);
    for index in 0..asset.root.materials.len() {
        let document = document(asset, index, tinted.contains(&Some(index)), &mut notes)?;
        materials.push(SceneMaterial { document, directory: directory.clone() });
    }

    let mut model =
        Model { meshes: Vec::new(), materials, objects: Vec::new(), lights: Vec::new(), camera: None, notes };
    let drawn = model.add_objects(asset, &instances, directory, tinted.contains(&None))?;
    let meshes: Result<Vec<Mesh>> = drawn.par_iter().map(|d| read_mesh(asset, d)).collect();
    model.meshes = meshes?;
    for &(node, world_from_node) in &instances {
        model.add_light(asset, node, world_from_node)?;
    }
    let boxes: Vec<_> = model.meshes.iter().map(Mesh::bounds).collect();
    let in_world = model.objects.iter().filter_map(|o| Some(boxes[o.mesh]?.transformed(&o.world_from_object)));
    let bounds = in_world.reduce(Bounds::union);
    model.camera = camera(asset, &instances, bounds);
    model.note_what_is_passed_over(asset);
    let mut said = HashSet::new();
    model.notes.retain(|note| said.insert(note.clone()));
    Ok(model)
}

/// A primitive that is drawn.
struct Drawn<'a> {
    primitive: &'a Primitive,
    place: String,
}

impl Model {
    fn add_objects<'a>(
        &mut self,
        asset: &'a Asset,
        instances: &[(usize, Mat4)],
        directory: std::path::PathBuf,
        is_default_tinted: bool,
    ) -> Result<Vec<Drawn<'a>>> {
        let root = &asset.root;
        let mut drawn: Vec<Drawn> = Vec::new();
        let mut known: HashMap<(usize, usize), usize> = HashMap::new();
        let mut default = None;
        let mut vertices = 0usize;
        let mut skipped = 0;
        for &(index, world_from_object) in instances {
            let node = &root.nodes[index];
            let Some(mesh) = node.mesh else { continue };
            let mesh_index = mesh.value();
            let mesh = entry(&root.meshes, "meshes", mesh_index, &format!("nodes[{index}]"))?;
            for (number, primitive) in mesh.primitives.iter().enumerate() {
                let place = format!("meshes[{mesh_index}].primitives[{number}]");
                match primitive.mode {
                    Checked::Valid(Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) => {}
                    Checked::Valid(_) => {
                        skipped += 1;
                        continue;
                    }
                    Checked::Invalid => return Err(Fault::new(place, "the mode is none of glTF's")),
                }
                let material = match primitive.material {
                    Some(material) => {
                        entry(&root.materials, "materials", material.value(), &place)?;
                        material.value()
                    }
                    None => *default.get_or_insert_with(|| {
                        self.materials.push(SceneMaterial {
                            document: default_material(is_default_tinted),
                            directory: directory.clone(),
                        });
                        self.materials.len() - 1
                    }),
                };
                let slot = match known.get(&(mesh_index, number)) {
                    Some(&slot) => slot,
                    None => {
                        for accessor in primitive
                            .attributes
                            .get(&Checked::Valid(Semantic::Positions))
                            .into_iter()
                            .chain(&primitive.indices)
                        {
                            vertices = vertices.saturating_add(count(asset, *accessor, &place)?);
                        }
                        if vertices > MAX_ELEMENTS {
                            return Err(Fault::new(
                                place,
                                format!("the model has more than {MAX_ELEMENTS} vertices and indices"),
                            ));
                        }
                        known.insert((mesh_index, number), drawn.len());
                        drawn.push(Drawn { primitive, place });
                        drawn.len() - 1
                    }
                };
                if self.objects.len() >= MAX_OBJECTS {
                    return Err(Fault::new(
                        format!("nodes[{index}]"),
                        format!("there are more than {MAX_OBJECTS} objects"),
                    ));
                }
                let name = node.name.clone().or_else(|| mesh.name.clone()).unwrap_or_else(|| format!("node {index}"));
                self.objects.push(Object { name, mesh: slot, material, world_from_object });
            }
        }
        if skipped > 0 {
            self.notes.push(format!("{skipped} primitives made of points or lines are passed over"));
        }
        Ok(drawn)
    }

    fn add_light(&mut self, asset: &Asset, node: usize, world_from_node: Mat4) -> Result<()> {
        let extensions = asset.root.nodes[node].extensions.as_ref();
        let Some(light) = extensions.and_then(|e| e.khr_lights_punctual.as_ref()) else { return Ok(()) };
        let place = format!("nodes[{node}]");
        let lights = asset.root.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
        let lights = lights.map_or(&[][..], |l| &l.lights);
        let index = light.light.value();
        let light = entry(lights, "lights", index, &place)?;
        let place = format!("lights[{index}]");
        self.lights.push(read_light(light, world_from_node).map_err(|reason| Fault::new(&place, reason))?);
        if light.range.is_some() {
            self.notes
                .push("the range of lights is passed over; light falls off by the square of the distance".to_owned());
        }
        Ok(())
    }

    fn note_what_is_passed_over(&mut self, asset: &Asset) {
        let root = &asset.root;
        let primitives = || root.meshes.iter().flat_map(|m| &m.primitives);
        let has = |wanted: fn(&Semantic) -> bool| {
            primitives().any(|p| p.attributes.keys().any(|k| matches!(k, Checked::Valid(s) if wanted(s))))
        };
        let cases = [
            (has(|s| matches!(s, Semantic::Colors(n) if *n > 0)), "vertex colours beyond the first"),
            (!root.skins.is_empty() || has(|s| matches!(s, Semantic::Joints(_))), "skins"),
            (primitives().any(|p| p.targets.is_some()), "morph targets"),
            (!root.animations.is_empty(), "animations"),
        ];
        let names: Vec<_> = cases.into_iter().filter(|(there, _)| *there).map(|(_, name)| name).collect();
        if !names.is_empty() {
            self.notes.push(format!("passed over: {}", names.join(", ")));
        }
    }
}

/// (node, world from node) of every node of the file's scene, parents before children, in order.
fn instances(asset: &Asset) -> Result<Vec<(usize, Mat4)>> {
    let root = &asset.root;
    let roots: Vec<usize> = match (root.scene, root.scenes.first()) {
        (Some(scene), _) => {
            let scene = entry(&root.scenes, "scenes", scene.value(), "scene")?;
            scene.nodes.iter().map(|n| n.value()).collect()
        }
        (None, Some(scene)) => scene.nodes.iter().map(|n| n.value()).collect(),
        (None, None) => {
            let mut has_parent = vec![false; root.nodes.len()];
            for child in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
                if let Some(flag) = has_parent.get_mut(child.value()) {
                    *flag = true;
                }
            }
            (0..root.nodes.len()).filter(|&i| !has_parent[i]).collect()
        }
    };
    let mut visited = vec![false; root.nodes.len()];
    let mut result = Vec::new();
    let mut open: Vec<(usize, Mat4)> = roots.into_iter().rev().map(|n| (n, Mat4::IDENTITY)).collect();
    while let Some((index, world_from_parent)) = open.pop() {
        let place = format!("nodes[{index}]");
        let node = entry(&root.nodes, "nodes", index, "scene")?;
        if std::mem::replace(&mut visited[index], true) {
            return Err(Fault::new(place, "the node has two parents or is its own ancestor; a glTF scene is a tree"));
        }
        let world_from_node = world_from_parent * parent_from_node(node);
        if !world_from_node.is_finite() {
            return Err(Fault::new(place, "the transform is not finite"));
        }
        result.push((index, world_from_node));
        for child in node.children.iter().flatten().rev() {
            entry(&root.nodes, "nodes", child.value(), &place)?;
            open.push((child.value(), world_from_node));
        }
    }
    Ok(result)
}

fn parent_from_node(node: &Node) -> Mat4 {
    if let Some(matrix) = &node.matrix {
        return Mat4::from_cols_array(matrix);
    }
    let rotation = Quat::from_array(node.rotation.unwrap_or_default().0);
    let rotation = if rotation.length_squared() > 0.0 { rotation.normalize() } else { Quat::IDENTITY };
    Mat4::from_scale_rotation_translation(
        Vec3::from(node.scale.unwrap_or([1.0; 3])),
        rotation,
        Vec3::from(node.translation.unwrap_or_default()),
    )
}

fn read_mesh(asset: &Asset, drawn: &Drawn<'_>) -> Result<Mesh> {
    let Drawn { primitive, place } = drawn;
    let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
    let positions = attribute(Semantic::Positions).ok_or_else(|| Fault::new(place, "it has no POSITION"))?;
    let positions: Vec<[f32; 3]> = read_vectors(asset, positions, place)?;
    let normals = attribute(Semantic::Normals).map(|a| read_vectors(asset, a, place)).transpose()?;
    let tangents = attribute(Semantic::Tangents).map(|a| read_vectors(asset, a, place)).transpose()?;
    let uv0 = attribute(Semantic::TexCoords(0)).map(|a| read_vectors(asset, a, place)).transpose()?;
    let uv1 = attribute(Semantic::TexCoords(1)).map(|a| read_vectors(asset, a, place)).transpose()?;
    let colors = attribute(Semantic::Colors(0)).map(|a| read_colors(asset, a, place)).transpose()?;
    let order = match primitive.indices {
        Some(indices) => read_indices(asset, indices, place)?,
        None => (0..positions.len() as u32).collect(),
    };
    let indices = match primitive.mode {
        Checked::Valid(Mode::TriangleStrip) => strip(&order),
        Checked::Valid(Mode::TriangleFan) => fan(&order),
        _ => order,
    };
    let material = primitive.material.and_then(|m| asset.root.materials.get(m.value()));
    let tangents_along_uv1 = material.is_some_and(|m| normal_uv_set(m) == 1);
    let data = MeshData { positions, normals, tangents, uv0, uv1, colors, tangents_along_uv1, indices };
    Mesh::build(data).map_err(|e| Fault::new(place, e.to_string()))
}

/// glTF 2.0, section 3.7.2.1: every vertex makes a triangle with the two before it, the winding alternates.
fn strip(order: &[u32]) -> Vec<u32> {
    let triangles = order.windows(3).enumerate();
    triangles.flat_map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] }).collect()
}

/// glTF 2.0, section 3.7.2.1: every two neighbours make a triangle with the first vertex.
fn fan(order: &[u32]) -> Vec<u32> {
    let Some((&first, rest)) = order.split_first() else { return Vec::new() };
    rest.windows(2).flat_map(|w| [w[0], w[1], first]).collect()
}

fn read_light(light: &GltfLight, world_from_node: Mat4) -> std::result::Result<Light, String> {
    let color = Vec3::from(light.color) * light.intensity;
    if !color.is_finite() || color.min_element() < 0.0 {
        return Err("colour times intensity must be finite and not negative".into());
    }
    let position = world_from_node.w_axis.truncate();
    let backwards = Mat3::from_mat4(world_from_node).z_axis.try_normalize();
    let backwards = backwards.ok_or("the node's transform leaves no direction");
    match light.type_ {
        Checked::Valid(LightType::Directional) => {
            Ok(Light::Directional { direction_to_light: backwards?, illuminance: color })
        }
        Checked::Valid(LightType::Point) => Ok(Light::Point { position, intensity: color }),
        Checked::Valid(LightType::Spot) => {
            let spot = light.spot.as_ref().ok_or("a spot light needs the field `spot`")?;
            let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
            // A hair of room for pi / 2 written in decimals.
            if !(0.0 <= inner && inner < outer && outer <= std::f32::consts::FRAC_PI_2 + 1e-5) {
                return Err(format!("the cone is {inner} to {outer} radians; 0 <= inner < outer <= pi / 2 is needed"));
            }
            let direction = -backwards?;
            Ok(Light::Spot { position, direction, intensity: color, inner_angle: inner, outer_angle: outer })
        }
        Checked::Invalid => Err("the type is none of directional, point, spot".into()),
    }
}

/// The first perspective camera; its target lies at the depth of the model's middle, or at distance 1.
fn camera(asset: &Asset, instances: &[(usize, Mat4)], bounds: Option<Bounds>) -> Option<Camera> {
    instances.iter().find_map(|&(node, world_from_node)| {
        let camera = asset.root.cameras.get(asset.root.nodes[node].camera?.value())?;
        let Checked::Valid(CameraType::Perspective) = camera.type_ else { return None };
        let perspective = camera.perspective.as_ref()?;
        let axes = Mat3::from_mat4(world_from_node);
        let position = world_from_node.w_axis.truncate();
        let forward = (-axes.z_axis).try_normalize()?;
        let depth = bounds.map_or(1.0, |b| (b.center() - position).dot(forward));
        let target = position + forward * if depth > 0.0 { depth } else { 1.0 };
        let camera = Camera { position, target, up: axes.y_axis, vertical_fov: perspective.yfov.to_degrees() };
        camera.check().is_ok().then_some(camera)
    })
}
