// The published techniques: words that their features are spelled with (technique.cpp), the lamps, and what the vertex stage hands to the
// fragment stage (STAGE_IO is `out` or `in`).
#include "photometry.glsl"

#define NONE 0
// LIGHT: where the lamps' light comes from
#define PROJECTED 1        // beam textures, looked up per fragment
#define VERTEX_PROJECTED 2 // the same per vertex
#define SPOTS 3            // spot lights of OpenGL 1.x per vertex
#define GROUND_MAP 4       // baked: illuminance of the plane that the car stands on
#define VOLUME_MAP 5       // baked: facing illuminance in a volume around the car
// DISTANCE, what the intensity is divided by
#define SQUARED 1   // 1 + d^2, d per vertex and interpolated
#define UNSQUARED 2 // 1 + d
#define PRINTED 3   // 1 + d^2 with the length of a 4-vector for d
#define AXIAL 4     // z^2 along the lamp's axis, from r/q per fragment
// BEHIND, which points are in front of a lamp
#define EACH 1         // q > 0
#define EACH_PRINTED 2 // q >= 0
#define FIRST 3        // q > 0 for the lamp farthest left, the others are not asked
#define LAST 4         // q > 0 of the lamp farthest right counts for all
// TONE: light -> what multiplies the surface's colour
#define RATIONAL 1
#define CLAMPED 2 // by the reference light
#define SHARE 3   // what the textures say, in shares of the beam's peak
// EMISSIVE
#define FADING 1 // a colour that falls to 0 at 500 m
#define SCALAR 2
// PASS
#define SINGLE 0
#define SKY_PASS 1
#define LAMP_PASS 2

#define LAMPS_IN_PASS (LAMP_COUNT > 0 && PASS != SKY_PASS)
#define SKY_IN_PASS (SUN && PASS != LAMP_PASS)
#define BY_FRAGMENT (LIGHT == PROJECTED && LAMPS_IN_PASS)
#define BY_VERTEX ((LIGHT == VERTEX_PROJECTED || LIGHT == SPOTS) && LAMPS_IN_PASS)
#define BY_MAP ((LIGHT == GROUND_MAP || LIGHT == VOLUME_MAP) && LAMPS_IN_PASS)

#if LAMP_COUNT > 0
struct Lamp {
    mat4 texture_from_ego; // (s, t, r, q)
    vec4 position_m;       // relative to the car; w: gain of what the texture holds
};
layout(std140, binding = 0) uniform Lamps { Lamp lamps[LAMP_COUNT]; };
#endif

#if WANT_COLOUR
flat STAGE_IO vec3 v_own; // sRGB-encoded
#if TEXTURED
STAGE_IO vec2 v_uv;
flat STAGE_IO vec4 v_blend; // w: texture layer
#endif
#if EMISSIVE == FADING
flat STAGE_IO vec3 v_emissive;
STAGE_IO float v_fade; // 1 at the eye
#elif EMISSIVE == SCALAR
flat STAGE_IO float v_emissive;
#endif
#if AMBIENT
flat STAGE_IO float v_ambient;
#endif
#endif
#if SKY_IN_PASS
flat STAGE_IO float v_sun_lx;
#endif
#if BY_FRAGMENT
STAGE_IO vec4 v_place[LAMP_COUNT]; // s, t, distance (AXIAL: r), q
flat STAGE_IO vec4 v_gain[(LAMP_COUNT + 3) / 4];
#endif
#if BY_VERTEX
STAGE_IO float v_lux;   // of the lamps
STAGE_IO float v_light; // what multiplies the colour
#endif
#if BY_MAP
STAGE_IO vec3 v_car_m; // in the car's frame
#endif
#if WANT_DEPTH
STAGE_IO float v_depth_m;
#endif
#if WANT_IDS
flat STAGE_IO uint v_mesh;
#endif

// Share of white for so many lux.
float toned(float lux) {
#if TONE == RATIONAL
    return tone_rational(lux, L_MAX, RATIONAL_S);
#elif TONE == CLAMPED
    return min(lux * (1.0 / REFERENCE_LIGHT), 1.0);
#else
    return min(lux, 1.0);
#endif
}
