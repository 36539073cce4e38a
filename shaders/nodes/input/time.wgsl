/// Time
///
/// Seconds since the start, times a speed.
/// @node input/time   @also clock, seconds, animate
/// - time: seconds [context time]
/// - speed: how fast it runs [1; 0..10]
/// - return: the time [s]
fn node_input_time(time: f32, speed: f32) -> f32 {
    return time * speed;
}
