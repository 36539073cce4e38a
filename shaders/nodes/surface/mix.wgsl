/// Mix Surfaces
///
/// A lerp of parameters: each number of the two surfaces is mixed by itself,
///   a (1 - t) + b t
/// and the two normals are mixed so and made unit again. What comes out is one surface with one set of lobes, so it costs little more than
/// one of the two. It is no blend of the light that the two reflect: half of a mirror and half of chalk is a surface of middling
/// roughness, not a sharp reflection over a dull one; where each point is all of one or all of the other, as with a mask, the two are the same.
/// Beside its weight a lobe that only one side has is mixed too: give the other side the same numbers (coat roughness, film thickness) where
/// they are to stay as they are. A lobe that both lack is left out, as on one surface alone. Opposite normals at t = 0.5 give a's.
/// @node surface/mix   @also lerp, blend materials, layer, mask, combine
/// - a: the surface at t = 0 [surface]
/// - b: the surface at t = 1 [surface]
/// - t: weight of b; held to 0..1 [0.5; 0..1]
fn node_surface_mix(a: Surface, b: Surface, t: f32) -> Surface {
    let s = saturate(t);
    return Surface(
        mix(a.base_color, b.base_color, s),
        mix(a.metallic, b.metallic, s),
        mix(a.perceptual_roughness, b.perceptual_roughness, s),
        mix(a.ior, b.ior, s),
        mix(a.specular, b.specular, s),
        surface_mix_normals(a.normal, b.normal, s),
        mix(a.occlusion, b.occlusion, s),
        mix(a.emission, b.emission, s),
        mix(a.opacity, b.opacity, s),
        mix(a.height, b.height, s),
        mix(a.coat_weight, b.coat_weight, s),
        mix(a.coat_color, b.coat_color, s),
        mix(a.coat_roughness, b.coat_roughness, s),
        mix(a.coat_ior, b.coat_ior, s),
        surface_mix_normals(a.coat_normal, b.coat_normal, s),
        mix(a.sheen_color, b.sheen_color, s),
        mix(a.sheen_roughness, b.sheen_roughness, s),
        mix(a.transmission_weight, b.transmission_weight, s),
        mix(a.anisotropy, b.anisotropy, s),
        mix(a.anisotropy_rotation, b.anisotropy_rotation, s),
        mix(a.thin_film_weight, b.thin_film_weight, s),
        mix(a.thin_film_thickness, b.thin_film_thickness, s),
        mix(a.thin_film_ior, b.thin_film_ior, s),
    );
}

/// Two unit normals mixed and made unit again; a's where the mixture has no direction.
fn surface_mix_normals(a: vec3f, b: vec3f, t: f32) -> vec3f {
    return normalize_or(mix(a, b, t), a);
}
