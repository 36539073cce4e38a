//! What a shader wants bound and fed: plain data for renderers and for the JSON beside an exported file.
//!
//! The bytes and the WGSL struct of a uniform block come from one list of members; its layout and packing stand in
//! `layout`.

use halfvector_graph::document::{AlphaMode, SocketRef};
use halfvector_graph::value::{Filter, ImageRef, Type, Wrap};

/// Everything outside of itself that a shader reads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reflection {
    /// Vertex attributes in order of location.
    pub vertex_inputs: Vec<VertexInput>,
    /// Bindings in order of group and number.
    pub bindings: Vec<Binding>,
    /// Parameters offered to the material's user, in the document's order.
    pub parameters: Vec<ShaderParameter>,
    /// What the opacity that the fragment stage returns does; `Opaque` where it is always 1.
    pub alpha_mode: AlphaMode,
    /// Whether back faces are to be drawn.
    pub double_sided: bool,
}

/// A vertex attribute.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexInput {
    /// `position`, `normal`, `tangent`, `uv0`, `uv1` or `color`.
    pub name: String,
    /// `@location`.
    pub location: u32,
    /// Its type; all are floats.
    pub ty: Type,
}

/// A resource.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// `@group`: 0 view, lights and environment; 1 material; 2 object.
    pub group: u32,
    /// `@binding`.
    pub binding: u32,
    /// Name of the variable.
    pub name: String,
    /// Read in the vertex stage.
    pub vertex: bool,
    /// Read in the fragment stage.
    pub fragment: bool,
    /// What it is and where it comes from.
    pub resource: Resource,
}

/// What a binding holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Resource {
    /// `var<uniform>`.
    Uniform(UniformBlock),
    /// A sampled float texture.
    Texture(TextureSource),
    /// A filtering sampler.
    Sampler(SamplerSource),
}

/// Where a texture comes from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum TextureSource {
    /// A picture of the document, 2D with mip levels.
    Image(ImageRef),
    /// The environment's prefiltered radiance, cube with one level per roughness.
    PrefilteredRadiance,
    /// The environment's irradiance over pi, cube.
    IrradianceOverPi,
    /// The table of (scale, bias) over (n.v, perceptual roughness), 2D.
    Dfg,
}

/// Which sampler.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum SamplerSource {
    /// For pictures of the document.
    Image {
        /// Outside of [0, 1] in u.
        wrap_u: Wrap,
        /// Outside of [0, 1] in v.
        wrap_v: Wrap,
        /// Between texels.
        filter: Filter,
    },
    /// Trilinear and clamped: cubes and the DFG table.
    LinearClamp,
}

/// A uniform struct.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformBlock {
    /// Name of the WGSL struct.
    pub struct_name: String,
    /// Its members in order, with offsets by WGSL's uniform rules.
    pub members: Vec<UniformMember>,
    /// Size in bytes, a multiple of 16.
    pub size: u32,
}

/// A member of a uniform struct.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformMember {
    /// Its name in the struct.
    pub name: String,
    /// Its WGSL type.
    pub ty: UniformType,
    /// Bytes from the start of the struct.
    pub offset: u32,
    /// What fills it.
    pub source: UniformSource,
}

/// Types in uniform structs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UniformType {
    /// A scalar or vector; bools are stored as i32.
    Value(Type),
    /// `mat4x4f`, column-major.
    Mat4,
    /// `mat3x3f`, column-major, columns padded to 16 bytes.
    Mat3,
    /// A light of a kind, or an array of so many (stride: [`LightKind::stride`]).
    Lights(LightKind, u32),
    /// `array<vec4f, 9>`: irradiance over pi as SH, the fourth component unused.
    Sh9,
}

/// Kinds of punctual lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightKind {
    /// `DirectionalLight` of the shader library.
    Directional,
    /// `PointLight`.
    Point,
    /// `SpotLight`.
    Spot,
}

/// What fills a uniform member.
#[derive(Clone, Debug, PartialEq)]
pub enum UniformSource {
    /// View and projection.
    ClipFromWorld,
    /// The camera's position in world space.
    CameraPosition,
    /// Seconds.
    Time,
    /// Factor from radiance to display units, before the tone map.
    Exposure,
    /// (cos, sin) of the environment's rotation about +Y.
    EnvironmentRotation,
    /// Number of levels of the prefiltered radiance, as a float.
    EnvironmentLevels,
    /// The environment's irradiance over pi as nine SH coefficients.
    IrradianceSh,
    /// Lights of a kind.
    Lights(LightKind),
    /// An input of a node; the value is the document's.
    Input(SocketRef),
    /// View from world: the viewer at the origin, +x right, +y up, looking along -z.
    ViewFromWorld,
    /// World from object.
    WorldFromObject,
    /// Object from world; zero where the object is scaled flat.
    ObjectFromWorld,
    /// The upper 3x3's cofactor matrix times the sign of its determinant, that is |det| (M^-1)^T: takes normals to
    /// world space, outward ones to outward ones. Where the determinant is negative the renderer also swaps which
    /// winding is the front.
    NormalFromObject,
}

/// A parameter of the material.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderParameter {
    /// Name of the member in the `Parameters` struct.
    pub name: String,
    /// For people.
    pub label: String,
    /// Its type.
    pub ty: Type,
    /// The document's value, exact.
    pub default: Vec<f64>,
    /// Soft range of each component.
    pub range: Option<[f32; 2]>,
}
