// Simplex noise: gradient noise on a lattice of triangles or tetrahedra, which has fewer corners than squares and cubes
// and no preferred axis. Perlin 2001, "Noise hardware"; explained by Gustavson 2005, "Simplex noise demystified".

// The greatest sums over all points and choices of directions are 0.0099960 (plane) and 0.0130072 (space), found by search:
// these bring them to 1.
const SIMPLEX_SCALE2: f32 = 100.0;
const SIMPLEX_SCALE3: f32 = 76.8;

/// Simplex Noise 2D
///
/// Smooth bumps of one size on a lattice of triangles. Each corner at distance r adds (1/2 - r^2)^4 times how far the point
/// lies along the corner's direction. Perlin 2001, "Noise hardware"; Gustavson 2005, "Simplex noise demystified".
/// Fades to 0 where bumps are smaller than pixels.
/// @node procedural/simplex_noise_2d   @also perlin, clouds, bumps
/// - uv: coordinates [context uv0]
/// - scale: lattice points per unit [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_simplex_noise_2d_vertex
fn node_procedural_simplex_noise_2d(uv: vec2f, scale: f32, seed: i32) -> f32 {
    return node_procedural_simplex_noise_2d_vertex(uv, scale, seed) * left_of_noise(2.83, squared_footprint2(held2(uv * scale)));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_simplex_noise_2d_vertex(uv: vec2f, scale: f32, seed: i32) -> f32 {
    let p = held2(uv * scale);
    // Skewing by (sqrt(3) - 1) / 2 makes squares of the pairs of triangles; (3 - sqrt(3)) / 6 undoes it.
    let corner = floor(p + (p.x + p.y) * 0.36602540);
    let d0 = p - corner + (corner.x + corner.y) * 0.21132487;
    let middle = select(vec2f(0.0, 1.0), vec2f(1.0, 0.0), d0.x > d0.y);
    let d1 = d0 - middle + 0.21132487;
    let d2 = d0 - 1.0 + 2.0 * 0.21132487;

    let r = max(0.5 - vec3f(dot(d0, d0), dot(d1, d1), dot(d2, d2)), vec3f(0.0));
    let cell = vec2i(corner);
    let along = vec3f(
        lattice_gradient2(cell, seed, d0),
        lattice_gradient2(cell + vec2i(middle), seed, d1),
        lattice_gradient2(cell + vec2i(1), seed, d2),
    );
    return SIMPLEX_SCALE2 * dot(r * r * r * r, along);
}

/// Simplex Noise 3D
///
/// Smooth bumps of one size on a lattice of tetrahedra. Each corner at distance r adds (1/2 - r^2)^4 times how far the
/// point lies along the corner's direction. Perlin 2001, "Noise hardware"; Gustavson 2005, "Simplex noise demystified".
/// Fades to 0 where bumps are smaller than pixels.
/// @node procedural/simplex_noise_3d   @also perlin, clouds, bumps
/// - position: the point [context object_position]
/// - scale: lattice points per metre [8; 0..64]
/// - seed: another one, another pattern [0; 0..100]
/// - return: -1 to 1, mean 0
/// @vertex node_procedural_simplex_noise_3d_vertex
fn node_procedural_simplex_noise_3d(position: vec3f, scale: f32, seed: i32) -> f32 {
    return node_procedural_simplex_noise_3d_vertex(position, scale, seed) * left_of_noise(2.83, squared_footprint(held3(position * scale)));
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_simplex_noise_3d_vertex(position: vec3f, scale: f32, seed: i32) -> f32 {
    let p = held3(position * scale);
    let corner = floor(p + (p.x + p.y + p.z) / 3.0);
    let d0 = p - corner + (corner.x + corner.y + corner.z) / 6.0;
    // The tetrahedron is the order of the components: step along the greatest first, then along the next.
    let not_less = step(d0.yzx, d0);
    let less = 1.0 - not_less;
    let first = min(not_less, less.zxy);
    let second = max(not_less, less.zxy);
    let d1 = d0 - first + 1.0 / 6.0;
    let d2 = d0 - second + 2.0 / 6.0;
    let d3 = d0 - 1.0 + 3.0 / 6.0;

    let r = max(0.5 - vec4f(dot(d0, d0), dot(d1, d1), dot(d2, d2), dot(d3, d3)), vec4f(0.0));
    let cell = vec3i(corner);
    let along = vec4f(
        lattice_gradient3(cell, seed, d0),
        lattice_gradient3(cell + vec3i(first), seed, d1),
        lattice_gradient3(cell + vec3i(second), seed, d2),
        lattice_gradient3(cell + vec3i(1), seed, d3),
    );
    return SIMPLEX_SCALE3 * dot(r * r * r * r, along);
}
