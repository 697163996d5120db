// Technique `photometric`: exact distance and cosine per fragment, intensity from the candela table, one shadow map per lamp,
// diffuse and retroreflecting surfaces with their textures, uniform sky.
//
// Compiled per set of features: LAMP_COUNT, SHADOWS, SKY, SUN, SUN_SHADOWS, TRAFFIC, TRAFFIC_SHADOWS, FOG, LAMPS_IN_FOG, WET, BEADS, GLOSS, BACKGROUND, RETRO, RETRO_TINT, EMISSIVE, TEXTURED (0: none, 1: TEXTURE_MODE alone, 2: any), and which
// results are wanted (WANT_*). What is left out adds exactly +0 or multiplies by exactly 1.
#include "photometric_lamps.glsl"
#include "photometric_varyings.glsl"

#include "outputs.glsl"

const vec3 luminance_weights = vec3(0.2126, 0.7152, 0.0722);

#if TEXTURED
layout(binding = 15) uniform sampler2DArray surface_textures;
#endif

#if SUN_SHADOWS
layout(binding = 17) uniform sampler2DShadow sun_shadow; // 1 towards the light; 0: nothing
#endif

#if LAMP_COUNT > 0
// One sampler a lamp, so that each look-up names its own.
#define BEAM_UNIT(i, beam, map) layout(binding = i) uniform sampler2D beam;
EACH_LAMP(BEAM_UNIT) // candela
const vec4 beam_grid[LAMP_COUNT] = vec4[LAMP_COUNT](BEAM_GRIDS);   // first H, first V, 1 / step H, 1 / step V
const vec2 beam_count[LAMP_COUNT] = vec2[LAMP_COUNT](BEAM_COUNTS); // samples across, up
const vec2 beam_per_count[LAMP_COUNT] = vec2[LAMP_COUNT](BEAM_PER_COUNTS);
const bool beam_steep[LAMP_COUNT] = bool[LAMP_COUNT](BEAM_STEEP);  // reaches beyond 30 degrees up or down

// Candela towards w (lamp space, 1 / |w| known); 0 behind the lamp and outside its table.
float intensity_towards(vec3 w, float inverse_d, float factor, sampler2D beam, vec4 grid, vec2 count, vec2 per_count, bool steep) {
    vec2 at = beam_position(quick_goniometer_angles(w, inverse_d, steep), grid);
    float known = w.z > 0.0 ? beam_known(at, count) : 0.0;
    vec2 base = floor(at);
    vec4 cd = textureGather(beam, (base + 1.0) * per_count); // asked for midway between four texels, so that no rounding picks others
    float i = factor * bilinear(cd.w, cd.z, cd.x, cd.y, at - base);
    return known > 0.0 ? i : 0.0;
}

#if SHADOWS
#ifdef SHADOW_MAPS
#include "shadow_maps.glsl"
#endif
#ifdef SHADOW_MASK
#include "shadow_mask.glsl"
#endif
#ifdef PROJECTED_SHADOW_MAPS
#include "projected_shadow_maps.glsl"
#endif
#endif

#endif

