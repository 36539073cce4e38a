/// The outputs of the node coordinates/flipbook.
struct FlipbookOutputs {
    /// coordinates in the frame
    uv: vec2f,
    /// coordinates in the next frame
    next_uv: vec2f,
    /// how far the next frame has come, 0 to 1
    blend: f32,
}

/// Where a frame of a flipbook begins, for unit coordinates in a frame.
fn flipbook_uv(uv: vec2f, columns: f32, rows: f32, frame: f32) -> vec2f {
    let row = floor(frame / columns);
    return (uv + vec2f(frame - row * columns, row)) / vec2f(columns, rows);
}

/// Flipbook Coordinates
///
/// Coordinates of one frame of a picture that holds many, row by row from the top left. Frames go round. Read the picture by Image at Moved
/// Coordinates, with the old coordinates as the smooth ones, scaled by one over columns and rows.
/// @node coordinates/flipbook   @also sprite sheet, animation, frames, subuv
/// - uv: coordinates in a frame, held in 0..1 [context uv0]
/// - columns: frames in a row; at least 1 [4; 1..16]
/// - rows: rows of frames; at least 1 [4; 1..16]
/// - frame: which one; its fraction is the blend [0; 0..16]
fn node_coordinates_flipbook(uv: vec2f, columns: i32, rows: i32, frame: f32) -> FlipbookOutputs {
    let across = f32(max(columns, 1));
    let down = f32(max(rows, 1));
    let count = across * down;
    let whole = floor(frame);
    let now = whole - count * floor(whole / count);
    let next = select(now + 1.0, 0.0, now + 1.0 >= count);
    let inside = clamp(uv, vec2f(0.0), vec2f(1.0));
    return FlipbookOutputs(flipbook_uv(inside, across, down, now), flipbook_uv(inside, across, down, next), frame - whole);
}
