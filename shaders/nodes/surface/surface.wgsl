/// What light meets: a layered surface at one point, as the lobes and the frame around them read it.
struct Surface {
    /// linear Rec. 709: albedo of a dielectric, reflectance of a metal at normal incidence
    base_color: vec3f,
    /// 0 dielectric, 1 metal
    metallic: f32,
    /// the artist's roughness; alpha is its square
    perceptual_roughness: f32,
    /// index of refraction of the dielectric
    ior: f32,
    /// weight of the dielectric specular: scales f0 and f90
    specular: f32,
    /// unit shading normal in world space
    normal: vec3f,
    /// part of the environment's light that arrives
    occlusion: f32,
    /// radiance that the surface sends out itself, linear Rec. 709
    emission: vec3f,
    /// coverage
    opacity: f32,
    /// displacement along the mesh's normal [m]
    height: f32,
}

/// Surface
///
/// The material itself: each wired graph ends here. Metallic and roughness as in glTF 2.0 (Khronos 2017): the base colour is
/// the albedo of a dielectric and the f0 of a metal; a dielectric's f0 is ((ior - 1) / (ior + 1))^2 times the specular weight.
/// @node surface/surface   @also material, output, principled, pbr, metallic roughness
/// - base_color: albedo, or a metal's reflectance, linear Rec. 709 [0.8,0.8,0.8; 0..1; color]
/// - metallic: 0 dielectric, 1 metal [0; 0..1]
/// - perceptual_roughness: 0 mirror, 1 dull; alpha is its square [0.5; 0..1]
/// - ior: index of refraction of the dielectric [1.5; 1..3]
/// - specular: weight of the dielectric specular; 0 leaves a purely diffuse surface [1; 0..1]
/// - normal: unit shading normal in world space [context world_normal]
/// - occlusion: part of the environment's light that arrives [1; 0..1]
/// - emission: radiance of its own, linear Rec. 709 [0,0,0; 0..10; color]
/// - opacity: coverage; what it does is the document's alpha mode [1; 0..1]
/// - height: displacement along the mesh's normal [0; -1..1; m]
fn node_surface_surface(
    base_color: vec3f,
    metallic: f32,
    perceptual_roughness: f32,
    ior: f32,
    specular: f32,
    normal: vec3f,
    occlusion: f32,
    emission: vec3f,
    opacity: f32,
    height: f32,
) -> Surface {
    return Surface(base_color, metallic, perceptual_roughness, ior, specular, normal, occlusion, emission, opacity, height);
}
