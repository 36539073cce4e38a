//! What a scene needs of a material's shader. Plain data: a scene makes it, the code generator reads it.

use crate::method::Methods;

/// What the scene that a shader is made for holds; what is not needed is not emitted.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Needs {
    /// Number of directional lights.
    pub directional_lights: u32,
    /// Number of point lights.
    pub point_lights: u32,
    /// Number of spot lights.
    pub spot_lights: u32,
    /// The environment, if any.
    pub environment: Option<EnvironmentNeeds>,
    /// What the fragment shader returns.
    pub output: ShaderOutput,
    /// The method chosen for each term.
    pub methods: Methods,
}

/// What is known of the environment when the shader is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct EnvironmentNeeds {
    /// Whether it is turned about +Y: only then the shader rotates directions.
    pub rotated: bool,
}

/// What the fragment shader returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShaderOutput {
    /// Linear radiance, Rec. 709.
    Radiance,
    /// Radiance times the exposure factor, through this tone map, then sRGB-coded.
    Display(ToneMap),
}

/// How radiance is brought into [0, 1] for a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneMap {
    /// Clamped.
    None,
    /// x / (1 + x) by channel.
    Reinhard,
    /// Narkowicz's fit of the ACES reference.
    Aces,
    /// AgX, Sobotka's, by its polynomial fit.
    Agx,
    /// Khronos' neutral tone map for products.
    #[default]
    PbrNeutral,
}

impl ToneMap {
    /// All, in the order shown.
    pub const ALL: [ToneMap; 5] = [ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::PbrNeutral];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            ToneMap::None => "none",
            ToneMap::Reinhard => "reinhard",
            ToneMap::Aces => "aces",
            ToneMap::Agx => "agx",
            ToneMap::PbrNeutral => "pbr-neutral",
        }
    }
}
