// Bevy's names that exported materials use, with their types as bevy_pbr 0.19 has them; `::` written as `_`.

struct VertexOutput {
    @builtin(position) position: vec4f,
    @location(0) world_position: vec4f,
    @location(1) world_normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) uv_b: vec2f,
    @location(4) world_tangent: vec4f,
    @location(5) color: vec4f,
    @location(6) @interpolate(flat) instance_index: u32,
}
struct EngineView {
    clip_from_view: mat4x4f,
    view_from_world: mat4x4f,
    world_position: vec3f,
    exposure: f32,
    color_grading: f32,
}
struct EngineDirectionalLight {
    color: vec4f,
    direction_to_light: vec3f,
    flags: u32,
}
struct EngineLights {
    directional_lights: array<EngineDirectionalLight, 10>,
    n_directional_lights: u32,
}
struct EngineClusteredLight {
    light_custom_data: vec4f,
    color_inverse_square_range: vec4f,
    position_radius: vec4f,
    flags: u32,
    shadow_map_near_z: f32,
}
struct EngineClusteredLights {
    data: array<EngineClusteredLight, 4>,
}
struct EngineGlobals {
    time: f32,
}
struct clustering_ClusterableObjectIndexRanges {
    first_point_light_index_offset: u32,
    first_spot_light_index_offset: u32,
    first_reflection_probe_index_offset: u32,
}
@group(0) @binding(0) var<uniform> engine_view: EngineView;
@group(0) @binding(1) var<uniform> engine_lights: EngineLights;
@group(0) @binding(8) var<uniform> engine_clustered_lights: EngineClusteredLights;
@group(0) @binding(11) var<uniform> engine_globals: EngineGlobals;

const engine_types_DIRECTIONAL_LIGHT_FLAGS_SHADOWS_ENABLED_BIT: u32 = 1u;
const engine_types_POINT_LIGHT_FLAGS_SHADOWS_ENABLED_BIT: u32 = 1u;
const engine_types_POINT_LIGHT_FLAGS_SPOT_LIGHT_Y_NEGATIVE: u32 = 2u;

fn clustering_view_fragment_cluster_index(frag_coord: vec2f, view_z: f32, is_orthographic: bool) -> u32 {
    return u32(frag_coord.x);
}
fn clustering_unpack_clusterable_object_index_ranges(cluster_index: u32) -> clustering_ClusterableObjectIndexRanges {
    return clustering_ClusterableObjectIndexRanges(0u, cluster_index, 2u);
}
fn clustering_get_clusterable_object_id(index: u32) -> u32 {
    return index;
}
fn lighting_getDistanceAttenuation(distance_square: f32, inverse_range_squared: f32) -> f32 {
    return distance_square * inverse_range_squared;
}
fn shadows_fetch_directional_shadow(
    light_id: u32,
    frag_position: vec4f,
    surface_normal: vec3f,
    view_z: f32,
    frag_coord_xy: vec2f,
) -> f32 {
    return view_z;
}
fn shadows_fetch_point_shadow(light_id: u32, frag_position: vec4f, surface_normal: vec3f, frag_coord_xy: vec2f) -> f32 {
    return frag_position.x;
}
fn shadows_fetch_spot_shadow(
    light_id: u32,
    frag_position: vec4f,
    surface_normal: vec3f,
    near_z: f32,
    frag_coord_xy: vec2f,
) -> f32 {
    return near_z;
}
fn mesh_functions_get_local_from_world(instance_index: u32) -> mat4x4f {
    return mat4x4f();
}
fn tone_mapping(color: vec4f, color_grading: f32) -> vec4f {
    return color * color_grading;
}
