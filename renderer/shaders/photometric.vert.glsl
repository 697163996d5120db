// Technique `photometric`. On software rasterisers an interpolated or flat input costs next to nothing in the fragment stage while a
// uniform costs as much as a dozen operations, so that everything that is linear over a triangle, or constant, is put out here.
#include "surface.vert.glsl"
#include "photometric_lamps.glsl"

uniform mat4 clip_from_ego;
uniform vec3 eye_m;
uniform vec4 eye_axis; // xyz: viewing direction; w: 1 perspective, 0 map
uniform float sky_lx;
#if SUN
uniform vec4 sun_towards_lx;
#if SUN_SHADOWS
uniform mat4 sun_map_from_ego;
uniform vec2 sun_raised_m; // of upright surfaces, of level ones
#endif
#endif

invariant gl_Position;

#include "photometric_varyings.glsl"

#if FOG
uniform vec4 fog;
#define TRAFFIC_EXTINCTION fog.x
#endif

#if TRAFFIC
layout(location = 6) in uvec4 traffic_lists;
uniform vec4 traffic_grid; // ahead x, y of the car; corner ahead, left
#include "traffic_lamps.glsl"
#endif

#if LAMPS_IN_FOG
uniform float air_lamp_count;
uniform float air_min_cdm2;
#endif
#if FOG || WET || GLOSS
uniform float sky_cdm2;
#endif
#if WET
uniform float wetness;
#endif
#if BACKGROUND
uniform vec3 background_m[3]; // a triangle over the whole picture, far away
#endif

void main() {
#if BACKGROUND
    vec3 p = background_m[gl_VertexID];
    vec3 n = vec3(0.0, 0.0, 1.0);
#else
    vec3 p = mesh_offset_m.xyz + turned(position_m);
    vec3 n = turned(normal);
    Material m = materials[material];
#endif
#if FOG || WET || GLOSS
    v_from_eye = eye_axis.w > 0.0 ? p - eye_m : 1000.0 * eye_axis.xyz; // as seen from a map: from straight above
    v_sky_cdm2 = sky_cdm2;
#endif
#if FOG
    v_fog = fog;
#endif
#if LAMPS_IN_FOG
    v_air = vec4(eye_m, air_lamp_count);
    v_air_min_cdm2 = air_min_cdm2;
#endif
#if WET
    v_wet = wetness * m.retro.w;
#endif
#if WANT_SEEN && !BACKGROUND
    v_albedo = m.albedo;
#if TEXTURED
    v_uv = uv;
    v_blend = vec4(m.blend.rgb, m.emission.w);
    v_texture_mode = int(m.retro.z) - 1;
    float own_y = dot(m.albedo.rgb, vec3(0.2126, 0.7152, 0.0722));
    v_rl_per_y = own_y > 0.0 ? m.albedo.w / own_y : 0.0;
#endif
#if EMISSIVE
    v_emission = m.emission.rgb;
#endif
#if RETRO
    v_retro = m.retro.xy;
#if RETRO_TINT
    v_tint = m.tint.rgb;
#endif
#endif
#endif
#if GLOSS || BEADS
    v_gloss = m.gloss.xyz;
#endif
#if SKY || SUN
    v_normal = n;
#endif
#if SKY
    v_sky_lx = sky_lx;
#endif
#if SUN
    v_sun = sun_towards_lx;
#if SUN_SHADOWS
    v_sun_at = (sun_map_from_ego * vec4(p + mix(sun_raised_m.x, sun_raised_m.y, n.z * n.z) * n, 1.0)).xyz;
#endif
#endif
#if WANT_DEPTH
    v_depth_m = dot(p - eye_m, eye_axis.xyz);
#endif
#if WANT_IDS && !BACKGROUND
    v_mesh = uint(abs(mesh_offset_m.w));
#endif
#ifdef SHADOW_LIFT
    v_level = mesh_offset_m.w < 0.0 ? n.z : 0.0;
#endif
#if LAMP_COUNT > 0
    for (int i = 0; i < LAMP_COUNT; ++i) {
        Lamp lamp = lamps[i];
        v_w[i] = lamp_space(p - lamp.position_m.xyz, lamp.right.xyz, lamp.up.xyz, lamp.forward.xyz);
        v_n[i] = lamp_space(n, lamp.right.xyz, lamp.up.xyz, lamp.forward.xyz);
#if LAMPS_BY_VERTEX
        v_colour[i] = lamp.colour;
#if WANT_TARGET
        v_raise[i] = lamp.raise.xyz;
#endif
#if WANT_SEEN && (RETRO || FOG || WET || GLOSS)
        v_eye[i] = lamp.eye;
#endif
#endif
    }
#endif
#if TRAFFIC
    v_traffic_p = p;
    v_traffic_n = n;
    v_traffic_list = traffic_lists.xy;
    v_traffic_eye = eye_axis.w > 0.0 ? vec4(eye_m, 1.0) : vec4(-eye_axis.xyz, 0.0);
    PRECISE vec2 ahead_left = vec2(p.x * traffic_grid.x + p.y * traffic_grid.y, p.y * traffic_grid.x - p.x * traffic_grid.y);
    v_traffic_cell = (ahead_left - traffic_grid.zw) * TRAFFIC_CELLS_A_METRE;
    PRECISE vec4 by_vertex = vec4(0.0);
    // Lanes without a vertex hold anything on llvmpipe of Mesa 25, and would go on for minutes.
    uint k = 0u, end = min(traffic_lists.w, uint(textureSize(traffic_entries)));
    if (end > 0u) do {
        vec4 entry = texelFetch(traffic_entries, int(traffic_lists.z + k));
        TrafficUnit unit = traffic_unit(int(entry.x));
        float e_perp, whole;
        float e = traffic_lx(unit, entry, 2, p - traffic_place(unit, 2), normalize(n), e_perp, whole);
        by_vertex += vec4(unit.colour.rgb * e, e);
        ++k;
    } while (k < end);
    v_traffic_light = by_vertex;
#endif
    gl_Position = clip_from_ego * vec4(p, 1.0);
}
