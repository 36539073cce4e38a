// The lights of the app, as the lobes take them.

/// Depth in view space, which cascades of shadows and clusters of lights go by.
fn engine_view_z(mesh: VertexOutput) -> f32 {
    let view_from_world = engine::view.view_from_world;
    let row = vec4f(view_from_world[0].z, view_from_world[1].z, view_from_world[2].z, view_from_world[3].z);
    return dot(row, mesh.world_position);
}

/// The lights that may reach this fragment: first and last of each kind.
fn engine_clusters(mesh: VertexOutput) -> clustering::ClusterableObjectIndexRanges {
    let is_orthographic = engine::view.clip_from_view[3].w == 1.0;
    let cluster = clustering::view_fragment_cluster_index(mesh.position.xy, engine_view_z(mesh), is_orthographic);
    return clustering::unpack_clusterable_object_index_ranges(cluster);
}

/// What arrives from a directional light of the app.
fn engine_directional_light(mesh: VertexOutput, index: u32) -> LightSample {
    let light = &engine::lights.directional_lights[index];
    var illuminance = (*light).color.rgb;
    if ((*light).flags & engine_types::DIRECTIONAL_LIGHT_FLAGS_SHADOWS_ENABLED_BIT) != 0u {
        let view_z = engine_view_z(mesh);
        illuminance *=
            shadows::fetch_directional_shadow(index, mesh.world_position, mesh.world_normal, view_z, mesh.position.xy);
    }
    return LightSample((*light).direction_to_light, illuminance);
}

/// What arrives from a point light, or from where a spot light stands, without shadow.
fn engine_unshadowed(mesh: VertexOutput, id: u32) -> LightSample {
    let light = &engine::clustered_lights.data[id];
    let to_light = (*light).position_radius.xyz - mesh.world_position.xyz;
    let distance2 = dot(to_light, to_light);
    let falloff = lighting::getDistanceAttenuation(distance2, (*light).color_inverse_square_range.w);
    // 1e-12 keeps a light that stands on the surface from 0 / 0.
    let dir = to_light * inverseSqrt(max(distance2, 1e-12));
    return LightSample(dir, (*light).color_inverse_square_range.rgb * falloff);
}

/// What arrives from a point light of the app.
fn engine_point_light(mesh: VertexOutput, index: u32) -> LightSample {
    let id = clustering::get_clusterable_object_id(index);
    var light = engine_unshadowed(mesh, id);
    if (engine::clustered_lights.data[id].flags & engine_types::POINT_LIGHT_FLAGS_SHADOWS_ENABLED_BIT) != 0u {
        light.illuminance *= shadows::fetch_point_shadow(id, mesh.world_position, mesh.world_normal, mesh.position.xy);
    }
    return light;
}

/// What arrives from a spot light of the app. Its direction is stored as x and z with the sign of y; scale and offset take
/// the cosine of the angle from its axis to a factor that is squared.
fn engine_spot_light(mesh: VertexOutput, index: u32) -> LightSample {
    let id = clustering::get_clusterable_object_id(index);
    var light = engine_unshadowed(mesh, id);
    let stored = engine::clustered_lights.data[id].light_custom_data;
    let flags = engine::clustered_lights.data[id].flags;
    let y = sqrt(max(0.0, 1.0 - stored.x * stored.x - stored.y * stored.y));
    let below = (flags & engine_types::POINT_LIGHT_FLAGS_SPOT_LIGHT_Y_NEGATIVE) != 0u;
    let axis = vec3f(stored.x, select(y, -y, below), stored.y);
    let cone = saturate(dot(-axis, light.dir) * stored.z + stored.w);
    light.illuminance *= cone * cone;
    if (flags & engine_types::POINT_LIGHT_FLAGS_SHADOWS_ENABLED_BIT) != 0u {
        let near_z = engine::clustered_lights.data[id].shadow_map_near_z;
        light.illuminance *=
            shadows::fetch_spot_shadow(id, mesh.world_position, mesh.world_normal, near_z, mesh.position.xy);
    }
    return light;
}