#if LAMP_COUNT > 0 && FOG && WANT_SEEN
// Light of one lamp that the medium turns towards the eye between eye and w (both in lamp space), cd/m2: midpoints over the angle at the
// lamp, drawn together towards the far end with the power 3/2, where beams are narrow (docs/daylight.md has the errors).
float scattered_on_the_way(vec3 eye, vec3 w, float factor, sampler2D beam, vec4 grid, vec2 count, vec2 per_count, bool steep) {
    float way = length(w - eye);
    vec3 along = (w - eye) / way;
    float begin = eye.z > 0.0 ? 0.0 : (along.z > 0.0 ? -eye.z / along.z : way); // only what lies before the lamp is lit
    float end = along.z < 0.0 ? min(way, -eye.z / along.z) : way;
    float nearest_along = -dot(eye, along);
    vec3 nearest = eye + nearest_along * along;
    float apart = max(length(nearest), 1e-3);
    nearest /= apart;
    float first = atan((begin - nearest_along) / apart);
    float last = atan((end - nearest_along) / apart);
    float sum = 0.0;
    for (int k = 0; k < FOG_SAMPLES; ++k) {
        float x = 1.0 - (float(k) + 0.5) / float(FOG_SAMPLES);
        float angle = last - (last - first) * x * sqrt(x);
        float s = sin(angle);
        float c = max(cos(angle), 1e-6);
        float cd = intensity_towards(nearest * c + along * s, 1.0, factor, beam, grid, count, per_count, steep);
        sum += sqrt(x) * scattered_towards_eye(cd, s, c, apart, nearest_along, v_fog.x, v_fog.w);
    }
    return end > begin ? v_fog.z * sum * (1.5 * (last - first) / (float(FOG_SAMPLES) * apart)) : 0.0;
}
#endif

#if FOG
#define TRAFFIC_EXTINCTION v_fog.x
#endif
#if TRAFFIC
#include "traffic_lamps.glsl"
#if TRAFFIC_SHADOWS
#include "traffic_shadows.glsl"
#endif
#endif
#if LAMPS_IN_FOG
#include "lamps_in_fog.glsl"
#endif

PRECISE float illuminance = 0.0;
PRECISE float target = 0.0;
PRECISE vec3 light = vec3(0.0);

#if LAMPS_BY_VERTEX
#define COLOUR(i) v_colour[i]
#define EYE(i) v_eye[i]
#define RAISE(i) v_raise[i]
#else
#define COLOUR(i) lamps[i].colour
#define EYE(i) lamps[i].eye
#define RAISE(i) lamps[i].raise.xyz
#endif

// One lamp; a macro, since constants must be picked by constants.
#if !SHADOWS
#define SEEN(i, map) 1.0
#define SEEN_TARGET(i, map, w) 1.0
#endif

#if FOG
#define THROUGH_AIR(e, inverse_d) ((e) * transmittance(v_fog.x, 1.0 / (inverse_d)))
#else
#define THROUGH_AIR(e, inverse_d) (e)
#endif

#if WANT_SEEN && WET
// What a wet surface adds to the light of one source, beside `1 - v_wet` of what it would send dry.
vec3 wet_light(vec3 albedo, vec3 n, vec3 to_light, vec3 to_eye, float e_perp) {
    float c_in = max(dot(n, to_light), 0.0);
    float c_out = max(dot(n, to_eye), 0.0);
    float f_in = facet_cosine(c_in, WET_ALPHA);
    float f_out = facet_cosine(c_out, WET_ALPHA);
    float e = e_perp * c_in;
    vec3 under = vec3(wet_albedo(albedo.r, f_in, f_out), wet_albedo(albedo.g, f_in, f_out), wet_albedo(albedo.b, f_in, f_out));
    vec3 diffuse = vec3(diffuse_luminance(under.r, e), diffuse_luminance(under.g, e), diffuse_luminance(under.b, e));
    float mirrored = e_perp > 0.0 ? e_perp * wet_mirrored(n, to_light, to_eye, WET_ALPHA) : 0.0;
    return diffuse + vec3(mirrored);
}
// And under the sky: diffuse as it enters from all sides and leaves towards the eye; mirrored, the sky's own luminance.
vec3 wet_sky_light(vec3 albedo, vec3 n, float e_sky) {
    float out_cosine = facet_cosine(max(-dot(n, normalize(v_from_eye)), 0.0), WET_ALPHA);
    vec3 under = vec3(wet_albedo(albedo.r, 0.5, out_cosine), wet_albedo(albedo.g, 0.5, out_cosine), wet_albedo(albedo.b, 0.5, out_cosine));
    return vec3(diffuse_luminance(under.r, e_sky), diffuse_luminance(under.g, e_sky), diffuse_luminance(under.b, e_sky)) +
           vec3(v_sky_cdm2 * water_reflectance(out_cosine));
}
#define DRY(x) ((1.0 - v_wet) * (x))
#define REFLECT_WET(i, e_perp, inverse_d) \
    light += COLOUR(i).rgb * (v_wet * wet_light(albedo, v_n[i] * inverse_n, -v_w[i] * inverse_d, normalize(EYE(i).xyz - EYE(i).w * v_w[i]), e_perp));
