/// The outputs of the node geometry/vertex_color.
struct VertexColorOutputs {
    /// red, green and blue; linear
    color: vec3f,
    /// the fourth number, often a mask; 1 where the mesh has three
    alpha: f32,
}

/// Vertex Colour
///
/// The colour that the mesh has at its vertices, between them in proportion: painted masks, baked occlusion, tints of a scan. glTF's
/// COLOR_0, which is linear. White and 1 where a mesh has none. Models that are opened multiply their base colour by it, as glTF says.
/// @node geometry/vertex_color   @also color attribute, geomcolor, painted, primvar, mask
/// - color: the colour and its fourth number [context vertex_color]
fn node_geometry_vertex_color(color: vec4f) -> VertexColorOutputs {
    return VertexColorOutputs(color.rgb, color.a);
}
