// Share of a lamp that a surface sees, by a depth map for each lamp.
#define SHADOW_UNIT(i, beam, map) layout(binding = 8 + i + i / 7) uniform sampler2DShadow map; // units 8 to 14, and 16
EACH_LAMP(SHADOW_UNIT) // shadow_near_m / distance along the axis; 0: nothing
#if WANT_TARGET
layout(binding = 24) uniform sampler2DShadow target_shadow[LAMP_COUNT]; // the same with ground where it is
#endif
const vec4 shadow_window[LAMP_COUNT] = vec4[LAMP_COUNT](SHADOW_WINDOWS); // tangents -> texture: scale x, y, offset x, y

// Share of the lamp seen from a point in lamp space: four texels, weighted. Outside the map nothing is known to stand in the way.
float visibility(vec3 w, sampler2DShadow map, vec4 window) {
    float inverse_z = 1.0 / w.z;
    return textureLod(map, vec3(w.xy * inverse_z * window.xy + window.zw, SHADOW_NEAR * inverse_z), 0.0);
}

// Looked up from a point raised above the surface by what a texel spans there, but for level ground: see docs/decisions/0005 and 0011.
#define SEEN(i, map) visibility(v_w[i] + v_n[i] * (inverse_n * (1.0 - v_level * inverse_n) * max(SHADOW_TOLERANCE, SHADOW_SPREAD * v_w[i].z)), map, shadow_window[i])
#define SEEN_TARGET(i, map, w) visibility(w, target_shadow[i], shadow_window[i])
