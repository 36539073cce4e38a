// What the shader asks of Bevy: the viewer, the lights with their shadows, and the exposure and tone map at the end.

#import bevy_pbr::{
    forward_io::VertexOutput,
    mesh_view_bindings as engine,
    mesh_view_types as engine_types,
    clustered_forward as clustering,
    lighting,
    mesh_functions,
    shadows,
}
#ifdef TONEMAP_IN_SHADER
#import bevy_core_pipeline::tonemapping::tone_mapping
#endif

/// Radiance as the app's camera shows it.
fn engine_color(shaded: vec4f) -> vec4f {
    var color = vec4f(shaded.rgb * engine::view.exposure, shaded.a);
#ifdef TONEMAP_IN_SHADER
    color = tone_mapping(color, engine::view.color_grading);
#endif
    return color;
}
