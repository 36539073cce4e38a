// Two normal maps as one, and a normal map made stronger or weaker. Normals are unit, in tangent space, +Z up; results
// are unit and finite for every input. Barre-Brisebois and Hill 2012, "Blending in Detail", has the history of all forms.

/// The normal with its slopes times `strength`: 0 is flat, 1 leaves it, -1 turns bumps into dents. Of a height field this
/// is the normal of `strength` times the height. A normal with z = 0 stays where it is.
fn normal_with_strength(n_tangent: vec3f, strength: f32) -> vec3f {
    return normalize_or(vec3f(n_tangent.xy * strength, n_tangent.z), vec3f(0.0, 0.0, 1.0));
}

/// The colour that a normal has in a +Y map: 0.5 n + 0.5. The inverse of `normal_from_texel` with strength 1.
fn texel_from_normal(n_tangent: vec3f) -> vec3f {
    return 0.5 * n_tangent + 0.5;
}

/// Linear: normalize(base + detail). Flattens both: a flat detail halves the base's tilt. Opposed normals give the base.
fn blend_linear(base: vec3f, detail: vec3f) -> vec3f {
    return blended(base + detail, base);
}

/// Partial derivatives: the slopes of the two height fields are added, as those of their sum are.
///   n = normalize(b.xy d.z + d.xy b.z, b.z d.z)
/// Exact for added heights. Where both are upright walls (z = 0) there is no sum: the base.
fn blend_partial_derivatives(base: vec3f, detail: vec3f) -> vec3f {
    return blended(vec3f(base.xy * detail.z + detail.xy * base.z, base.z * detail.z), base);
}

/// Whiteout, from AMD's demo of that name (2007): normalize(b.xy + d.xy, b.z d.z).
fn blend_whiteout(base: vec3f, detail: vec3f) -> vec3f {
    return blended(vec3f(base.xy + detail.xy, base.z * detail.z), base);
}

/// UDN, from the Unreal Developer Network: normalize(b.xy + d.xy, b.z). The cheapest; weakens detail on slopes.
fn blend_udn(base: vec3f, detail: vec3f) -> vec3f {
    return blended(vec3f(base.xy + detail.xy, base.z), base);
}

/// Reoriented: the detail turned by the shortest rotation that takes +Z to the base. Barre-Brisebois and Hill 2012.
///   t = b + (0, 0, 1),   u = d (-1, -1, 1),   n = normalize(t (t . u) - u t.z)
/// A base of -Z has no shortest rotation: the base.
fn blend_rnm(base: vec3f, detail: vec3f) -> vec3f {
    let t = vec3f(base.xy, base.z + 1.0);
    let u = vec3f(-detail.xy, detail.z);
    return blended(t * dot(t, u) - u * t.z, base);
}

// The blend as a unit vector; the base, or +Z, where there is none.
fn blended(sum: vec3f, base: vec3f) -> vec3f {
    return normalize_or(sum, normalize_or(base, vec3f(0.0, 0.0, 1.0)));
}
