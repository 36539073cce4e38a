// Two normal maps as one. Colours of normal maps go in and come out, so that the nodes stand before the normal map node.
// A -Y map's detail wants its green turned over before.

/// Blend Normals
///
/// The slopes of two normal maps added ("partial derivatives"): exactly the normal map of the sum of their heights.
/// Barre-Brisebois and Hill 2012, "Blending in Detail".
/// @node textures/normal_blend   @also normal map, detail, combine, add heights
/// - base: a colour of the normal map below [0.5,0.5,1]
/// - detail: a colour of the normal map above [0.5,0.5,1]
/// - strength: factor of the detail's slopes [1; 0..2]
/// - return: the colour of the normal map of both
fn node_textures_normal_blend(base: vec3f, detail: vec3f, strength: f32) -> vec3f {
    let n = blend_partial_derivatives(normal_from_texel(base, 1.0, false), normal_from_texel(detail, strength, false));
    return texel_from_normal(n);
}

/// Blend Normals Reoriented
///
/// A detail normal map laid over a base: the detail is turned with the base's normal, so that it is as strong on slopes
/// as it is on flats. Barre-Brisebois and Hill 2012, "Blending in Detail" (reoriented normal mapping).
/// @node textures/normal_blend_rnm   @also normal map, detail, combine, rnm, reoriented, overlay
/// - base: a colour of the normal map below [0.5,0.5,1]
/// - detail: a colour of the normal map above [0.5,0.5,1]
/// - strength: factor of the detail's slopes [1; 0..2]
/// - return: the colour of the normal map of both
fn node_textures_normal_blend_rnm(base: vec3f, detail: vec3f, strength: f32) -> vec3f {
    let n = blend_rnm(normal_from_texel(base, 1.0, false), normal_from_texel(detail, strength, false));
    return texel_from_normal(n);
}

/// Blend Normals Whiteout
///
/// normalize(b.xy + d.xy, b.z d.z): near the sum of height fields, kinder to steep ones. Barre-Brisebois and Hill 2012,
/// "Blending in Detail".
/// @node textures/normal_blend_whiteout   @also normal map, detail, combine
/// - base: a colour of the normal map below [0.5,0.5,1]
/// - detail: a colour of the normal map above [0.5,0.5,1]
/// - strength: factor of the detail's slopes [1; 0..2]
/// - return: the colour of the normal map of both
fn node_textures_normal_blend_whiteout(base: vec3f, detail: vec3f, strength: f32) -> vec3f {
    let n = blend_whiteout(normal_from_texel(base, 1.0, false), normal_from_texel(detail, strength, false));
    return texel_from_normal(n);
}

/// Blend Normals UDN
///
/// normalize(b.xy + d.xy, b.z): the cheapest; the detail weakens where the base is steep. Barre-Brisebois and Hill 2012,
/// "Blending in Detail".
/// @node textures/normal_blend_udn   @also normal map, detail, combine, unreal
/// - base: a colour of the normal map below [0.5,0.5,1]
/// - detail: a colour of the normal map above [0.5,0.5,1]
/// - strength: factor of the detail's slopes [1; 0..2]
/// - return: the colour of the normal map of both
fn node_textures_normal_blend_udn(base: vec3f, detail: vec3f, strength: f32) -> vec3f {
    let n = blend_udn(normal_from_texel(base, 1.0, false), normal_from_texel(detail, strength, false));
    return texel_from_normal(n);
}

/// Blend Normals Linear
///
/// normalize(b + d): flattens both maps. To see what other tools do; the other blends are better. Barre-Brisebois and Hill
/// 2012, "Blending in Detail".
/// @node textures/normal_blend_linear   @also normal map, detail, combine, average
/// - base: a colour of the normal map below [0.5,0.5,1]
/// - detail: a colour of the normal map above [0.5,0.5,1]
/// - strength: factor of the detail's slopes [1; 0..2]
/// - return: the colour of the normal map of both
fn node_textures_normal_blend_linear(base: vec3f, detail: vec3f, strength: f32) -> vec3f {
    let n = blend_linear(normal_from_texel(base, 1.0, false), normal_from_texel(detail, strength, false));
    return texel_from_normal(n);
}
