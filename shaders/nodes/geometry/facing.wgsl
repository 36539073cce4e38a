/// Facing
///
/// The cosine between normal and view, n . v held in 0..1: 1 where the surface faces the viewer, 0 at its rim.
/// @node geometry/facing   @also n dot v, rim, cosine
/// - normal: unit normal [context world_normal]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - return: 0 to 1
fn node_geometry_facing(normal: vec3f, view_dir: vec3f) -> f32 {
    return clamp(dot(normal, view_dir), 0.0, 1.0);
}

/// Rim
///
/// A weight that is 0 where the surface faces the viewer and 1 at its rim: (1 - n . v)^exponent; 5 is Schlick's (1994)
/// Fresnel weight. The exponent is held in 0.1..20.
/// @node geometry/rim   @also fresnel weight, edge, layer weight, velvet
/// - normal: unit normal [context world_normal]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - exponent: how narrow the rim is [5; 0.1..20]
/// - return: 0 to 1
fn node_geometry_rim(normal: vec3f, view_dir: vec3f, exponent: f32) -> f32 {
    let away = 1.0 - clamp(dot(normal, view_dir), 0.0, 1.0);
    // 1e-6^20 ends at 0 without the logarithm of 0.
    return pow(max(away, 1e-6), clamp(exponent, 0.1, 20.0));
}

/// Fresnel
///
/// Part of the light that a smooth dielectric surface throws back: Fresnel's equations, without polarisation. For mixing
/// colours by angle; the surface node has its own.
/// @node geometry/fresnel   @also reflectance, dielectric, angle
/// - normal: unit normal [context world_normal]
/// - view_dir: unit direction to the viewer [context view_dir]
/// - ior: index of refraction [1.5; 1..3]
/// - return: 0 to 1
fn node_geometry_fresnel(normal: vec3f, view_dir: vec3f, ior: f32) -> f32 {
    return f_dielectric(max(ior, 1.0), clamp(dot(normal, view_dir), 0.0, 1.0));
}

/// Slope
///
/// How much the surface faces a direction: the cosine held in 0..1. With +Y, snow and dust: 1 on floors, 0 on walls.
/// @node geometry/slope   @also up, snow, dust, moss
/// - normal: unit normal [context world_normal]
/// - toward: direction, of any length; 0 counts as +Y [0,1,0]
/// - return: 0 to 1
fn node_geometry_slope(normal: vec3f, toward: vec3f) -> f32 {
    return clamp(dot(normal, normalize_or(toward, vec3f(0.0, 1.0, 0.0))), 0.0, 1.0);
}
