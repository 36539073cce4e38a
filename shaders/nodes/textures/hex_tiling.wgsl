/// The outputs of the node textures/hex_tiling.
struct HexTilingOutputs {
    /// red, green and blue; linear
    color: vec3f,
    /// coverage; 1 for an image without it
    alpha: f32,
}

/// A picture read for one hexagon: moved and turned at random about the hexagon's centre, with derivatives turned likewise.
fn hex_tile_sample(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, uv_ddx: vec2f, uv_ddy: vec2f, cell: vec2i, center: vec2f, turn: f32, seed: i32) -> vec4f {
    let random = unit_floats(lattice_hash(vec3i(cell, 0), seed));
    let angle = (random.z - 0.5) * 2.0 * PI * turn;
    let c = cos(angle);
    let s = sin(angle);
    let rotation = mat2x2f(c, s, -s, c);
    return textureSampleGrad(image, image_sampler, rotation * (uv - center) + center + random.xy, rotation * uv_ddx, rotation * uv_ddy);
}

/// Hex Tiling
///
/// Covers a surface with a repeating picture without its repeats showing: each hexagon of a grid reads another, turned piece of it, and
/// three of them are blended at each point, by weights raised to a power and by how bright each piece is. For stone, earth, grass, plaster;
/// not for patterns with an order of their own. Mikkelsen 2022, "Practical Real-Time Hex-Tiling", after Heitz and Neyret 2018. Three reads.
/// @node textures/hex_tiling   @also tiled, break repetition, stochastic, random, bombing
/// - image: the picture [image srgb]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// - count: repeats of the picture per unit [4; 1..64]
/// - turn: how far pieces may be turned, 1 half a turn either way [1; 0..1]
/// - sharpness: how quickly one piece takes over; held in 1..64 [7; 1..16]
/// - seed: another one, other pieces [0; 0..100]
fn node_textures_hex_tiling(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, count: f32, turn: f32, sharpness: f32, seed: i32) -> HexTilingOutputs {
    let q = uv * count;
    let ddx = dpdx(q);
    let ddy = dpdy(q);
    // A lattice of triangles whose corners are the hexagons' centres: 2 sqrt(3) corners per repeat along an edge.
    let spread = 3.4641016;
    let skewed = spread * vec2f(q.x - 0.57735027 * q.y, 1.1547005 * q.y);
    let corner = floor(skewed);
    let f = skewed - corner;
    let is_upper = f.x + f.y > 1.0;
    let first = vec2i(corner) + select(vec2i(0, 0), vec2i(1, 1), is_upper);
    let second = vec2i(corner) + vec2i(0, 1);
    let third = vec2i(corner) + vec2i(1, 0);
    // Barycentric coordinates of the triangle.
    let weights = select(vec3f(1.0 - f.x - f.y, f.y, f.x), vec3f(f.x + f.y - 1.0, 1.0 - f.x, 1.0 - f.y), is_upper);
    let a = hex_tile_sample(image, image_sampler, q, ddx, ddy, first, hex_center(first, spread), turn, seed);
    let b = hex_tile_sample(image, image_sampler, q, ddx, ddy, second, hex_center(second, spread), turn, seed);
    let c = hex_tile_sample(image, image_sampler, q, ddx, ddy, third, hex_center(third, spread), turn, seed);
    let bright = 0.4 + 0.6 * clamp(vec3f(luminance(a.rgb), luminance(b.rgb), luminance(c.rgb)), vec3f(0.0), vec3f(1.0));
    // The greatest weight is at least 1/3, and (0.4 / 3)^64 would end at 0: the power is of weights over the greatest.
    let w = bright * weights;
    let greatest = max(w.x, max(w.y, w.z));
    let sharp = pow(max(w / greatest, vec3f(1e-6)), vec3f(clamp(sharpness, 1.0, 64.0)));
    let texel = (a * sharp.x + b * sharp.y + c * sharp.z) / (sharp.x + sharp.y + sharp.z);
    return HexTilingOutputs(texel.rgb, texel.a);
}

/// The centre of a hexagon in coordinates of the picture.
fn hex_center(cell: vec2i, spread: f32) -> vec2f {
    let p = vec2f(cell) / spread;
    return vec2f(p.x + 0.5 * p.y, 0.8660254 * p.y);
}
