// Prefiltering of an environment on a GPU, without noise: a tree over the map's texels, walked once for each texel of the
// result. Near the lobe's middle the walk reads texels, far from it whole parts of the map at their centre of light, with
// the second term of Taylor's series for their spread (Barnes and Hut 1986, "A hierarchical O(N log N) force-calculation
// algorithm", with the moments of Greengard and Rokhlin 1987 to second order). The host makes the tables of rows and
// columns, whose sines must be better than those of some GPUs, and dispatches in slices. What `crates/ibl` computes
// exactly this computes to 0.35 % rms for perceptual roughness from 0.2.

struct Bake {
    /// Columns and rows of the map.
    columns: u32,
    rows: u32,
    /// Levels of the tree above its leaves: a tree has 2^depth leaves on a side.
    depth: u32,
    /// Trees, side by side along the rows.
    trees: u32,
    /// Texels along an edge of the cube that is made.
    face_size: u32,
    /// The first node or texel of this dispatch.
    first: u32,
    /// Level of the tree that is made; 0 for its leaves.
    level: u32,
    /// Square of the perceptual roughness; 1 is the cosine lobe.
    alpha: f32,
    /// 1 over the weight's integral over the hemisphere [1/sr].
    scale: f32,
}

/// A row of the map: sine and cosine of the polar angle of its texels' centroids, their solid angle [sr], half of what
/// their spread is along each direction, squared, and the longer side [rad].
struct Row {
    sin_theta: f32,
    cos_theta: f32,
    solid_angle: f32,
    variance: f32,
    extent: f32,
}

/// A part of the map: a texel, or four parts together.
struct Node {
    /// Radiance times solid angle.
    energy: vec3f,
    /// No two points of it are much farther apart than this [rad].
    extent: f32,
    /// Unit direction of its centre of light.
    centre: vec3f,
    /// Mean square distance of its light from there.
    variance: f32,
}

@group(0) @binding(0) var<uniform> bake: Bake;
@group(0) @binding(1) var<storage, read> pixels: array<f32>;
@group(0) @binding(2) var<storage, read> rows: array<Row>;
/// Cosine and sine of the azimuth of each column's middle.
@group(0) @binding(3) var<storage, read> columns: array<vec2f>;
@group(0) @binding(4) var<storage, read_write> nodes: array<Node>;
@group(0) @binding(5) var<storage, read_write> texels: array<vec4f>;

/// A node is opened when its extent is more than this part of the distance over which the lobe changes.
const OPENING = 0.2;
/// That distance is held below this [rad]: far away the lobe still falls to 0 at the horizon.
const LONGEST_CHANGE = 1.0;
/// The part for nodes across the horizon, where the lobe has an edge.
const HORIZON_OPENING = 0.1;
/// The lobe's change with a is taken between a times this and a divided by it.
const WIDER = 1.02;
/// Keeps 0 / 0 of a black environment 0.
const MIN_LIGHT = 1e-30;
const LUMINANCE = vec3f(0.2126, 0.7152, 0.0722);

/// Where the nodes of a level begin: the levels below it have 4^depth, 4^(depth - 1), ... nodes in each tree.
fn first_of_level(level: u32) -> u32 {
    let whole = 2u * (bake.depth + 1u);
    return bake.trees * (((1u << whole) - (1u << (whole - 2u * level))) / 3u);
}

/// The even bits of a number, moved together: one coordinate of a place on a Z-order curve.
fn even_bits(number: u32) -> u32 {
    var x = number & 0x55555555u;
    x = (x | (x >> 1u)) & 0x33333333u;
    x = (x | (x >> 2u)) & 0x0f0f0f0fu;
    x = (x | (x >> 4u)) & 0x00ff00ffu;
    return (x | (x >> 8u)) & 0x0000ffffu;
}

fn leaf(index: u32) -> Node {
    let side = 1u << bake.depth;
    let place = index & (side * side - 1u);
    let column = (index >> (2u * bake.depth)) * side + even_bits(place);
    let row = even_bits(place >> 1u);
    if column >= bake.columns || row >= bake.rows {
        return Node(vec3f(0.0), 0.0, vec3f(0.0, 1.0, 0.0), 0.0);
    }
    let r = rows[row];
    let azimuth = columns[column];
    let pixel = 3u * (row * bake.columns + column);
    let radiance = vec3f(pixels[pixel], pixels[pixel + 1u], pixels[pixel + 2u]);
    let centre = vec3f(r.sin_theta * azimuth.x, r.cos_theta, r.sin_theta * azimuth.y);
    return Node(radiance * r.solid_angle, r.extent, centre, r.variance);
}

