// From the artist's base colour and metallic to the two lobes' colours.
// Burley 2012, Physically-Based Shading at Disney; glTF 2.0, appendix B.

/// Colour of the diffuse lobe: base_color (1 - metallic).
fn diffuse_color(base_color: vec3f, metallic: f32) -> vec3f {
    return base_color * (1.0 - metallic);
}

/// Reflectance at normal incidence: dielectric_f0 (1 - metallic) + base_color metallic.
fn f0_from_metallic(base_color: vec3f, metallic: f32, dielectric_f0: f32) -> vec3f {
    return mix(vec3f(dielectric_f0), base_color, metallic);
}
