/// Height Map
///
/// The height that a grey value of a height map says, for the surface's height socket: (value - level) scale.
/// @node textures/height   @also displacement, bump, relief
/// - value: the map's value; read the map as linear [0.5; 0..1]
/// - scale: height between black and white [0.2; 0..1; m]
/// - level: the value that leaves the surface where it is [0; 0..1]
/// - return: height above the mesh [m]
fn node_textures_height(value: f32, scale: f32, level: f32) -> f32 {
    return (value - level) * scale;
}
