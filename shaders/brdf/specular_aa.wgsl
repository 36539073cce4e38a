// Specular anti-aliasing: a normal that turns within a pixel spreads a highlight as roughness does, so the turn is put into the roughness.

/// Most that is added to alpha^2: where neighbouring normals have nothing to do with each other the differences say nothing.
/// Tokuyoshi and Kaplanyan 2019, Improved Geometric Specular Antialiasing.
const NORMAL_VARIANCE_CEILING: f32 = 0.18;

/// The roughness of a lobe whose alpha^2 is larger by this much, held at NORMAL_VARIANCE_CEILING and at roughness 1:
/// slopes of two independent rough surfaces add up with their variances. Negative counts as 0.
fn perceptual_roughness_widened(perceptual_roughness: f32, alpha2: f32) -> f32 {
    let alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    return sqrt(sqrt(min(alpha * alpha + clamp(alpha2, 0.0, NORMAL_VARIANCE_CEILING), 1.0)));
}

/// Variance over the pixel's square: a normal that changes evenly by d over a pixel has a variance of |d|^2 / 12, here over two
/// directions of its slopes, and alpha^2 is twice the variance of each: (|dn/dx|^2 + |dn/dy|^2) / 12.
fn perceptual_roughness_filtered_box(perceptual_roughness: f32, normal_ddx: vec3f, normal_ddy: vec3f) -> f32 {
    let change = dot(normal_ddx, normal_ddx) + dot(normal_ddy, normal_ddy);
    return perceptual_roughness_widened(perceptual_roughness, change * 0.08333333333333333);
}

/// Variance under a Gaussian pixel filter: alpha^2 grows by 2 sigma^2 (|dn/dx|^2 + |dn/dy|^2) with sigma^2 = 1 / (2 pi).
/// Tokuyoshi and Kaplanyan 2019, Improved Geometric Specular Antialiasing.
fn perceptual_roughness_filtered_tokuyoshi(perceptual_roughness: f32, normal_ddx: vec3f, normal_ddy: vec3f) -> f32 {
    let change = dot(normal_ddx, normal_ddx) + dot(normal_ddy, normal_ddy);
    return perceptual_roughness_widened(perceptual_roughness, change * 0.3183098861837907);
}