#else
#define DRY(x) (x)
#define REFLECT_WET(i, e_perp, inverse_d)
#endif

#if WANT_SEEN && GLOSS
// What the facets of a dry surface mirror of one source, and of the sky.
float gloss_light(vec3 n, vec3 to_light, vec3 to_eye, float e_perp) {
    return e_perp > 0.0 ? v_gloss.x * e_perp * facet_mirrored(n, to_light, to_eye, v_gloss.y, facet_index) : 0.0;
}
float gloss_sky_light(vec3 n) {
    float out_cosine = facet_cosine(max(-dot(n, normalize(v_from_eye)), 0.0), v_gloss.y);
    return v_gloss.x * v_sky_cdm2 * dielectric_reflectance(out_cosine, facet_index);
}
#define REFLECT_GLOSS(i, e_perp, inverse_d) \
    light += DRY(COLOUR(i).rgb * gloss_light(v_n[i] * inverse_n, -v_w[i] * inverse_d, normalize(EYE(i).xyz - EYE(i).w * v_w[i]), e_perp));
#else
#define REFLECT_GLOSS(i, e_perp, inverse_d)
#endif

#if WANT_SEEN && RETRO && BEADS
#define WET_BEADS(l) light += v_wet * v_gloss.z * (l);
#else
#define WET_BEADS(l)
#endif

#if WANT_SEEN
#define REFLECT_DIFFUSE(i, e) light += DRY(COLOUR(i).rgb * vec3(diffuse_luminance(albedo.r, e), diffuse_luminance(albedo.g, e), diffuse_luminance(albedo.b, e)));
#if RETRO
#if RETRO_TINT
#define TINTED(colour) ((colour) * v_tint)
#else
#define TINTED(colour) (colour)
#endif
#define REFLECT_RETRO(i, e_perp, cosine) \
    { \
        vec3 returned = TINTED(COLOUR(i).rgb) * retro_luminance(rl, e_perp, cosine, quick_observation_angle(-v_w[i], EYE(i).xyz - EYE(i).w * v_w[i]), v_retro.x, v_retro.y); \
        light += DRY(returned); \
        WET_BEADS(returned) \
    }
#else
#define REFLECT_RETRO(i, e_perp, cosine)
#endif
#else
#define REFLECT_DIFFUSE(i, e)
#define REFLECT_RETRO(i, e_perp, cosine)
#endif

#if WANT_TARGET
#define LIGHT_TARGET(i, beam, map) \
    { \
        vec3 w = v_w[i] + RAISE(i); \
        float inverse_d = inversesqrt(dot(w, w)); \
        float cd = intensity_towards(w, inverse_d, COLOUR(i).w, beam, beam_grid[i], beam_count[i], beam_per_count[i], beam_steep[i]); \
        float e = THROUGH_AIR(facing_illuminance_at(cd, inverse_d), inverse_d); \
        target += e > 0.0 ? e * SEEN_TARGET(i, map, w) : 0.0; \
    }
#else
#define LIGHT_TARGET(i, beam, map)
#endif

