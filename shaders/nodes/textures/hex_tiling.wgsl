/// The outputs of the node textures/hex_tiling.
struct HexTilingOutputs {
    /// red, green and blue; linear
    color: vec3f,
    /// coverage; 1 for an image without it
    alpha: f32,
}

/// The three hexagons that a point is blended from, and its barycentric coordinates among them.
struct HexTiles {
    first: vec2i,
    second: vec2i,
    third: vec2i,
    weights: vec3f,
}

// A lattice of triangles whose corners are the hexagons' centres: 2 sqrt(3) corners per repeat along an edge.
const HEX_SPREAD: f32 = 3.4641016;

/// The hexagons around a point of the repeated picture.
fn hex_tiles(q: vec2f) -> HexTiles {
    let skewed = HEX_SPREAD * vec2f(q.x - 0.57735027 * q.y, 1.1547005 * q.y);
    let corner = floor(skewed);
    let f = skewed - corner;
    let is_upper = f.x + f.y > 1.0;
    return HexTiles(
        vec2i(corner) + select(vec2i(0, 0), vec2i(1, 1), is_upper),
        vec2i(corner) + vec2i(0, 1),
        vec2i(corner) + vec2i(1, 0),
        select(vec3f(1.0 - f.x - f.y, f.y, f.x), vec3f(f.x + f.y - 1.0, 1.0 - f.x, 1.0 - f.y), is_upper));
}

/// The centre of a hexagon in coordinates of the picture.
fn hex_center(cell: vec2i) -> vec2f {
    let p = vec2f(cell) / HEX_SPREAD;
    return vec2f(p.x + 0.5 * p.y, 0.8660254 * p.y);
}

/// Weights raised to a power and brought to the sum 1. The greatest is at least 1/3, and (0.4 / 3)^64 would end at 0: the power is of weights over
/// the greatest.
fn hex_sharpened(weights: vec3f, sharpness: f32) -> vec3f {
    let greatest = max(weights.x, max(weights.y, weights.z));
    let sharp = pow(max(weights / greatest, vec3f(1e-6)), vec3f(clamp(sharpness, 1.0, 64.0)));
    return sharp / (sharp.x + sharp.y + sharp.z);
}

/// How a hexagon moves and turns the picture.
struct HexTurn {
    rotation: mat2x2f,
    shift: vec2f,
}

/// The random turn of a hexagon about its centre, and its random shift.
fn hex_turn(cell: vec2i, turn: f32, seed: i32) -> HexTurn {
    let random = unit_floats(lattice_hash(vec3i(cell, 0), seed));
    let angle = (random.z - 0.5) * 2.0 * PI * turn;
    let c = cos(angle);
    let s = sin(angle);
    return HexTurn(mat2x2f(c, s, -s, c), random.xy);
}

/// A picture read for one hexagon: moved and turned about the hexagon's centre, with derivatives turned likewise.
fn hex_tile_sample(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, uv_ddx: vec2f, uv_ddy: vec2f, cell: vec2i, turned: HexTurn) -> vec4f {
    let center = hex_center(cell);
    let at = turned.rotation * (uv - center) + center + turned.shift;
    return textureSampleGrad(image, image_sampler, at, turned.rotation * uv_ddx, turned.rotation * uv_ddy);
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
    let tiles = hex_tiles(q);
    let a = hex_tile_sample(image, image_sampler, q, ddx, ddy, tiles.first, hex_turn(tiles.first, turn, seed));
    let b = hex_tile_sample(image, image_sampler, q, ddx, ddy, tiles.second, hex_turn(tiles.second, turn, seed));
    let c = hex_tile_sample(image, image_sampler, q, ddx, ddy, tiles.third, hex_turn(tiles.third, turn, seed));
    let bright = 0.4 + 0.6 * clamp(vec3f(luminance(a.rgb), luminance(b.rgb), luminance(c.rgb)), vec3f(0.0), vec3f(1.0));
    let w = hex_sharpened(bright * tiles.weights, sharpness);
    let texel = a * w.x + b * w.y + c * w.z;
    return HexTilingOutputs(texel.rgb, texel.a);
}

/// Hex Tiling of Normals
///
/// Hex Tiling for a normal map: each piece's slopes are turned back with the piece before they are blended, so that light falls on all of them from one side.
/// With the count, turn and seed of the colour's Hex Tiling the pieces are the same; the sharpness weighs by place alone. Mikkelsen 2022, "Practical
/// Real-Time Hex-Tiling". Three reads.
/// @node textures/hex_tiling_normal   @also tiled, break repetition, stochastic, normal map, bombing
/// - image: the normal map [image linear]
/// - uv: where to read; (0,0) is the top left [context uv0]
/// - count: repeats of the picture per unit [4; 1..64]
/// - turn: how far pieces may be turned, 1 half a turn either way [1; 0..1]
/// - sharpness: how quickly one piece takes over; held in 1..64 [7; 1..16]
/// - flip_y: whether the map is -Y (DirectX) [false]
/// - seed: another one, other pieces [0; 0..100]
/// - return: a +Y normal map's colour, for Normal Map
fn node_textures_hex_tiling_normal(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f, count: f32, turn: f32, sharpness: f32, flip_y: bool, seed: i32) -> vec3f {
    let q = uv * count;
    let ddx = dpdx(q);
    let ddy = dpdy(q);
    let tiles = hex_tiles(q);
    let first = hex_turn(tiles.first, turn, seed);
    let second = hex_turn(tiles.second, turn, seed);
    let third = hex_turn(tiles.third, turn, seed);
    let a = hex_tile_slopes(hex_tile_sample(image, image_sampler, q, ddx, ddy, tiles.first, first).rgb, first, flip_y);
    let b = hex_tile_slopes(hex_tile_sample(image, image_sampler, q, ddx, ddy, tiles.second, second).rgb, second, flip_y);
    let c = hex_tile_slopes(hex_tile_sample(image, image_sampler, q, ddx, ddy, tiles.third, third).rgb, third, flip_y);
    let w = hex_sharpened(tiles.weights, sharpness);
    return texel_from_normal(normalize(vec3f(a * w.x + b * w.y + c * w.z, 1.0)));
}

/// x/z and y/z of a turned piece's normal in the frame of the whole: the map's x and y run along u and against v.
fn hex_tile_slopes(color: vec3f, turned: HexTurn, flip_y: bool) -> vec2f {
    let n = normal_from_texel(color, 1.0, flip_y);
    // 1e-3: steeper than 89.9 degrees counts as that.
    let along_uv = transpose(turned.rotation) * (vec2f(n.x, -n.y) / max(n.z, 1e-3));
    return vec2f(along_uv.x, -along_uv.y);
}
