// The published techniques: what they compute per fragment. Pictures are lit, not reflectances: colours are sRGB-encoded and multiplied by
// a share of white as they are.
#include "outputs.glsl"
#include "published_features.glsl"

#if TEXTURED && WANT_COLOUR
layout(binding = 15) uniform sampler2DArray surface_textures;
#endif

#if BY_FRAGMENT
layout(binding = 0) uniform sampler2D beams[LAMP_COUNT];

#if BEHIND == EACH
#define IN_FRONT(i) (v_place[i].w > 0.0)
#elif BEHIND == EACH_PRINTED
#define IN_FRONT(i) (v_place[i].w >= 0.0)
#elif BEHIND == FIRST
#define IN_FRONT(i) (i != 0 || v_place[i].w > 0.0)
#elif BEHIND == LAST
#define IN_FRONT(i) (v_place[LAMP_COUNT - 1].w > 0.0)
#else
#define IN_FRONT(i) true
#endif

#define DISTANCE_TO(i) v_place[ONE_DISTANCE == 1 ? 0 : i].z

float fall_off(float d, float inverse_q) {
#if FRAGMENT_TEXTURES_ONLY || DISTANCE == NONE
    return 1.0;
#elif DISTANCE == UNSQUARED
    return 1.0 / (1.0 + d);
#elif DISTANCE == AXIAL
    float inverse_z = (1.0 - d * inverse_q) * (1.0 / PROJECTION_NEAR); // r/q = 1 - near / z
    return inverse_z * inverse_z;
#else
    return 1.0 / (1.0 + d * d);
#endif
}

#define LIGHT_BY(i, beam, map) \
    { \
        float inverse_q = 1.0 / v_place[i].w; \
        float e_m = textureLod(beams[i], v_place[i].xy * inverse_q, 0.0).r; \
        e_m = IN_FRONT(i) ? e_m : 0.0; \
        lux += e_m * v_gain[i / 4][i % 4] * fall_off(DISTANCE_TO(i), inverse_q); \
    }
#endif

#if BY_MAP
#if LIGHT == VOLUME_MAP
layout(binding = 0) uniform sampler3D light_map;
#else
layout(binding = 0) uniform sampler2D light_map;
#endif

// Texture coordinates over the map's axes (light_map.h); cells ahead grow, so that a logarithm is due.
float mapped_lux(vec3 car_m) {
    vec3 share = (car_m - MAP_FROM) * MAP_INVERSE_SPAN;
    share.x = log(1.0 + max(share.x, 0.0) * (MAP_GROWTH - 1.0)) * (1.0 / log(MAP_GROWTH));
#if LIGHT == VOLUME_MAP
    return textureLod(light_map, share, 0.0).r;
#else
    return textureLod(light_map, share.xy, 0.0).r;
#endif
}
#endif

void main() {
    float lux = 0.0;
#if BY_FRAGMENT
    EACH_LAMP(LIGHT_BY)
#elif BY_VERTEX
    lux = v_lux;
#elif BY_MAP
    lux = mapped_lux(v_car_m);
#endif
#if SKY_IN_PASS
    lux += v_sun_lx;
#endif

#if WANT_COLOUR
    vec3 colour = v_own;
#if TEXTURED
    colour = combined_reflectance(TEXTURE_MODE, v_own, texture(surface_textures, vec3(v_uv, v_blend.w)), v_blend.rgb);
#endif
#if TONE != NONE
#if BY_VERTEX
    float light = v_light;
#elif AMBIENT
    float light = toned(lux + v_ambient);
#else
    float light = toned(lux);
#endif
#if EMISSIVE == FADING && !FRAGMENT_TEXTURES_ONLY
    colour *= min(vec3(light) + v_emissive * max(v_fade, 0.0), 1.0);
#elif EMISSIVE == SCALAR
    colour *= min(light + v_emissive, 1.0);
#else
    colour *= light;
#endif
#endif
    float alpha = 1.0; // nobody reads it
#if FRAGMENT_TEXTURES_ONLY && BY_FRAGMENT
    // So that the linker leaves the vertex stage its work.
    alpha = v_fade + v_emissive.g + v_place[0].z + v_place[LAMP_COUNT - 1].z;
#endif
    out_colour = vec4(colour, alpha);
#endif
#if WANT_ILLUMINANCE
    out_illuminance_lx = lux;
#endif
#if WANT_DEPTH
    out_depth_m = v_depth_m;
#endif
#if WANT_IDS
    out_id = v_mesh;
#endif
}
