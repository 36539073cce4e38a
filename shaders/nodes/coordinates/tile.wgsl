/// The outputs of the node coordinates/tile.
struct TileOutputs {
    /// coordinates inside of the tile, 0 to 1
    uv: vec2f,
    /// column and row of the tile, whole numbers
    cell: vec2f,
}

/// Tile
///
/// Divides the unit square into columns and rows. An image read at the inner coordinates has a seam in its mip level at
/// each border; read it at uv times count with a repeating image instead, and use these for patterns.
/// @node coordinates/tile   @also tiling, repeat, grid, cells
/// - uv: coordinates [context uv0]
/// - count: columns and rows [4,4; 1..32]
fn node_coordinates_tile(uv: vec2f, count: vec2f) -> TileOutputs {
    let q = uv * count;
    return TileOutputs(fract(q), floor(q));
}
