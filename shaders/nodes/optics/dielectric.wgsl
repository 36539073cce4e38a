/// Reflectance from Index
///
/// What a dielectric of an index of refraction reflects at normal incidence in air: ((ior - 1) / (ior + 1))^2. 0.04 for 1.5. An index that is
/// 0 or none counts as infinite: 1.
/// @node optics/f0_from_ior   @also fresnel, specular, ior
/// - ior: index of refraction [1.5; 1..3]
/// - return: reflectance, 0 to 1
fn node_optics_f0_from_ior(ior: f32) -> f32 {
    return f0_from_ior(ior);
}

/// Index from Reflectance
///
/// The index of refraction of the dielectric that reflects f0 at normal incidence in air: (1 + sqrt(f0)) / (1 - sqrt(f0)). f0 is held in
/// 0..0.999999.
/// @node optics/ior_from_f0   @also fresnel, specular, ior
/// - f0: reflectance [0.04; 0..0.2]
/// - return: index of refraction
fn node_optics_ior_from_f0(f0: f32) -> f32 {
    return ior_from_f0(min(f0, 0.999999));
}

/// The outputs of the node optics/dielectrics: indices of refraction.
struct DielectricsOutputs {
    /// ice at -7 C; Warren and Brandt 2008
    ice: f32,
    /// water at 20 C; Daimon and Masumura 2007
    water: f32,
    /// skin and organic matter, a usual value
    skin: f32,
    /// fused silica, quartz glass; Malitson 1965
    fused_silica: f32,
    /// acrylic glass (PMMA); Sultanova, Kasarova and Nikolov 2009
    acrylic: f32,
    /// crown glass N-BK7; Schott
    crown_glass: f32,
    /// polycarbonate; Sultanova, Kasarova and Nikolov 2009
    polycarbonate: f32,
    /// dense flint glass N-SF11: crystal ware; Schott
    flint_glass: f32,
    /// sapphire and ruby, the ordinary ray; Malitson and Dodge 1972
    sapphire: f32,
    /// cubic zirconia; Wood and Nassau 1982
    zirconia: f32,
    /// diamond; Peter 1923
    diamond: f32,
}

/// Dielectrics
///
/// Indices of refraction of usual substances at 589 nm in air, for the surface's or the coat's index.
/// @node optics/dielectrics   @also ior, glass, water, plastic, gem, preset, refraction
fn node_optics_dielectrics() -> DielectricsOutputs {
    return DielectricsOutputs(1.309, 1.333, 1.4, 1.458, 1.491, 1.517, 1.585, 1.785, 1.768, 2.158, 2.417);
}

/// Absorption
///
/// What passes through a tinted substance: the colour that is left at one distance, at another distance. Beer 1852, Lambert 1760:
///   color^(thickness / at_distance)
/// A negative channel counts as 0; a distance below 1e-6 as 1e-6.
/// @node optics/absorption   @also beer lambert, attenuation, depth, tinted glass, transmittance
/// - color: what passes through at_distance [0.8,0.9,0.95; 0..1; color]
/// - at_distance: thickness for which the colour is given [1; 0..10; m]
/// - thickness: way through the substance; below 0 counts as 0 [1; 0..10; m]
/// - return: the transmittance
fn node_optics_absorption(color: vec3f, at_distance: f32, thickness: f32) -> vec3f {
    return power_of_color(min(color, vec3f(1.0)), max(thickness, 0.0) / max(at_distance, 1e-6));
}

/// The outputs of the node optics/from_specular_gloss.
struct FromSpecularGlossOutputs {
    /// albedo, or a metal's reflectance
    base_color: vec3f,
    /// 0 dielectric, 1 metal
    metallic: f32,
    /// 1 less the glossiness
    perceptual_roughness: f32,
}

/// From Specular and Gloss
///
/// The older way to describe a surface, by diffuse colour, specular colour and glossiness, as base colour, metallic and roughness. The
/// metallic m is where a dielectric of f0 = 0.04 mixed with a metal has both brightnesses; Khronos 2017, "KHR_materials_pbrSpecularGlossiness":
///   0.04 m^2 + (d (1 - s_max) / 0.96 + s - 0.08) m + 0.04 - s = 0
/// with d and s the perceived brightnesses sqrt(0.299 R^2 + 0.587 G^2 + 0.114 B^2). Colours are held in 0..1.
/// @node optics/from_specular_gloss   @also spec gloss, convert, khr, legacy
/// - diffuse: diffuse colour [0.5,0.5,0.5; 0..1; color]
/// - specular: specular colour [0.04,0.04,0.04; 0..1; color]
/// - glossiness: 0 dull, 1 mirror [0.5; 0..1]
fn node_optics_from_specular_gloss(diffuse: vec3f, specular: vec3f, glossiness: f32) -> FromSpecularGlossOutputs {
    let d = clamp(diffuse, vec3f(0.0), vec3f(1.0));
    let s = clamp(specular, vec3f(0.0), vec3f(1.0));
    let perceived = vec3f(0.299, 0.587, 0.114);
    let bright_d = sqrt(dot(d * d, perceived));
    let bright_s = sqrt(dot(s * s, perceived));
    let rest = 1.0 - max(s.r, max(s.g, s.b));
    let b = bright_d * rest / 0.96 + bright_s - 0.08;
    let c = 0.04 - bright_s;
    let root = clamp((sqrt(max(b * b - 0.16 * c, 0.0)) - b) / 0.08, 0.0, 1.0);
    let m = select(root, 0.0, bright_s < 0.04);
    let as_dielectric = d * rest / (0.96 * max(1.0 - m, 1e-6));
    let as_metal = (s - 0.04 * (1.0 - m)) / max(m, 1e-6);
    let base = clamp(mix(as_dielectric, as_metal, m * m), vec3f(0.0), vec3f(1.0));
    return FromSpecularGlossOutputs(base, m, 1.0 - clamp(glossiness, 0.0, 1.0));
}
