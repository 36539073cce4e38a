// Reading a baked environment: rotation, level of detail, cube lookup, diffuse irradiance, split-sum table.
// The Rust twin of the texture-free functions and the maker of the data is `crates/ibl`.

/// World direction to environment direction when the environment is turned counter-clockwise seen from above (+Y) by an
/// angle a: the rotation Ry(-a). `cos_sin` = (cos a, sin a), computed once on the CPU.
fn rotate_about_y(dir: vec3f, cos_sin: vec2f) -> vec3f {
    return vec3f(dot(vec2f(cos_sin.x, -cos_sin.y), dir.xz), dir.y, dot(cos_sin.yx, dir.xz));
}

/// Level that holds a perceptual roughness when level 0 is the unfiltered environment, level 1 is prefiltered for 0.1, the
/// last for 1, and each between them for the same multiple of the one before.
fn lod_geometric(perceptual_roughness: f32, levels: f32) -> f32 {
    let place = 10.0 * perceptual_roughness;
    let above = (levels - 2.0) * (log2(max(place, 1.0)) / log2(10.0));
    return min(min(place, 1.0) + above, levels - 1.0);
}

/// Level that holds a perceptual roughness when level i of n is prefiltered for i / (n - 1).
fn lod_linear(perceptual_roughness: f32, levels: f32) -> f32 {
    return perceptual_roughness * (levels - 1.0);
}

/// Level as the report reads it: lod = 5 roughness, for six levels 0..5 (fewer levels end at their last).
fn lod_report(perceptual_roughness: f32, levels: f32) -> f32 {
    return min(5.0 * perceptual_roughness, levels - 1.0);
}

/// Radiance that arrives from a direction, prefiltered as much as the level says; mixed linearly between levels.
/// `dir` need not be unit. An explicit level, so it may stand under control flow and in any stage.
fn environment_sample(cube: texture_cube<f32>, cube_sampler: sampler, dir: vec3f, lod: f32) -> vec3f {
    return textureSampleLevel(cube, cube_sampler, dir, lod).rgb;
}

/// Radiance between two levels of which the fourth channel holds how log2(red + green + blue) changes from level to level,
/// as a derivative; `t` is 0 at `near` and 1 at `far`.
/// Where a lobe meets a lamp the light goes with a power of its width, falling in the middle and rising outside, so that
/// logarithms are mixed: of the colours linearly, and of their sum by Hermite's cubic, which also follows the slopes.
/// Black is taken as 1e-7, about the least that half precision holds.
fn mix_levels(near: vec4f, far: vec4f, t: f32) -> vec3f {
    let one = vec3f(1.0);
    let n = max(near.rgb, vec3f(1e-7));
    let f = max(far.rgb, vec3f(1e-7));
    let rise = log2(dot(f, one) / dot(n, one));
    let bend = t * (1.0 - t) * mix(near.a - rise, rise - far.a, t);
    return pow(f / n, vec3f(t)) * n * exp2(bend);
}

/// Radiance that arrives from a direction, prefiltered as much as the level says, from levels with slopes: see
/// `mix_levels`. Below level 1, where the environment itself may be black, the mix is linear.
fn environment_sample_hermite(cube: texture_cube<f32>, cube_sampler: sampler, dir: vec3f, lod: f32) -> vec3f {
    let mip = floor(lod);
    let near = textureSampleLevel(cube, cube_sampler, dir, mip);
    let far = textureSampleLevel(cube, cube_sampler, dir, mip + 1.0);
    let t = lod - mip;
    return select(mix_levels(near, far, t), mix(near.rgb, far.rgb, t), lod < 1.0);
}

/// Diffuse irradiance over pi of nine spherical-harmonic coefficients (order 2).
/// Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equation 13, with the
/// basis constants and the cosine factors (1, 2/3, 1/4) folded into the coefficients:
///   E/pi = c0 + c1 y + c2 z + c3 x + c4 xy + c5 yz + c6 (3z^2 - 1) + c7 xz + c8 (x^2 - y^2)
/// `dir` is unit. The floor at 0 removes the negative lobe that order 2 leaves opposite a small bright lamp.
fn irradiance_sh2(coefficients: array<vec4f, 9>, dir: vec3f) -> vec3f {
    let c = coefficients;
    let linear = c[1].xyz * dir.y + c[2].xyz * dir.z + c[3].xyz * dir.x;
    let mixed = c[4].xyz * (dir.x * dir.y) + c[5].xyz * (dir.y * dir.z) + c[7].xyz * (dir.x * dir.z);
    let squares = c[6].xyz * (3.0 * dir.z * dir.z - 1.0) + c[8].xyz * (dir.x * dir.x - dir.y * dir.y);
    return max(c[0].xyz + linear + mixed + squares, vec3f(0.0));
}

// Texels on a side of the split-sum table.
const DFG_SIZE: f32 = 45.0;

/// Split-sum scale and bias (a, b) from a table of DFG_SIZE x DFG_SIZE texels: specular albedo = f0 a + f90 b.
/// Karis 2013, "Real Shading in Unreal Engine 4", the environment BRDF. Texel centre i of n holds the value at i / (n - 1),
/// along x for the fourth root of n_dot_v, from 0 up, and along y for the square root of the perceptual roughness: both ends of each
/// range are texels, and smooth surfaces at grazing angles, whose albedo changes within n_dot_v of about alpha, have most.
fn dfg_from_table(table: texture_2d<f32>, table_sampler: sampler, n_dot_v: f32, perceptual_roughness: f32) -> vec2f {
    let place = sqrt(vec2f(sqrt(n_dot_v), saturate(perceptual_roughness)));
    let uv = place * vec2f((DFG_SIZE - 1.0) / DFG_SIZE) + vec2f(0.5 / DFG_SIZE);
    return textureSampleLevel(table, table_sampler, uv, 0.0).rg;
}
