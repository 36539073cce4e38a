//! What a golden reads, made from its reflection: smooth images, cubes and tables, a few lights, a sphere.

use halfvector_codegen::reflection::{
    Binding, LightKind, Resource, SamplerSource, TextureSource, UniformSource, UniformType,
};
use halfvector_codegen::uniforms::{FrameValues, ObjectValues, fill_input};
use halfvector_graph::library::Library;
use halfvector_graph::value::{ColorSpace, Filter, Wrap};
use halfvector_ibl::{DFG_SIZE, Visibility, dfg_table_with, direction_from_face};
use halfvector_scene::Mesh;
use halfvector_scene::light::{lights_by_kind, parse_light};
use halfvector_scene::mesh::MeshData;
use halfvector_scene::texels::dfg_bytes;
use serde_json::{Value, json};

use crate::golden::Golden;

/// Pixels along a side; with 4 bytes each a row is as long as devices want copied rows to be.
pub(super) const SIZE: u32 = 64;

/// Texels along a side of images, and of the faces of the cubes' first levels.
const TEXELS: u32 = 16;
/// Levels of the prefiltered radiance.
const LEVELS: u32 = 5;

/// Everything outside of itself that a golden reads.
pub(super) struct Inputs {
    pub(super) blocks: Vec<(Binding, Vec<u8>)>,
    pub(super) textures: Vec<(Binding, Texture)>,
    pub(super) samplers: Vec<(Binding, SamplerSource)>,
}

/// A texture: levels of layers of rows of texels.
pub(super) struct Texture {
    pub(super) format: Format,
    pub(super) is_cube: bool,
    /// Texels along a side of each level, and their bytes, layer after layer.
    pub(super) levels: Vec<(u32, Vec<u8>)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Rgba8,
    Srgb8,
    Rgba16F,
    Rg16F,
}

impl Format {
    pub(super) fn bytes(self) -> u32 {
        match self {
            Format::Rgba8 | Format::Srgb8 | Format::Rg16F => 4,
            Format::Rgba16F => 8,
        }
    }
}

impl Inputs {
    pub(super) fn of(golden: &Golden) -> Inputs {
        let frame = frame(golden);
        let object = ObjectValues {
            world_from_object: glam::Mat4::IDENTITY.to_cols_array(),
            object_from_world: glam::Mat4::IDENTITY.to_cols_array(),
            normal_from_object: glam::Mat3::IDENTITY.to_cols_array(),
        };
        let mut inputs = Inputs { blocks: Vec::new(), textures: Vec::new(), samplers: Vec::new() };
        for binding in &golden.shader.reflection.bindings {
            match &binding.resource {
                Resource::Uniform(block) => {
                    let bytes = block.pack(|source: &UniformSource, numbers: &mut Vec<f64>| {
                        frame.fill(source, numbers);
                        object.fill(source, numbers);
                        fill_input(&golden.document, Library::standard(), block, source, numbers);
                    });
                    let bytes = bytes.unwrap_or_else(|e| panic!("{}: {e}", golden.name));
                    inputs.blocks.push((binding.clone(), bytes));
                }
                Resource::Texture(source) => inputs.textures.push((binding.clone(), texture(source))),
                Resource::Sampler(source) => inputs.samplers.push((binding.clone(), source.clone())),
            }
        }
        inputs
    }
}

