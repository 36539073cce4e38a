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
    /// presence of the coat
    coat_weight: f32,
    /// transmittance of the coat there and back, linear Rec. 709
    coat_color: vec3f,
    /// the coat's own roughness; alpha is its square
    coat_roughness: f32,
    /// index of refraction of the coat
    coat_ior: f32,
    /// unit normal of the coat in world space
    coat_normal: vec3f,
    /// reflectance of the sheen, linear Rec. 709
    sheen_color: vec3f,
    /// roughness of the sheen
    sheen_roughness: f32,
    /// part of the dielectric base that lets light through
    transmission_weight: f32,
    /// how far the base's highlight is stretched along the tangent
    anisotropy: f32,
    /// turn of that direction from the tangent towards the bitangent [rad]
    anisotropy_rotation: f32,
    /// presence of a thin film on the base
    thin_film_weight: f32,
    /// thickness of the film [um]
    thin_film_thickness: f32,
    /// index of refraction of the film
    thin_film_ior: f32,
}

/// Surface
///
/// The material itself: each wired graph ends here. Metallic and roughness as in glTF 2.0 (Khronos 2017): the base colour is
/// the albedo of a dielectric and the f0 of a metal; a dielectric's f0 is ((ior - 1) / (ior + 1))^2 times the specular weight. Above the base lies the coat,
/// above the coat the sheen; each takes from what lies below it, emission too, what it reflects. Coat as in OpenPBR 1.1
/// (Academy Software Foundation 2024), sheen as in KHR_materials_sheen (Khronos 2020). Transmission shows the environment
/// through the surface of a solid body: refracted once, tinted by the base colour; or, where the document's `thin_walled` says
/// so, straight through a sheet. Anisotropy is KHR_materials_anisotropy's (Khronos 2023): the highlight's width along the tangent goes from alpha
/// to 1 with the square of the strength, across it stays alpha. The thin film is OpenPBR's, between the base and the coat.
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
/// - coat_weight: presence of a clear layer over the base [0; 0..1]
/// - coat_color: what passes through the coat and back, linear Rec. 709 [1,1,1; 0..1; color]
/// - coat_roughness: 0 mirror, 1 dull; alpha is its square [0; 0..1]
/// - coat_ior: index of refraction of the coat [1.5; 1..3]
/// - coat_normal: unit normal of the coat in world space [context world_normal]
/// - sheen_color: reflectance of the fuzz of cloth, linear Rec. 709; black is none [0,0,0; 0..1; color]
/// - sheen_roughness: 0 only at the rim, 1 all over [0.3; 0..1]
/// - transmission_weight: part of the dielectric base that lets light through instead of scattering it [0; 0..1]
/// - anisotropy: how far the base's highlight is stretched along the tangent, as on brushed metal; 0 is round [0; 0..1]
/// - anisotropy_rotation: turn of that direction from the tangent towards the bitangent [0; -3.1416..3.1416; rad]
/// - thin_film_weight: presence of a thin film on the base, whose two sides' reflections interfere [0; 0..1]
/// - thin_film_thickness: thickness of the film, micrometres [0.5; 0..1; um]
/// - thin_film_ior: index of refraction of the film [1.4; 1..3]
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
    coat_weight: f32,
    coat_color: vec3f,
    coat_roughness: f32,
    coat_ior: f32,
    coat_normal: vec3f,
    sheen_color: vec3f,
    sheen_roughness: f32,
    transmission_weight: f32,
    anisotropy: f32,
    anisotropy_rotation: f32,
    thin_film_weight: f32,
    thin_film_thickness: f32,
    thin_film_ior: f32,
) -> Surface {
    return Surface(
        base_color,
        metallic,
        perceptual_roughness,
        ior,
        specular,
        normal,
        occlusion,
        emission,
        opacity,
        height,
        coat_weight,
        coat_color,
        coat_roughness,
        coat_ior,
        coat_normal,
        sheen_color,
        sheen_roughness,
        transmission_weight,
        anisotropy,
        anisotropy_rotation,
        thin_film_weight,
        thin_film_thickness,
        thin_film_ior,
    );
}
