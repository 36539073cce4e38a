/// The outputs of the nodes procedural/circle, procedural/line, procedural/rounded_box and procedural/polygon.
struct OutlineOutputs {
    /// 1 inside, 0 outside
    mask: f32,
    /// distance to the outline, negative inside
    signed_distance: f32,
}

/// The part of a window inside of an outline of about `half_size` each way from the origin: its edge near by, its area far away.
fn outline_share(signed_distance: f32, softness: f32, p: vec2f, half_size: vec2f, width: f32) -> f32 {
    let extent = max(half_size, vec2f(0.0));
    let near = inside_share(signed_distance, softness, width);
    let far = line_share(p.x, extent.x, width) * line_share(p.y, extent.y, width);
    return mix(near, far, smoothstep(0.25, 0.75, width / max(min(extent.x, extent.y), 1e-6)));
}

/// Rounded Box
///
/// A box with round corners: labels, buttons, plates. The mask's edge is as wide as the pixel; a box smaller than the pixel covers its part of it.
/// @node procedural/rounded_box   @also rectangle, square, label, sdf
/// - uv: coordinates [context uv0]
/// - center: of the box [0.5,0.5; 0..1]
/// - size: width and height [0.6,0.4; 0..1]
/// - radius: of the corners; at most half of the smaller side [0.05; 0..0.5]
/// - softness: width of the edge [0; 0..0.5]
/// @vertex node_procedural_rounded_box_vertex
fn node_procedural_rounded_box(uv: vec2f, center: vec2f, size: vec2f, radius: f32, softness: f32) -> OutlineOutputs {
    let d = rounded_box_distance(held2(uv - center), size, radius);
    return OutlineOutputs(outline_share(d, softness, held2(uv - center), 0.5 * size, sqrt(squared_footprint2(uv))), d);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_rounded_box_vertex(uv: vec2f, center: vec2f, size: vec2f, radius: f32, softness: f32) -> OutlineOutputs {
    let d = rounded_box_distance(held2(uv - center), size, radius);
    return OutlineOutputs(inside_share(d, softness, 0.0), d);
}

/// Signed distance to a box with round corners about the origin.
fn rounded_box_distance(p: vec2f, size: vec2f, radius: f32) -> f32 {
    let half_size = 0.5 * max(size, vec2f(0.0));
    let r = clamp(radius, 0.0, min(half_size.x, half_size.y));
    let q = abs(p) - half_size + r;
    return length(max(q, vec2f(0.0))) + min(max(q.x, q.y), 0.0) - r;
}

/// Polygon
///
/// A regular shape of three sides or more: nuts, signs, bokeh. The mask's edge is as wide as the pixel. The distance is that to the sides,
/// drawn on beyond the corners. A shape smaller than the pixel covers its part of it.
/// @node procedural/polygon   @also triangle, pentagon, hexagon, octagon, ngon, sdf
/// - uv: coordinates [context uv0]
/// - center: of the shape [0.5,0.5; 0..1]
/// - sides: how many; held in 3..64 [6; 3..12]
/// - radius: from the centre to a side [0.3; 0..0.5]
/// - rotation: counter-clockwise on the image; at 0 a side lies at the bottom [0; -180..180; deg]
/// - softness: width of the edge [0; 0..0.5]
/// @vertex node_procedural_polygon_vertex
fn node_procedural_polygon(uv: vec2f, center: vec2f, sides: i32, radius: f32, rotation: f32, softness: f32) -> OutlineOutputs {
    let d = polygon_distance(held2(uv - center), sides, rotation) - radius;
    // Half the side of the square of the same area.
    let n = f32(clamp(sides, 3, 64));
    let half_side = vec2f(0.5 * radius * sqrt(n * tan(PI / n)));
    return OutlineOutputs(outline_share(d, softness, held2(uv - center), half_side, sqrt(squared_footprint2(uv))), d);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_polygon_vertex(uv: vec2f, center: vec2f, sides: i32, radius: f32, rotation: f32, softness: f32) -> OutlineOutputs {
    let d = polygon_distance(held2(uv - center), sides, rotation) - radius;
    return OutlineOutputs(inside_share(d, softness, 0.0), d);
}

/// How far a point lies from the middle towards the side that it is nearest to.
fn polygon_distance(p: vec2f, sides: i32, rotation: f32) -> f32 {
    let sector = 2.0 * PI / f32(clamp(sides, 3, 64));
    let in_center = max(abs(p.x), abs(p.y)) <= DIVISOR_FLOOR;
    // Angles from straight down, which is +v; the sides' middles lie at whole sectors.
    let angle = select(atan2(p.x, select(p.y, 1.0, in_center)), 0.0, in_center) - radians(rotation);
    return length(p) * cos(angle - sector * floor(angle / sector + 0.5));
}

/// Circle
///
/// A disc, or with `width` a ring: spots, washers, targets. The mask's edge is as wide as the pixel; a disc smaller than the pixel covers its
/// part of it.
/// @node procedural/circle   @also disc, disk, ring, spot, dot, sdf
/// - uv: coordinates [context uv0]
/// - center: of the circle [0.5,0.5; 0..1]
/// - radius: to the outer edge [0.3; 0..0.5]
/// - width: of the ring; the radius or more is a disc [0.5; 0..0.5]
/// - softness: width of the edge [0; 0..0.5]
/// @vertex node_procedural_circle_vertex
fn node_procedural_circle(uv: vec2f, center: vec2f, radius: f32, width: f32, softness: f32) -> OutlineOutputs {
    let d = circle_distance(held2(uv - center), radius, width);
    let window = sqrt(squared_footprint2(uv));
    // Half the sides of the squares of the same areas.
    let outer = vec2f(0.88622693 * max(radius, 0.0));
    let inner = vec2f(0.88622693 * max(radius - max(width, 0.0), 0.0));
    let whole = outline_share(length(held2(uv - center)) - radius, softness, held2(uv - center), outer, window);
    let hole = outline_share(length(held2(uv - center)) - radius + max(width, 0.0), softness, held2(uv - center), inner, window);
    return OutlineOutputs(max(whole - select(0.0, hole, inner.x > 0.0), 0.0), d);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_circle_vertex(uv: vec2f, center: vec2f, radius: f32, width: f32, softness: f32) -> OutlineOutputs {
    let d = circle_distance(held2(uv - center), radius, width);
    return OutlineOutputs(inside_share(d, softness, 0.0), d);
}

/// Signed distance to a ring about the origin: of a disc where it is as wide as the radius.
fn circle_distance(p: vec2f, radius: f32, width: f32) -> f32 {
    let outside = length(p) - radius;
    return select(outside, max(outside, -outside - max(width, 0.0)), width < radius);
}

/// Line
///
/// A straight line between two points with round ends: scratches, strokes, hands of a clock. The mask's edge is as wide as the pixel; a line
/// thinner than the pixel covers its part of it.
/// @node procedural/line   @also segment, stroke, capsule, sdf
/// - uv: coordinates [context uv0]
/// - a: one end [0.2,0.8; 0..1]
/// - b: the other end [0.8,0.2; 0..1]
/// - width: of the line; below 0 counts as 0 [0.05; 0..0.5]
/// - softness: width of the edge [0; 0..0.5]
/// @vertex node_procedural_line_vertex
fn node_procedural_line(uv: vec2f, a: vec2f, b: vec2f, width: f32, softness: f32) -> OutlineOutputs {
    let d = line_distance(uv, a, b, width);
    let half_width = 0.5 * max(width, 0.0);
    let along = normalize_or(vec3f(held2(b - a), 0.0), vec3f(1.0, 0.0, 0.0)).xy;
    let from_middle = held2(uv - 0.5 * (a + b));
    let p = vec2f(dot(from_middle, along), along.x * from_middle.y - along.y * from_middle.x);
    // Half the sides of the box of the same area: the round ends are as a box's of pi/4 their length.
    let extent = vec2f(0.5 * length(held2(b - a)) + 0.78539816 * half_width, half_width);
    return OutlineOutputs(outline_share(d, softness, p, extent, sqrt(squared_footprint2(uv))), d);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_line_vertex(uv: vec2f, a: vec2f, b: vec2f, width: f32, softness: f32) -> OutlineOutputs {
    let d = line_distance(uv, a, b, width);
    return OutlineOutputs(inside_share(d, softness, 0.0), d);
}

/// Signed distance to a line with round ends.
fn line_distance(p: vec2f, a: vec2f, b: vec2f, width: f32) -> f32 {
    let way = held2(b - a);
    let from_start = held2(p - a);
    let along = clamp(dot(from_start, way) / max(dot(way, way), DIVISOR_FLOOR), 0.0, 1.0);
    return distance(from_start, along * way) - 0.5 * max(width, 0.0);
}

/// Cloverleaf
///
/// Four circles around a middle that all touch it: ornaments, clover, quatrefoils. The mask's edge is as wide as the pixel; a leaf smaller than the pixel
/// covers its part of it. Inside the distance is that to the nearest circle.
/// @node procedural/cloverleaf   @also quatrefoil, clover, ornament, four circles, sdf
/// - uv: coordinates [context uv0]
/// - center: of the leaf [0.5,0.5; 0..1]
/// - radius: from the middle to the tips [0.3; 0..0.5]
/// - softness: width of the edge [0; 0..0.5]
/// @vertex node_procedural_cloverleaf_vertex
fn node_procedural_cloverleaf(uv: vec2f, center: vec2f, radius: f32, softness: f32) -> OutlineOutputs {
    let d = cloverleaf_distance(held2(uv - center), radius);
    // Half the side of the square of the same area: circles of half the radius, less what they share, cover (pi/2 + 1) radius^2.
    let half_side = vec2f(0.8017 * radius);
    return OutlineOutputs(outline_share(d, softness, held2(uv - center), half_side, sqrt(squared_footprint2(uv))), d);
}

/// The vertex stage has no pixels: the pattern at the point.
fn node_procedural_cloverleaf_vertex(uv: vec2f, center: vec2f, radius: f32, softness: f32) -> OutlineOutputs {
    let d = cloverleaf_distance(held2(uv - center), radius);
    return OutlineOutputs(inside_share(d, softness, 0.0), d);
}

/// Signed distance to the four circles about the origin: by symmetry to the one on the nearer axis.
fn cloverleaf_distance(p: vec2f, radius: f32) -> f32 {
    let q = abs(p);
    let r = 0.5 * clamp(radius, 0.0, PATTERN_END);
    return length(vec2f(max(q.x, q.y) - r, min(q.x, q.y))) - r;
}
