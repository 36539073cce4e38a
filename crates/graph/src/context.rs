//! What a shader can know of the point that it shades: the one list of contexts. A context that no live node names
//! becomes no varying, uniform or attribute.

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
