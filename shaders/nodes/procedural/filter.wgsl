// What keeps patterns from aliasing: each is averaged over the pixel, which is a window on the pattern. Periodic patterns of hard
// borders and of sines are averaged exactly (for windows along the axes); noise fades to its mean as the window comes to the size of its
// bumps. A window of 0 is the pattern itself: in the vertex stage, and where a renderer takes many samples instead.

// A window narrower than this part of a period counts as none: differences of integrals have no digits left there.
const WINDOW_FLOOR: f32 = 1e-3;

// A pattern is held beyond this many periods: from 2^23 on an f32 has no fraction left, and what is near the end of f32 would come to
// infinity, of which there is no fraction.
const PATTERN_END: f32 = 1e9;

/// A point of a pattern along a line.
fn held1(x: f32) -> f32 {
    return clamp(x, -PATTERN_END, PATTERN_END);
}

/// A point of a pattern in the plane.
fn held2(p: vec2f) -> vec2f {
    return clamp(p, vec2f(-PATTERN_END), vec2f(PATTERN_END));
}

/// A point of a pattern in space.
fn held3(p: vec3f) -> vec3f {
    return clamp(p, vec3f(-PATTERN_END), vec3f(PATTERN_END));
}

/// A point of a pattern in space and time.
fn held4(p: vec4f) -> vec4f {
    return clamp(p, vec4f(-PATTERN_END), vec4f(PATTERN_END));
}

/// The square of a pixel's width on a pattern: the mean squared length of its two sides there, the same for turned pixels.
/// Limited to 1e6, where every pattern is its mean.
fn squared_footprint(p: vec3f) -> f32 {
    let x = dpdx(p);
    let y = dpdy(p);
    return min(0.5 * (dot(x, x) + dot(y, y)), 1e6);
}

/// The same in the plane.
fn squared_footprint2(p: vec2f) -> f32 {
    let x = dpdx(p);
    let y = dpdy(p);
    return min(0.5 * (dot(x, x) + dot(y, y)), 1e6);
}

/// The part of what varies by 1 over unit cells that is left when it is averaged over a window: exp(-k w^2) fits gradient noise of bell-shaped
/// spectrum; `halvings` is k / ln 2.
fn left_of_noise(halvings: f32, squared_width: f32) -> f32 {
    return exp2(-halvings * squared_width);
}

/// The part of unit cells of random values that is left when they are averaged over a window.
fn left_of_cells(squared_width: f32) -> f32 {
    return 1.0 / (1.0 + 0.8 * squared_width);
}

/// The part of a window of a period's length or more that shows the pattern's mean: 0 up to half a period, 1 from one and a half on.
fn share_of_mean(squared_width: f32) -> f32 {
    return smoothstep(0.5, 1.5, sqrt(squared_width));
}

/// The mean of a pulse wave over a window around x: 1 in the first `duty` of each unit, 0 in the rest.
fn pulse_wave(x: f32, width: f32, duty: f32) -> f32 {
    let part = clamp(duty, 0.0, 1.0);
    let w = max(width, WINDOW_FLOOR);
    let start = fract(x - 0.5 * w);
    let end = start + w;
    let within = (part * floor(end) + min(fract(end), part) - min(start, part)) / w;
    return select(within, select(0.0, 1.0, fract(x) < part), width < WINDOW_FLOOR);
}

/// The mean of a saw wave over a window around x: 0 to 1 over each unit.
fn saw_wave(x: f32, width: f32) -> f32 {
    let w = max(width, WINDOW_FLOOR);
    let start = fract(x - 0.5 * w);
    let end = start + w;
    let rest = fract(end);
    let within = 0.5 * (floor(end) + rest * rest - start * start) / w;
    return select(within, fract(x), width < WINDOW_FLOOR);
}

/// The integral of a triangle wave from 0: the wave is 0 at whole numbers, 1 between them.
fn triangle_integral(x: f32) -> f32 {
    let f = fract(x);
    return 0.5 * floor(x) + select(2.0 * f - f * f - 0.5, f * f, f < 0.5);
}

/// The mean of a triangle wave over a window around x: 0 at whole numbers, 1 between them.
fn triangle_wave(x: f32, width: f32) -> f32 {
    let w = max(width, WINDOW_FLOOR);
    let start = fract(x - 0.5 * w);
    let within = (triangle_integral(start + w) - triangle_integral(start)) / w;
    return select(within, 1.0 - abs(2.0 * fract(x) - 1.0), width < WINDOW_FLOOR);
}

/// The mean of sin(2 pi x) over a window around x: times sin(pi w) / (pi w).
fn sine_wave(x: f32, width: f32) -> f32 {
    let a = PI * max(width, WINDOW_FLOOR);
    return sin(2.0 * PI * fract(x)) * select(sin(a) / a, 1.0, width < WINDOW_FLOOR);
}

/// The part of a window that a line covers, whose middle is `away` from the window's.
fn line_share(away: f32, half_line: f32, width: f32) -> f32 {
    let w = max(width, WINDOW_FLOOR);
    let covered = clamp(away + 0.5 * w, -half_line, half_line) - clamp(away - 0.5 * w, -half_line, half_line);
    return select(covered / w, select(0.0, 1.0, abs(away) < half_line), width < WINDOW_FLOOR);
}

/// The part of a window that lies inside of an outline, whose signed distance (negative inside) is known: a ramp as wide as the window, or as
/// the edge's own softness when that is more.
fn inside_share(signed_distance: f32, softness: f32, width: f32) -> f32 {
    let ramp = max(max(softness, width), 1e-6);
    return clamp(0.5 - signed_distance / ramp, 0.0, 1.0);
}
