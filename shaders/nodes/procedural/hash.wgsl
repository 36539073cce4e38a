// Random numbers from whole numbers, with integer arithmetic only: every device and the CPU give the same bits.

/// Three random words of three words. Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg3d:
/// a linear congruential step by word, then two rounds in which each word adds the product of the others.
fn pcg3d(v: vec3u) -> vec3u {
    var h = v * 1664525u + 1013904223u;
    h.x += h.y * h.z;
    h.y += h.z * h.x;
    h.z += h.x * h.y;
    h ^= h >> vec3u(16u);
    h.x += h.y * h.z;
    h.y += h.z * h.x;
    h.z += h.x * h.y;
    return h;
}

/// Three random words for a cell of a lattice. The seed moves the lattice along z by a multiple of 2^32 over the golden
/// ratio, far from the cells that a picture shows.
fn lattice_hash(cell: vec3i, seed: i32) -> vec3u {
    return pcg3d(bitcast<vec3u>(cell) + vec3u(0u, 0u, bitcast<u32>(seed) * 0x9e3779b9u));
}

/// The upper 24 bits of each word as a number in 0..1, 1 excluded: each of them is exact in f32.
fn unit_floats(h: vec3u) -> vec3f {
    return vec3f(h >> vec3u(8u)) * (1.0 / 16777216.0);
}

/// The quintic fade of Perlin 2002, "Improving Noise": t^3 (t (6 t - 15) + 10), level to the second derivative at 0 and 1.
fn fade(t: vec3f) -> vec3f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
