// Directions in two numbers of -1..1, for normals and tangents in two 16- or 8-bit halves of a word.
// Rounding to bits is the caller's: `pack2x16snorm`, `pack2x16float`.

/// The octahedron |x| + |y| + |z| = 1, its lower half folded out over the corners of the square. Meyer, Suessmuth, Sussner,
/// Stamminger, Greiner 2010, "On Floating-Point Normal Vectors".
///   p = n.xy / (|n.x| + |n.y| + |n.z|),   below z = 0: (1 - |p.yx|) sign(p)
/// The length of `n` does not matter; a vector without a direction is coded as +Z, (0, 0).
fn octahedral_from_direction(n: vec3f) -> vec2f {
    let unit = normalize_or(n, vec3f(0.0, 0.0, 1.0));
    let p = unit.xy / (abs(unit.x) + abs(unit.y) + abs(unit.z));
    return select(p, octahedral_folded(p), unit.z < 0.0);
}

/// The unit direction that two numbers stand for: the inverse of `octahedral_from_direction`, finite for every input.
/// Stored in 16 bits a number it is within 0.0037 degrees, in 8 bits within 0.95.
fn direction_from_octahedral(p: vec2f) -> vec3f {
    let z = 1.0 - abs(p.x) - abs(p.y);
    return normalize_or(vec3f(select(p, octahedral_folded(p), z < 0.0), z), vec3f(0.0, 0.0, 1.0));
}

// The point mirrored at the edge |x| + |y| = 1 of its quadrant.
fn octahedral_folded(p: vec2f) -> vec2f {
    let size = 1.0 - abs(p.yx);
    return select(size, -size, p < vec2f(0.0));
}