#define LIGHT(i, beam, map) \
    { \
        float inverse_d = inversesqrt(dot(v_w[i], v_w[i])); \
        float cosine = max(-dot(v_n[i], v_w[i]) * (inverse_d * inverse_n), 0.0); \
        float cd = intensity_towards(v_w[i], inverse_d, COLOUR(i).w, beam, beam_grid[i], beam_count[i], beam_per_count[i], beam_steep[i]); \
        float e_perp = THROUGH_AIR(facing_illuminance_at(cd, inverse_d), inverse_d); \
        e_perp = cosine > 0.0 && e_perp > 0.0 ? e_perp * SEEN(i, map) : 0.0; \
        float e = e_perp * cosine; \
        illuminance += e; \
        REFLECT_DIFFUSE(i, e) \
        REFLECT_RETRO(i, e_perp, cosine) \
        REFLECT_WET(i, e_perp, inverse_d) \
        REFLECT_GLOSS(i, e_perp, inverse_d) \
        LIGHT_TARGET(i, beam, map) \
    }

#if LAMP_COUNT > 0 && FOG && WANT_SEEN
#define AIRLIGHT(i, beam, map) \
    light += COLOUR(i).rgb * scattered_on_the_way(EYE(i).xyz, v_w[i], COLOUR(i).w, beam, beam_grid[i], beam_count[i], beam_per_count[i], beam_steep[i]);

void add_airlight() {
    if (v_fog.z <= 0.0)
        return;
    EACH_LAMP(AIRLIGHT)
}
#endif

