// The published techniques: what they compute per vertex.
#include "surface.vert.glsl"
#include "published_features.glsl"

uniform mat4 clip_from_ego;
uniform vec3 eye_m;
uniform vec3 eye_axis;
uniform mat3 car_axes; // x forward, y left, z up
uniform float sun_lx;
uniform float ambient;

invariant gl_Position;

#if LIGHT == VERTEX_PROJECTED && LAMP_COUNT > 0
layout(binding = 0) uniform sampler2D beams[LAMP_COUNT];
#endif

#if LIGHT == SPOTS && LAMP_COUNT > 0
struct Spot {
    vec4 axis; // w: exponent
    vec4 cd;   // y: cosine of the cut-off
};
layout(std140, binding = 1) uniform Spots { Spot spots[LAMP_COUNT * SPOT_COUNT]; };

// OpenGL 1.x with attenuation 1 / d^2: intensity of the spots times cosine over distance squared.
float spots_lux(int lamp, vec3 to_lamp, vec3 n) {
    float inverse_d2 = 1.0 / max(dot(to_lamp, to_lamp), 1e-6);
    vec3 direction = to_lamp * sqrt(inverse_d2);
    float cd = 0.0;
    for (int k = 0; k < SPOT_COUNT; ++k) {
        Spot spot = spots[lamp * SPOT_COUNT + k];
        float c = -dot(direction, spot.axis.xyz);
        cd += c > spot.cd.y ? spot.cd.x * pow(max(c, 0.0), spot.axis.w) : 0.0;
    }
    return cd * inverse_d2 * max(dot(n, direction), 0.0);
}
#endif

#if LAMP_COUNT > 0
// (s, t, distance, q), with r in place of the distance where the technique divides by z.
vec4 place_of(int i, vec3 p) {
    vec4 place = lamps[i].texture_from_ego * vec4(p, 1.0);
    vec3 from_lamp = p - lamps[ONE_DISTANCE == 1 ? 0 : i].position_m.xyz;
#if DISTANCE == SQUARED || DISTANCE == UNSQUARED
    if (ONE_DISTANCE == 0 || i == 0)
        place.z = length(from_lamp);
#elif DISTANCE == PRINTED
    place.z = length(vec4(from_lamp, 1.0));
#endif
    return place;
}
#endif

void main() {
    vec3 p = mesh_offset_m.xyz + turned(position_m);
    Material m = materials[material];
#if WANT_COLOUR
    v_own = m.albedo.rgb;
#if TEXTURED
    v_uv = uv;
    v_blend = vec4(m.blend.rgb, m.emission.w);
#endif
#if EMISSIVE
    // Sheeting glows, whatever shines on it; what shines by itself does so at full.
    vec3 own_light = m.emission.rgb / max(max(m.emission.r, max(m.emission.g, m.emission.b)), 1e-6);
    vec3 emissive = max(m.albedo.w >= SHEETING_RL ? vec3(1.0) : vec3(0.0), own_light);
#if EMISSIVE == FADING
    v_emissive = emissive;
    v_fade = 1.0 - length(p - eye_m) * (1.0 / EMISSIVE_REACH);
#else
    v_emissive = max(emissive.r, max(emissive.g, emissive.b));
#endif
#endif
#if AMBIENT
    v_ambient = ambient;
#endif
#endif
#if SKY_IN_PASS
    v_sun_lx = sun_lx;
#endif

#if BY_FRAGMENT
    for (int i = 0; i < LAMP_COUNT; ++i) {
        v_gain[i / 4][i % 4] = lamps[i].position_m.w;
#if CONSTANTS
        // On the axis at 25 m. Made to look as if it came from the vertex: a linker would carry constants into the fragments.
        v_place[i] = position_m.x < 1e30 ? vec4(0.5, 0.5, 25.0, 1.0) : vec4(0.0);
#else
        v_place[i] = place_of(i, p);
#endif
    }
#if CONSTANTS && WANT_COLOUR && EMISSIVE == FADING
    v_fade = position_m.x < 1e30 ? 0.9 : 0.0;
#endif
#endif

#if BY_VERTEX
    float lux = 0.0;
#if LIGHT == SPOTS
    for (int i = 0; i < LAMP_COUNT; ++i)
        lux += lamps[i].position_m.w * spots_lux(i, lamps[i].position_m.xyz - p, turned(normal));
#else
#define SAMPLE(i, beam, map) \
    { \
        vec4 place = place_of(i, p); \
        float e_m = textureLod(beams[i], place.xy / place.w, 0.0).r; \
        lux += place.w > 0.0 ? e_m * lamps[i].position_m.w / (1.0 + place.z * place.z) : 0.0; \
    }
    EACH_LAMP(SAMPLE)
#endif
    v_lux = lux;
    v_light = toned(lux + sun_lx);
#endif

#if BY_MAP
    v_car_m = p * car_axes;
#endif
#if WANT_DEPTH
    v_depth_m = dot(p - eye_m, eye_axis);
#endif
#if WANT_IDS
    v_mesh = uint(abs(mesh_offset_m.w));
#endif
    gl_Position = clip_from_ego * vec4(p, 1.0);
}