fn frame(golden: &Golden) -> FrameValues {
    let count = |kind: LightKind| {
        let members = golden.shader.reflection.bindings.iter().filter_map(|binding| match &binding.resource {
            Resource::Uniform(block) => Some(block.members.iter()),
            _ => None,
        });
        members
            .flatten()
            .find_map(|member| match member.ty {
                UniformType::Lights(of, count) if of == kind => Some(count as usize),
                _ => None,
            })
            .unwrap_or(0)
    };
    let specs = [
        (LightKind::Directional, ["directional:1,1,2:1.5", "directional:-1,0.5,1:0.5:1,0.6,0.3", ""]),
        (LightKind::Point, ["point:0,2,2:2:0.4,0.6,1", "", ""]),
        (
            LightKind::Spot,
            [
                "spot:0,1,3:0,-0.3,-1:6:10:40",
                "spot:2,0,2:-1,0,-1:4:10:40:1,0.5,0.2",
                "spot:-2,0,2:1,0,-1:4:20:50:0.2,0.5,1",
            ],
        ),
    ];
    let lights: Vec<_> = specs
        .iter()
        .flat_map(|(kind, specs)| specs.iter().take(count(*kind)))
        .map(|spec| parse_light(spec).expect("a light"))
        .collect();
    let [x, y, z] = [0.2, 0.15, 4.0];
    // Straight along -Z, all at the same depth, which lies in the clip space of every API.
    let zoom = 3.2;
    let rows = [
        glam::Vec4::new(zoom, 0.0, 0.0, -zoom * x),
        glam::Vec4::new(0.0, zoom, 0.0, -zoom * y),
        glam::Vec4::new(0.0, 0.0, -0.5, 0.5 * z),
        glam::Vec4::new(0.0, 0.0, -1.0, z),
    ];
    let clip_from_world = glam::Mat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
    let (sin, cos) = 0.7_f32.sin_cos();
    let mut irradiance_sh = [[0.0; 3]; 9];
    (irradiance_sh[0], irradiance_sh[1]) = ([0.4, 0.5, 0.6], [0.1, 0.05, 0.02]);
    FrameValues {
        clip_from_world: clip_from_world.to_cols_array(),
        view_from_world: glam::Mat4::from_translation(-glam::Vec3::new(x, y, z)).to_cols_array(),
        camera_position: [x, y, z],
        time: 0.0,
        exposure: 0.8,
        environment_rotation: [cos, sin],
        environment_levels: LEVELS,
        irradiance_sh,
        lights: lights_by_kind(&lights).numbers(),
    }
}

/// A sphere of few triangles.
pub(super) fn sphere() -> Sphere {
    const ACROSS: u32 = 48;
    const DOWN: u32 = 24;
    let mut data = MeshData::default();
    let (mut normals, mut uv0) = (Vec::new(), Vec::new());
    for row in 0..=DOWN {
        for column in 0..=ACROSS {
            let (u, v) = (column as f32 / ACROSS as f32, row as f32 / DOWN as f32);
            let ((sin_phi, cos_phi), (sin, cos)) =
                ((std::f32::consts::TAU * u).sin_cos(), (std::f32::consts::PI * v).sin_cos());
            normals.push([sin * cos_phi, cos, -sin * sin_phi]);
            uv0.push([u, v]);
            if row < DOWN && column < ACROSS {
                let at = row * (ACROSS + 1) + column;
                let below = at + ACROSS + 1;
                data.indices.extend([at, below, at + 1, at + 1, below, below + 1]);
            }
        }
    }
    data.positions.clone_from(&normals);
    data.colors = Some(uv0.iter().map(|[u, v]| [*u, *v, 1.0 - u, 0.5 + 0.5 * v]).collect());
    (data.normals, data.uv0) = (Some(normals), Some(uv0));
    Sphere(Mesh::build(data).expect("a sound mesh"))
}

/// The mesh of all pictures.
pub(super) struct Sphere(Mesh);

impl Sphere {
    pub(super) fn indices(&self) -> &[u32] {
        &self.0.indices
    }

    /// The bytes of an attribute and its components.
    pub(super) fn attribute(&self, name: &str) -> (&[u8], u32) {
        match name {
            "position" => (bytemuck::cast_slice(&self.0.positions), 3),
            "normal" => (bytemuck::cast_slice(&self.0.normals), 3),
            "tangent" => (bytemuck::cast_slice(&self.0.tangents), 4),
            "uv0" => (bytemuck::cast_slice(&self.0.uv0), 2),
            "uv1" => (bytemuck::cast_slice(&self.0.uv1), 2),
            "color" => (bytemuck::cast_slice(&self.0.colors), 4),
            _ => panic!("no attribute {name}"),
        }
    }

    pub(super) fn as_json(&self) -> Value {
        let attributes: serde_json::Map<String, Value> = ["position", "normal", "tangent", "uv0", "uv1", "color"]
            .into_iter()
            .map(|name| {
                let (bytes, components) = self.attribute(name);
                (name.to_owned(), json!({ "bytes": hex(bytes), "components": components }))
            })
            .collect();
        json!({ "attributes": attributes, "indices": hex(bytemuck::cast_slice(self.indices())) })
    }
}

