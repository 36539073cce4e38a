//! The fields of a scene file, as they are written. What they mean and whether they fit is for `file` and `lights`.

use std::collections::BTreeMap;

use serde::Deserialize;

#[derive(Deserialize)]
pub(super) struct Version {
    pub(super) halfvector: Option<serde_json::Value>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    #[serde(rename = "halfvector")]
    pub(super) _version: u32,
    #[serde(default)]
    pub(super) name: Option<String>,
    pub(super) objects: Vec<ObjectEntry>,
    #[serde(default)]
    pub(super) camera: Option<CameraEntry>,
    #[serde(default)]
    pub(super) lights: Vec<LightEntry>,
    #[serde(default)]
    pub(super) environment: Option<EnvironmentEntry>,
    #[serde(default)]
    pub(super) background: Option<BackgroundEntry>,
    #[serde(default)]
    pub(super) exposure: Option<ExposureEntry>,
    #[serde(default)]
    pub(super) tone_map: Option<String>,
    #[serde(default)]
    pub(super) preset: Option<String>,
    #[serde(default)]
    pub(super) methods: BTreeMap<String, String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectEntry {
    pub(super) mesh: String,
    #[serde(default)]
    pub(super) name: Option<String>,
    /// For all parts.
    #[serde(default)]
    pub(super) material: Option<MaterialEntry>,
    /// By part: name of the part of a built-in shape; name or `#N` of a model's material.
    #[serde(default)]
    pub(super) materials: BTreeMap<String, MaterialEntry>,
    #[serde(default)]
    pub(super) transform: TransformEntry,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "a material is a path, or {\"file\": path, \"set\": {parameter: number or list}}"
)]
pub(super) enum MaterialEntry {
    Path(String),
    WithParameters {
        file: String,
        #[serde(default)]
        set: BTreeMap<String, Numbers>,
    },
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "a value is a number, true or false, or a list of numbers")]
pub(super) enum Numbers {
    Switch(bool),
    One(f64),
    Many(Vec<f64>),
}

/// Scaled, then turned about Y, X and Z in this order, then moved; or a matrix alone.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TransformEntry {
    #[serde(default)]
    pub(super) translation: Option<[f32; 3]>,
    /// About X, Y, Z, all fixed in the world: Rz Rx Ry.
    #[serde(default)]
    pub(super) rotation_deg: Option<[f32; 3]>,
    #[serde(default)]
    pub(super) scale: Option<ScaleEntry>,
    /// By columns, instead of the others.
    #[serde(default)]
    pub(super) matrix: Option<[f32; 16]>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "a scale is a number or a list of three")]
pub(super) enum ScaleEntry {
    Even(f32),
    ByAxis([f32; 3]),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraEntry {
    pub(super) position: [f32; 3],
    #[serde(default)]
    pub(super) target: [f32; 3],
    #[serde(default = "up")]
    pub(super) up: [f32; 3],
    #[serde(default = "vertical_fov_deg")]
    pub(super) vertical_fov_deg: f32,
}

fn up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

fn vertical_fov_deg() -> f32 {
    30.0
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum LightEntry {
    Directional {
        /// From the surface to the light.
        direction_to_light: [f32; 3],
        #[serde(default)]
        illuminance_lx: Option<f32>,
        #[serde(default)]
        irradiance_w_m2: Option<f32>,
        #[serde(default = "white")]
        color: [f32; 3],
    },
    Point {
        position: [f32; 3],
        #[serde(default)]
        intensity_cd: Option<f32>,
        #[serde(default)]
        power_lm: Option<f32>,
        #[serde(default)]
        power_w: Option<f32>,
        #[serde(default = "white")]
        color: [f32; 3],
    },
    Spot {
        position: [f32; 3],
        /// The way the light shines.
        direction: [f32; 3],
        #[serde(default)]
        intensity_cd: Option<f32>,
        #[serde(default)]
        power_lm: Option<f32>,
        #[serde(default)]
        power_w: Option<f32>,
        #[serde(default)]
        inner_deg: f32,
        outer_deg: f32,
        #[serde(default = "white")]
        color: [f32; 3],
    },
}

fn white() -> [f32; 3] {
    [1.0; 3]
}

#[derive(Deserialize)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "an environment is white, studio, sky, none or a file, or {\"source\": one of these, \"rotation_deg\": number}"
)]
pub(super) enum EnvironmentEntry {
    Source(String),
    Turned {
        source: String,
        #[serde(default)]
        rotation_deg: f32,
    },
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "a background is \"env\", \"none\" or a list of three numbers")]
pub(super) enum BackgroundEntry {
    Name(String),
    Color([f32; 3]),
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum ExposureEntry {
    Stops(f32),
    Ev100(f32),
}
