// A thin film on the base: what takes the place of the specular lobe's Fresnel term. OpenPBR 1.1 (Academy Software
// Foundation 2024), section 3.6; Khronos 2022, KHR_materials_iridescence. The base is taken as a dielectric of the index
// that f0 / f90 implies.

/// Parameters of the film.
struct ThinFilm {
    /// Presence of the film in [0, 1].
    weight: f32,
    /// Thickness [nm].
    thickness: f32,
    /// Index of refraction.
    ior: f32,
}

/// What the film adds to the reflectance at the cosine l.h of a base of reflectances f0 and f90, in [-1, 1]:
/// weight (f90 F_film - F(f0, f90)). For the light of a whole lobe it is added to both f0 and f90.
fn thin_film_shift(f0: vec3f, f90: vec3f, p: ThinFilm, l_dot_h: f32) -> vec3f {
    // ior_from_f0 of each channel.
    let s2 = clamp(f0 / max(f90, vec3f(F90_FLOOR)), vec3f(0.0), vec3f(F0_CEILING));
    let s = 1.0 + sqrt(s2);
    let film = f90 * f_thin_film_dielectric(p.ior, p.thickness, s * s / (1.0 - s2), l_dot_h);
    return saturate(p.weight) * (film - f_schlick(f0, f90, l_dot_h));
}

/// Reflectance at the cosine l.h, `p.weight` of the base under the film: F(f0, f90) + thin_film_shift. It takes the place of
/// F in a lobe lit from one direction.
fn thin_film_fresnel(f0: vec3f, f90: vec3f, p: ThinFilm, l_dot_h: f32) -> vec3f {
    return f_schlick(f0, f90, l_dot_h) + thin_film_shift(f0, f90, p, l_dot_h);
}

/// What a film does to the light of a whole lobe, and to that of one direction.
struct ThinFilmLit {
    /// thin_film_shift at the lobe's cosine.
    shift: vec3f,
    /// thin_film_fresnel at the direction's.
    fresnel: vec3f,
}

/// Both of a ThinFilmLit by one loop: a film is long, and its code stands in the shader once.
fn thin_film_lit(f0: vec3f, f90: vec3f, p: ThinFilm, lobe_cosine: f32, l_dot_h: f32) -> ThinFilmLit {
    let cosines = vec2f(lobe_cosine, l_dot_h);
    // The lobe's comes first and is handed on when the direction's comes.
    var of_lobe = vec3f(0.0);
    var shift = vec3f(0.0);
    var bare = vec3f(0.0);
    for (var i = 0u; i < 2u; i++) {
        of_lobe = shift;
        shift = thin_film_shift(f0, f90, p, cosines[i]);
        bare = f_schlick(f0, f90, cosines[i]);
    }
    return ThinFilmLit(of_lobe, bare + shift);
}

/// The cosine l.h at which Schlick's F is the lobe's mean, from the split-sum pair: b / (a + b) is the mean of
/// (1 - l.h)^5. An environment meets the film at it; on a smooth surface it is n.v.
fn thin_film_cosine(dfg: vec2f) -> f32 {
    let mean = clamp(dfg.y / max(dfg.x + dfg.y, 1e-6), 1e-30, 1.0);
    return 1.0 - pow(mean, 0.2);
}

/// What a film that adds `shift` to the reflectance changes of the light that passes the base: (1 - F - shift) / (1 - F), all
/// at one cosine. Held in [0, 4].
fn thin_film_through(shift: vec3f, f0: vec3f, f90: vec3f, l_dot_h: f32) -> vec3f {
    let bare = f_schlick(f0, f90, l_dot_h);
    return clamp(1.0 - shift / max(1.0 - bare, vec3f(1e-3)), vec3f(0.0), vec3f(4.0));
}
