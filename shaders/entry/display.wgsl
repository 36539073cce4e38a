// Radiance becomes a display's colours: the plain mean of each pixel's samples, exposure, tone map, sRGB. The page that a
// scene is exported to draws it; it is linked with `color.wgsl` and `tone_map.wgsl`, whose `tone_map_none` stands for the
// scene's.

struct Display {
    /// Factor from radiance.
    exposure: f32,
    /// Samples along each side of a pixel.
    side: i32,
    /// 1 when the picture holds display values already (`encode=report`), 0 for radiance.
    coded: i32,
}

@group(0) @binding(0) var<uniform> display: Display;
@group(0) @binding(1) var display_samples: texture_2d<f32>;

/// Corners (-1, -1), (3, -1), (-1, 3): the triangle that holds the whole clip square.
@vertex
fn vs_display(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

/// Premultiplied, as canvases take it; the colour is made from straight alpha, so that edges keep it.
@fragment
fn fs_display(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let first = vec2i(position.xy) * display.side;
    var sum = vec4f(0.0);
    for (var y = 0; y < display.side; y++) {
        for (var x = 0; x < display.side; x++) {
            sum += textureLoad(display_samples, first + vec2i(x, y), 0);
        }
    }
    let mean = sum / f32(display.side * display.side);
    let alpha = clamp(mean.a, 0.0, 1.0);
    // 1e-6 keeps 0 / 0 out of pixels that nothing covers.
    let straight = mean.rgb / max(alpha, 1e-6);
    let shown = srgb_from_linear(tone_map_none(straight * display.exposure));
    let code = select(shown, straight, display.coded == 1);
    return vec4f(clamp(code, vec3f(0.0), vec3f(1.0)) * alpha, alpha);
}
