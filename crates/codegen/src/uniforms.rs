//! What fills each member of a uniform block: the view, the lights, the environment, the object, the document. Where the
//! numbers come from is the renderer's affair; here each finds its member.

use halfvector_graph::document::Document;
use halfvector_graph::library::Library;

use crate::passes::lower::input_value;
use crate::reflection::{LightKind, UniformBlock, UniformSource, UniformType};

/// What a frame or tile knows.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameValues {
    /// Clip space of the tile from world space, column by column.
    pub clip_from_world: [f32; 16],
    /// View space from world space, column by column; see [`UniformSource::ViewFromWorld`].
    pub view_from_world: [f32; 16],
    /// In world space.
    pub camera_position: [f32; 3],
    /// Seconds.
    pub time: f32,
    /// Factor from radiance to display units.
    pub exposure: f32,
    /// (cos, sin) of the environment's rotation about +Y.
    pub environment_rotation: [f32; 2],
    /// Levels of the prefiltered radiance.
    pub environment_levels: u32,
    /// Irradiance over pi.
    pub irradiance_sh: [[f32; 3]; 9],
    /// The lights by kind, in the order of [`LightKind::ALL`]: each light's numbers as [`UniformType::numbers`] has them.
    pub lights: [Vec<f32>; 3],
}

/// What an object knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectValues {
    /// World from object space, column by column.
    pub world_from_object: [f32; 16],
    /// The way back, column by column; zero where there is none.
    pub object_from_world: [f32; 16],
    /// Takes normals to world space, column by column; see [`UniformSource::NormalFromObject`].
    pub normal_from_object: [f32; 9],
}

impl FrameValues {
    /// Appends the numbers of a source that belongs to the frame; others append nothing.
    pub fn fill(&self, source: &UniformSource, numbers: &mut Vec<f64>) {
        match source {
            UniformSource::ClipFromWorld => numbers.extend(self.clip_from_world.map(f64::from)),
            UniformSource::ViewFromWorld => numbers.extend(self.view_from_world.map(f64::from)),
            UniformSource::CameraPosition => numbers.extend(self.camera_position.map(f64::from)),
            UniformSource::Time => numbers.push(f64::from(self.time)),
            UniformSource::Exposure => numbers.push(f64::from(self.exposure)),
            UniformSource::EnvironmentRotation => numbers.extend(self.environment_rotation.map(f64::from)),
            UniformSource::EnvironmentLevels => numbers.push(f64::from(self.environment_levels)),
            UniformSource::IrradianceSh => {
                numbers.extend(self.irradiance_sh.as_flattened().iter().copied().map(f64::from))
            }
            UniformSource::Lights(LightKind::Directional) => {
                numbers.extend(self.lights[0].iter().copied().map(f64::from))
            }
            UniformSource::Lights(LightKind::Point) => numbers.extend(self.lights[1].iter().copied().map(f64::from)),
            UniformSource::Lights(LightKind::Spot) => numbers.extend(self.lights[2].iter().copied().map(f64::from)),
            UniformSource::Input(_)
            | UniformSource::WorldFromObject
            | UniformSource::ObjectFromWorld
            | UniformSource::NormalFromObject => {}
        }
    }
}

impl ObjectValues {
    /// Appends the numbers of a source that belongs to an object; others append nothing.
    pub fn fill(&self, source: &UniformSource, numbers: &mut Vec<f64>) {
        match source {
            UniformSource::WorldFromObject => numbers.extend(self.world_from_object.map(f64::from)),
            UniformSource::ObjectFromWorld => numbers.extend(self.object_from_world.map(f64::from)),
            UniformSource::NormalFromObject => numbers.extend(self.normal_from_object.map(f64::from)),
            _ => {}
        }
    }
}

/// Appends the numbers of an input of a node of the document, as the block `block` wants them: the value set, else the
/// library's default. Sources of other kinds append nothing.
pub fn fill_input(
    document: &Document,
    library: &Library,
    block: &UniformBlock,
    source: &UniformSource,
    numbers: &mut Vec<f64>,
) {
    let UniformSource::Input(socket) = source else { return };
    let ty = block.members.iter().find(|member| member.source == *source).map(|member| member.ty);
    let Some(UniformType::Value(ty)) = ty else { return };
    numbers.extend(input_value(document, library, socket, ty).unwrap_or_default());
}