void main() {
#if !BACKGROUND
#if WANT_SEEN
    vec3 albedo = v_albedo.rgb;
    float rl = v_albedo.w;
#if TEXTURED
    // Fetched first, outside every branch: the level of detail comes from neighbouring fragments.
    vec4 texel = texture(surface_textures, vec3(v_uv, v_blend.w));
#if TEXTURED == 1
    albedo = combined_reflectance(TEXTURE_MODE, v_albedo.rgb, texel, v_blend.rgb);
    rl = textured_rl_at(v_rl_per_y, albedo);
#else
    vec3 textured = combined_reflectance(v_texture_mode, v_albedo.rgb, texel, v_blend.rgb);
    albedo = v_texture_mode >= 0 ? textured : v_albedo.rgb;
    rl = v_texture_mode >= 0 ? textured_rl_at(v_rl_per_y, textured) : v_albedo.w;
#endif
#endif
#endif

#if LAMP_COUNT > 0
    float inverse_n = inversesqrt(dot(v_n[0], v_n[0]));
    EACH_LAMP(LIGHT)
#endif

#if TRAFFIC
    {
        vec3 n = normalize(v_traffic_n);
        uvec2 list = v_traffic_list & 0x7fffffffu;
        ivec2 cell = ivec2(floor(v_traffic_cell));
        if ((v_traffic_list.y >> 31) != 0u && cell.x >= 0 && cell.y >= 0 && cell.x < TRAFFIC_CELLS_AHEAD && cell.y < TRAFFIC_CELLS_ACROSS)
            list = uvec2(texelFetch(traffic_cells, cell.y * TRAFFIC_CELLS_AHEAD + cell.x).xy);
        PRECISE vec4 others = v_traffic_light;
        PRECISE vec3 returned = vec3(0.0);
#if WANT_SEEN && WET
        PRECISE vec3 wet = vec3(0.0);
#endif
#if WANT_SEEN && GLOSS
        PRECISE vec3 mirrored = vec3(0.0);
#endif
        // Conditions at the loops' ends: llvmpipe runs a body once more, for no fragment, before it leaves by a condition at the beginning.
        uint k = 0u;
        if (list.y > 0u) do {
            vec4 entry = texelFetch(traffic_entries, int(list.x + k));
            TrafficUnit unit = traffic_unit(int(entry.x));
            int lamp = first_traffic_lamp(entry);
            int end = end_of_traffic_lamps(entry);
            do {
                vec3 to_lamp = traffic_place(unit, lamp) - v_traffic_p;
                float e_perp, whole;
                float e = traffic_lx(unit, entry, lamp, -to_lamp, n, e_perp, whole);
#if TRAFFIC_SHADOWS
                float left = traffic_left(unit, entry, lamp, v_traffic_p, n, whole);
                e *= left;
                e_perp *= left;
#endif
                others += vec4(unit.colour.rgb * e, e);
#if WANT_SEEN && WET
                wet += unit.colour.rgb * wet_light(albedo, n, normalize(to_lamp), -normalize(v_from_eye), e_perp);
#endif
#if WANT_SEEN && GLOSS
                mirrored += unit.colour.rgb * gloss_light(n, normalize(to_lamp), -normalize(v_from_eye), e_perp);
#endif
#if WANT_SEEN && RETRO
                returned += TINTED(unit.colour.rgb) *
                            retro_luminance(rl, e_perp, e, quick_observation_angle(to_lamp, v_traffic_eye.xyz - v_traffic_eye.w * v_traffic_p), v_retro.x, v_retro.y);
#endif
                ++lamp;
            } while (lamp < end);
            ++k;
        } while (k < list.y);
        illuminance += others.w;
#if WANT_SEEN
        light += DRY(vec3(diffuse_luminance(albedo.r, others.r), diffuse_luminance(albedo.g, others.g), diffuse_luminance(albedo.b, others.b)) + returned);
        WET_BEADS(returned)
#if GLOSS
        light += DRY(mirrored);
#endif
#if WET
        light += v_wet * wet;
#endif
#endif
    }
#endif

#if SKY
    float e_sky = v_sky_lx * 0.5 * (1.0 + normalize(v_normal).z);
    illuminance += e_sky;
#if WANT_SEEN
    light += DRY(vec3(diffuse_luminance(albedo.r, e_sky), diffuse_luminance(albedo.g, e_sky), diffuse_luminance(albedo.b, e_sky)));
#if GLOSS
    light += DRY(vec3(gloss_sky_light(normalize(v_normal))));
#endif
#if WET
    light += v_wet * wet_sky_light(albedo, normalize(v_normal), e_sky);
#endif
#endif
#endif

#if SUN
    float e_sun = directional_illuminance(v_sun.w, normalize(v_normal), v_sun.xyz);
#if SUN_SHADOWS
    e_sun = e_sun > 0.0 ? e_sun * textureLod(sun_shadow, v_sun_at, 0.0) : 0.0;
#endif
    illuminance += e_sun;
#if WANT_SEEN
    light += DRY(vec3(diffuse_luminance(albedo.r, e_sun), diffuse_luminance(albedo.g, e_sun), diffuse_luminance(albedo.b, e_sun)));
#if WET || GLOSS
    float sun_seen = e_sun > 0.0 ? e_sun / directional_illuminance(1.0, normalize(v_normal), v_sun.xyz) : 0.0;
#endif
#if GLOSS
    light += DRY(vec3(gloss_light(normalize(v_normal), v_sun.xyz, -normalize(v_from_eye), sun_seen)));
#endif
#if WET
    light += v_wet * wet_light(albedo, normalize(v_normal), v_sun.xyz, -normalize(v_from_eye), sun_seen);
#endif
#endif
#endif

#if WANT_SEEN
#if EMISSIVE
    light += v_emission;
#endif
#if FOG
    float left = transmittance(v_fog.y, length(v_from_eye));
    light = light * left + vec3(v_sky_cdm2 * (1.0 - left));
#endif
#endif
#endif // BACKGROUND

#if WANT_SEEN
#if BACKGROUND
    light = vec3(v_sky_cdm2);
#endif
#if LAMP_COUNT > 0 && FOG
    add_airlight();
#endif
#if LAMPS_IN_FOG
    light += air_light_of_others();
#endif
    float luminance = dot(luminance_weights, light);
#endif
#if WANT_ILLUMINANCE
    out_illuminance_lx = illuminance;
#endif
#if WANT_TARGET
    out_target_lx = target;
#endif
#include "seen_outputs.glsl"
#if WANT_DEPTH
    out_depth_m = BACKGROUND > 0 ? 0.0 : v_depth_m;
#endif
#if WANT_IDS
    out_id = BACKGROUND > 0 ? 0u : v_mesh;
#endif
}