fn texture(source: &TextureSource) -> Texture {
    match source {
        TextureSource::Image(image) => {
            let format = if image.color_space == ColorSpace::Srgb { Format::Srgb8 } else { Format::Rgba8 };
            Texture { format, is_cube: false, levels: vec![(TEXELS, picture())] }
        }
        TextureSource::PrefilteredRadiance => cube(LEVELS),
        TextureSource::IrradianceOverPi => cube(1),
        TextureSource::Dfg => {
            let table = dfg_table_with(DFG_SIZE, Visibility::Correlated);
            Texture { format: Format::Rg16F, is_cube: false, levels: vec![(table.size as u32, dfg_bytes(&table))] }
        }
    }
}

/// Waves that fit the borders: they may be colours, and are nearly straight up as normals.
fn picture() -> Vec<u8> {
    let wave = |i: u32, phase: f32| (std::f32::consts::TAU * i as f32 / TEXELS as f32 + phase).sin();
    let texel = |x: u32, y: u32| {
        let code = |value: f32| (255.0 * value).round() as u8;
        [code(0.5 + 0.12 * wave(x, 0.3)), code(0.5 + 0.12 * wave(y, 1.0)), code(0.9 + 0.05 * wave(x + y, 0.0)), 255]
    };
    (0..TEXELS * TEXELS).flat_map(|i| texel(i % TEXELS, i / TEXELS)).collect()
}

/// A cube whose radiance follows the direction, a little different in each level.
fn cube(levels: u32) -> Texture {
    let levels = (0..levels).map(|level| {
        let size = (TEXELS >> level).max(1);
        let half = |x: f32| half::f16::from_f32(x).to_le_bytes();
        let mut bytes = Vec::new();
        for face in 0..6 {
            for texel in 0..size * size {
                let at = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(size) - 1.0;
                let direction = direction_from_face(face, at(texel % size), at(texel / size));
                let [x, y, z] = glam::DVec3::from(direction).normalize().as_vec3().to_array();
                let dim = 1.0 - 0.05 * level as f32;
                let color = [0.35 + 0.15 * y + 0.1 * x, 0.35 + 0.15 * y, 0.4 + 0.1 * z];
                bytes.extend(color.map(|c| half(c * dim)).concat());
                // The slope of the logarithm to the next level.
                bytes.extend(half(-0.05));
            }
        }
        (size, bytes)
    });
    Texture { format: Format::Rgba16F, is_cube: true, levels: levels.collect() }
}

impl Texture {
    pub(super) fn as_json(&self) -> Value {
        let levels: Vec<Value> =
            self.levels.iter().map(|(size, bytes)| json!({ "size": size, "bytes": hex(bytes) })).collect();
        let format = match self.format {
            Format::Rgba8 => "RGBA8",
            Format::Srgb8 => "SRGB8_ALPHA8",
            Format::Rgba16F => "RGBA16F",
            Format::Rg16F => "RG16F",
        };
        json!({ "format": format, "cube": self.is_cube, "levels": levels })
    }
}

/// How a sampler wraps along u and v, and how it filters.
pub(super) fn sampler(source: &SamplerSource) -> [&'static str; 3] {
    let wrapped = |wrap: &Wrap| match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Clamp => "clamp",
        Wrap::Mirror => "mirror",
    };
    match source {
        SamplerSource::LinearClamp => ["clamp", "clamp", "linear"],
        SamplerSource::Image { wrap_u, wrap_v, filter } => {
            let filter = if *filter == Filter::Nearest { "nearest" } else { "linear" };
            [wrapped(wrap_u), wrapped(wrap_v), filter]
        }
    }
}

pub(super) fn hex(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]).map(|digit| char::from(DIGITS[usize::from(digit)])).collect()
}

pub(super) fn bytes_of_hex(text: &str) -> Vec<u8> {
    let digit = |c: u8| char::from(c).to_digit(16).unwrap_or(0) as u8;
    text.as_bytes().chunks(2).map(|pair| digit(pair[0]) << 4 | pair.get(1).map_or(0, |c| digit(*c))).collect()
}
