//! Scenes: what a material is seen on, from where and in which light.
//!
//! * [`scene::Scene`] is the whole: meshes, materials, objects, images, camera, lights, environment, exposure.
//! * [`file`](mod@file) reads `*.scene.json`, [`gltf`] reads `.glb` and `.gltf`, [`mesh`] has the built-in shapes.
//! * [`light`] and [`tone_map`] are twins of the WGSL files of the same names, generic over `f32` and `f64`.
//! * [`needs`] says what a material's shader has to serve; [`passes()`] in which order objects are drawn, [`View`] from
//!   where, and [`Picture`] how samples become pixels: what every renderer does alike.
//!
//! Right-handed, +Y up, metres; colours are linear Rec. 709. Nothing is drawn here and no environment is baked.

mod bake;
pub mod camera;
mod display;
pub mod environment;
pub mod file;
pub mod gltf;
pub mod images;
pub mod light;
pub mod mesh;
mod needs;
mod normal_maps;
pub mod parameters;
mod passes;
mod picture;
mod real;
pub mod scene;
mod square;
pub mod texels;
mod textures;
pub mod tone_map;
mod view;

pub use bake::{bake_options, ggx_roughness};
pub use camera::Camera;
pub use display::Display;
pub use environment::{Background, EnvironmentSource};
pub use file::load_scene;
pub use images::{FileStamp, ImageError, ImageFault, ImageStore};
pub use light::Light;
pub use mesh::{BuiltinMesh, Mesh};
pub use needs::needs;
pub use normal_maps::normal_map_problems;
pub use passes::{FacePass, Passes, PassesError, Side, passes};
pub use picture::{Picture, Tile, tiles};
pub use scene::{Exposure, MeshSource, Object, Scene, SceneError, SceneMaterial};
pub use textures::{TextureLevels, dfg_visibility, texture_levels};
pub use view::View;
