// Share of a lamp that a surface sees, by depth maps that each have a matrix of their own (projected_maps.h). From lamp space: x, y, w in
// the texture, and what the look-up's point is raised by in metres.
#ifdef SHADOW_LAYERS
#define SHADOW_SAMPLER sampler2DArrayShadow
#else
#define SHADOW_SAMPLER sampler2DShadow
#endif
#define SHADOW_UNIT(i, beam, map) layout(binding = 8 + i + i / 7) uniform SHADOW_SAMPLER map;
EACH_LAMP(SHADOW_UNIT) // SHADOW_NEAR / w; 0: nothing
#if WANT_TARGET
layout(binding = 24) uniform SHADOW_SAMPLER target_shadow[LAMP_COUNT]; // the same with ground where it is
#endif
uniform mat4 shadow_from_lamp[LAMP_COUNT];

#ifdef SHADOW_LAYERS
const vec2 shadow_disc[SHADOW_LAYERS] = vec2[SHADOW_LAYERS](SHADOW_DISC); // places on the lamp's face, metres
#endif

// q: x, y, w of the point looked up. What lies outside the map, or behind what it can show, is lit.
float visibility(vec3 q, mat4 from_lamp, SHADOW_SAMPLER map) {
    float inverse = 1.0 / q.z;
    vec2 at = q.xy * inverse;
#ifdef SHADOW_LAYERS
    // From another place on the face the point lies as much to the other side.
    vec2 across = from_lamp[0].xy * inverse;
    vec2 up = from_lamp[1].xy * inverse;
    float seen = 0.0;
    for (int k = 0; k < SHADOW_LAYERS; ++k) // of one level: GLSL has no textureLod of such samplers
        seen += texture(map, vec4(at - shadow_disc[k].x * across - shadow_disc[k].y * up, float(k), SHADOW_NEAR * inverse));
    seen *= 1.0 / float(SHADOW_LAYERS);
#else
    float seen = textureLod(map, vec3(at, SHADOW_NEAR * inverse), 0.0);
#endif
    return q.z > 0.0 ? seen : 1.0;
}

// `share`: of what it is raised by, which level ground is not: see docs/decisions/0011.
float raised_visibility(vec3 w, vec3 unit_n, float share, mat4 from_lamp, SHADOW_SAMPLER map) {
    vec4 q = from_lamp * vec4(w, 1.0);
    return visibility(q.xyz + mat3(from_lamp) * (unit_n * share * max(SHADOW_TOLERANCE, q.w)), from_lamp, map);
}

#ifdef SHADOW_ONE_MAP
#define SHADOW_MAP_OF(map) shadow_0
#define TARGET_MAP_OF(i) target_shadow[0]
#else
#define SHADOW_MAP_OF(map) map
#define TARGET_MAP_OF(i) target_shadow[i]
#endif
#define SEEN(i, map) raised_visibility(v_w[i], v_n[i] * inverse_n, 1.0 - v_level * inverse_n, shadow_from_lamp[i], SHADOW_MAP_OF(map))
#define SEEN_TARGET(i, map, w) visibility((shadow_from_lamp[i] * vec4(w, 1.0)).xyz, shadow_from_lamp[i], TARGET_MAP_OF(i))
