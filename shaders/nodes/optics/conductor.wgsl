/// Conductor
///
/// Colour and edge tint of a metal by its optical constants: Fresnel's reflectance of the index eta + i k at normal incidence, and at
/// 82 degrees (cosine 1/7) over Schlick's curve there. Constants belong to red, green and blue, for example to 650, 550 and 450 nm.
/// Kutz, Hasan and Edmondson 2021, "Novel Aspects of the Adobe Standard Material". Negative constants count as 0.
/// @node optics/conductor   @also metal, complex ior, eta, extinction, fresnel
/// - eta: index of refraction by channel [0.2,0.92,1.1; 0..5]
/// - k: extinction by channel [3.91,2.45,2.14; 0..10]
fn node_optics_conductor(eta: vec3f, k: vec3f) -> MetalOutputs {
    let f0 = vec3f(f_conductor(eta.r, k.r, 1.0), f_conductor(eta.g, k.g, 1.0), f_conductor(eta.b, k.b, 1.0));
    let c = 1.0 / 7.0;
    let f82 = vec3f(f_conductor(eta.r, k.r, c), f_conductor(eta.g, k.g, c), f_conductor(eta.b, k.b, c));
    // Never 0: Schlick's curve is at least 0.46 there.
    let schlick = f0 + (1.0 - f0) * F82_SCHLICK_WEIGHT;
    return MetalOutputs(f0, clamp(f82 / schlick, vec3f(0.0), vec3f(1.0)));
}

/// The outputs of the node optics/artistic_ior.
struct ArtisticIorOutputs {
    /// index of refraction by channel
    eta: vec3f,
    /// extinction by channel
    k: vec3f,
}

/// Artistic Index
///
/// Optical constants of a metal from two colours: the reflectance at normal incidence and a tint of the edge, which stands for how low the
/// index is. Gulbrandsen 2014, "Artist Friendly Metallic Fresnel". With r and g in 0..0.99 and 0..1:
///   eta = g (1 - r) / (1 + r) + (1 - g) (1 + sqrt(r)) / (1 - sqrt(r))
///   k = sqrt((r (eta + 1)^2 - (eta - 1)^2) / (1 - r))
/// @node optics/artistic_ior   @also metal, complex ior, reflectivity, edge color
/// - reflectivity: colour at normal incidence [0.95,0.65,0.55; 0..1; color]
/// - edge_color: 1 the lowest index, 0 none but the real index [0.9,0.8,0.7; 0..1; color]
fn node_optics_artistic_ior(reflectivity: vec3f, edge_color: vec3f) -> ArtisticIorOutputs {
    let r = clamp(reflectivity, vec3f(0.0), vec3f(0.99));
    let g = clamp(edge_color, vec3f(0.0), vec3f(1.0));
    let root = sqrt(r);
    let eta = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + root) / (1.0 - root);
    let above = eta + 1.0;
    let below = eta - 1.0;
    return ArtisticIorOutputs(eta, sqrt(max((r * above * above - below * below) / (1.0 - r), vec3f(0.0))));
}