/// Four nodes as one.
fn joined(first: u32) -> Node {
    var energy = vec3f(0.0);
    var extent = 0.0;
    var light = 0.0;
    var centre = vec3f(0.0);
    for (var i = 0u; i < 4u; i += 1u) {
        let child = nodes[first + i];
        let luminance = dot(child.energy, LUMINANCE);
        energy += child.energy;
        extent = max(extent, child.extent);
        light += luminance;
        centre += luminance * child.centre;
    }
    // A node without light is never read; one whose light is all around has no centre and is always opened.
    let arm = length(centre);
    centre = select(nodes[first].centre, centre / arm, arm > 0.0);
    var spread = 0.0;
    for (var i = 0u; i < 4u; i += 1u) {
        let child = nodes[first + i];
        let away = child.centre - centre;
        spread += dot(child.energy, LUMINANCE) * (child.variance + dot(away, away));
    }
    return Node(energy, 2.0 * extent, centre, select(0.0, spread / light, light > 0.0));
}

/// Makes one level of the tree; the levels below it are there.
@compute @workgroup_size(64)
fn bake_level(@builtin(global_invocation_id) id: vec3u) {
    let index = bake.first + id.x;
    if index >= (bake.trees << (2u * (bake.depth - bake.level))) {
        return;
    }
    if bake.level == 0u {
        nodes[index] = leaf(index);
    } else {
        nodes[first_of_level(bake.level) + index] = joined(first_of_level(bake.level - 1u) + 4u * index);
    }
}

/// The direction, not unit, through the middle of a texel: the GPU's own rules for faces +X -X +Y -Y +Z -Z.
fn face_direction(face: u32, s: f32, t: f32) -> vec3f {
    switch face {
        case 0u: { return vec3f(1.0, -t, -s); }
        case 1u: { return vec3f(-1.0, -t, s); }
        case 2u: { return vec3f(s, 1.0, t); }
        case 3u: { return vec3f(s, -1.0, -t); }
        case 4u: { return vec3f(s, -t, 1.0); }
        default: { return vec3f(-s, -t, -1.0); }
    }
}

/// The prefilter lobe (Karis 2013, n = v = r) at the cosine x = 1 - s > 0, times alpha^4, with the mean of its neighbourhood:
///   w = x q^2,  q = a / (a + b s),  a = alpha^2,  b = (1 - a) / 2
/// and w + variance / 4 (Laplacian of w on the sphere), where the Laplacian is s (2 - s) w'' - 2 x w'.
fn lobe(a: f32, s: f32, variance: f32) -> f32 {
    let b = 0.5 * (1.0 - a);
    let x = 1.0 - s;
    let d = a + b * s;
    let q = a / d;
    let first = q * q * (1.0 + 2.0 * b * x / d);
    let second = q * q * b / d * (4.0 + 6.0 * b * x / d);
    return max(x * q * q + 0.25 * variance * (s * (2.0 - s) * second - 2.0 * x * first), 0.0);
}

/// Filters the map for one texel of the cube, and says how the logarithm of the weighted sum of light, red, green and blue
/// together, changes with the logarithm of a. The walk needs no stack: nodes stand in Z-order, so the next node of a level
/// has the next number, and after the fourth of a family comes the one after its parent.
@compute @workgroup_size(64)
fn bake_texel(@builtin(global_invocation_id) id: vec3u) {
    let face_texels = bake.face_size * bake.face_size;
    let index = bake.first + id.x;
    if index >= 6u * face_texels {
        return;
    }
    let column = index % bake.face_size;
    let row = (index / bake.face_size) % bake.face_size;
    let st = (2.0 * vec2f(f32(column), f32(row)) + 1.0) / f32(bake.face_size) - 1.0;
    let normal = normalize(face_direction(index / face_texels, st.x, st.y));
    let a = bake.alpha * bake.alpha;

    var sum = vec3f(0.0);
    var change = 0.0;
    var level = bake.depth;
    var number = 0u;
    while level < bake.depth || number < bake.trees {
        let node = nodes[first_of_level(level) + number];
        let away = node.centre - normal;
        // 1 - n.l without cancellation.
        let s = 0.5 * dot(away, away);
        let seen = any(node.energy > vec3f(0.0)) && 1.0 - s > -node.extent;
        let near = min(2.0 * sqrt(0.5 * s + a), LONGEST_CHANGE);
        let crosses = abs(1.0 - s) < node.extent && node.extent > HORIZON_OPENING;
        if seen && level > 0u && (crosses || node.extent > OPENING * near) {
            level -= 1u;
            number *= 4u;
            continue;
        }
        if seen && s < 1.0 {
            let wider = lobe(a * WIDER, s, node.variance);
            let narrower = lobe(a / WIDER, s, node.variance);
            sum += node.energy * lobe(a, s, node.variance);
            change += dot(node.energy, vec3f(1.0)) * (wider - narrower);
        }
        number += 1u;
        while level < bake.depth && (number & 3u) == 0u {
            number /= 4u;
            level += 1u;
        }
    }
    // Light divides by light: the weight's scale does not count.
    let slope = change / max(2.0 * log(WIDER) * dot(sum, vec3f(1.0)), MIN_LIGHT);
    texels[index] = vec4f(sum * bake.scale, slope);
}
