//! Files of scenes: glTF, scene files, the project's examples, the models beside the project.

mod data;
mod examples;
mod gltf;
mod gltf_material;
mod hostile;
mod images;
#[path = "../../../../tests/tests/models.rs"]
mod models;
mod scene_file;
mod support;
