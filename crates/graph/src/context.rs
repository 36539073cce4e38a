//! What a shader can know of the point that it shades: the one list of contexts. A context that no live node names
//! becomes no varying, uniform or attribute. And the transforms between spaces, of which the same holds.

use crate::value::Type;

/// Something known of the shaded point.
#[derive(Debug, PartialEq, Eq)]
pub struct Context {
    /// Name in doc comments and shaders.
    pub name: &'static str,
    /// Its type.
    pub ty: Type,
    /// Whether the vertex stage has it; the fragment stage has all.
    pub vertex: bool,
    /// Meaning, space and unit.
    pub help: &'static str,
}

/// All contexts.
pub const CONTEXTS: &[Context] = &[
    Context {
        name: "uv0",
        ty: Type::Vec2,
        vertex: true,
        help: "first texture coordinates; (0,0) is the top left of an image",
    },
    Context { name: "uv1", ty: Type::Vec2, vertex: true, help: "second texture coordinates" },
    Context {
        name: "vertex_color",
        ty: Type::Vec4,
        vertex: true,
        help: "colour of the mesh's vertices between them, linear, and alpha; 1 where a mesh has none",
    },
    Context {
        name: "world_position",
        ty: Type::Vec3,
        vertex: true,
        help: "the point in world space [m]; before displacement in the vertex stage",
    },
    Context {
        name: "object_position",
        ty: Type::Vec3,
        vertex: true,
        help: "the point in object space [m], before displacement",
    },
    Context {
        name: "world_normal",
        ty: Type::Vec3,
        vertex: true,
        help: "unit shading normal of the mesh in world space",
    },
    Context {
        name: "world_tangent",
        ty: Type::Vec4,
        vertex: true,
        help: "tangent of the mesh in world space; w is the handedness of the bitangent",
    },
    Context {
        name: "view_dir",
        ty: Type::Vec3,
        vertex: true,
        help: "unit direction from the point to the viewer in world space",
    },
    Context { name: "time", ty: Type::F32, vertex: true, help: "time [s]" },
];

/// The context with this name.
pub fn context(name: &str) -> Option<&'static Context> {
    CONTEXTS.iter().find(|c| c.name == name)
}

/// A transform between spaces. A function of the library takes it as an argument of this name, of the type `mat4x4f`; it is
/// no socket, for no wire carries a matrix.
#[derive(Debug, PartialEq, Eq)]
pub struct Frame {
    /// Name in shaders.
    pub name: &'static str,
    /// What it does.
    pub help: &'static str,
}

/// All frames. Both stages have them; one that no live node takes is no uniform.
pub const FRAMES: &[Frame] = &[
    Frame { name: "world_from_object", help: "from object space, where the mesh was modelled, to world space" },
    Frame { name: "object_from_world", help: "back from there; zero where the object is scaled flat" },
    Frame {
        name: "view_from_world",
        help: "to view space: the viewer at the origin, +x right, +y up, looking along -z; a turn and a move",
    },
];

/// The frame with this name.
pub fn frame(name: &str) -> Option<&'static Frame> {
    FRAMES.iter().find(|f| f.name == name)
}
