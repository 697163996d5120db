// Technique `photometric-naive`: the equations of `photometric` written down as they stand, for its speed to be measured against.
//
// Compiled per set of features: LAMP_COUNT, SHADOWS, TEXTURED, GLOSS, and which results are wanted (WANT_*). What is left out adds exactly +0.
#include "naive_lamps.glsl"
#include "materials.glsl"

uniform vec3 eye_m;            // relative to the car
uniform vec3 eye_direction;    // map views: the same for every point; 0 0 0: perspective
uniform vec4 eye_axis;         // xyz: viewing direction, depth along it
uniform float sky_lx;          // horizontal illuminance
uniform float target_height_m;
uniform vec4 tone;             // kind, s, l_max
uniform vec3 white[3];         // rows of the eye's adaptation; the unit matrix: none

in vec3 v_position_m;
in vec3 v_normal;
in vec2 v_uv;
#if TEXTURED
layout(binding = 15) uniform sampler2DArray surface_textures;
#endif
flat in uint v_material;
flat in uint v_mesh;

#include "outputs.glsl"

const vec3 luminance_weights = vec3(0.2126, 0.7152, 0.0722);

float toned(float l) {
    if (tone.x == 0.0)
        return tone_linear(l, tone.z);
    return tone.x == 1.0 ? tone_rational(l, tone.z, tone.y) : tone_logarithmic(l, tone.z, tone.y);
}

vec3 n = normalize(v_normal);
vec3 p = v_position_m;
PRECISE float illuminance = 0.0;
PRECISE float target = 0.0;
PRECISE vec3 light = vec3(0.0);
#if WANT_SEEN
Material material = materials[v_material];
vec3 albedo = material.albedo.rgb;
float rl = material.albedo.w;
vec3 to_eye = eye_direction == vec3(0.0) ? eye_m - p : eye_direction;
#endif

#if LAMP_COUNT > 0
void add_lamp(Lamp lamp, sampler2D beam, sampler2D map) {
    vec3 to_lamp = lamp.position_m.xyz - p;
    float cosine = incidence(n, to_lamp);
    vec3 w = lamp_space(-to_lamp, lamp.right.xyz, lamp.up.xyz, lamp.forward.xyz);
    float e_perp = cosine > 0.0 ? facing_illuminance(intensity_towards(lamp, beam, w), to_lamp) : 0.0;
#if SHADOWS
    if (e_perp > 0.0 && lamp.count.w > 0.0)
        e_perp *= visibility(lamp, map, w, p, n);
#endif
    float e = e_perp * cosine;
    illuminance += e;
#if WANT_SEEN
    light += lamp.colour.rgb * vec3(diffuse_luminance(albedo.r, e), diffuse_luminance(albedo.g, e), diffuse_luminance(albedo.b, e));
    if (rl > 0.0)
        light += lamp.colour.rgb * material.tint.rgb * retro_luminance(rl, e_perp, cosine, observation_angle(to_lamp, to_eye), material.retro.x, material.retro.y);
#endif
#if WANT_SEEN && GLOSS
    if (material.gloss.x > 0.0 && e_perp > 0.0)
        light += lamp.colour.rgb * (material.gloss.x * e_perp * facet_mirrored(n, normalize(to_lamp), normalize(to_eye), material.gloss.y, facet_index));
#endif
#if WANT_TARGET
    vec3 raised = p + vec3(0.0, 0.0, target_height_m);
    vec3 raised_to_lamp = lamp.position_m.xyz - raised;
    vec3 raised_w = lamp_space(-raised_to_lamp, lamp.right.xyz, lamp.up.xyz, lamp.forward.xyz);
    float e_target = facing_illuminance(intensity_towards(lamp, beam, raised_w), raised_to_lamp);
#if SHADOWS
    if (e_target > 0.0 && lamp.count.w > 0.0)
        e_target *= visibility(lamp, map, raised_w, raised, normalize(raised_to_lamp));
#endif
    target += e_target;
#endif
}
#if SHADOWS
#define ADD_LAMP(i, beam, map) add_lamp(lamps[i], beams[i], shadow_maps[i]);
#else
#define ADD_LAMP(i, beam, map) add_lamp(lamps[i], beams[i], beams[i]);
#endif
#endif

void main() {
#if TEXTURED && WANT_SEEN
    vec4 texel = texture(surface_textures, vec3(v_uv, material.emission.w));
    if (material.retro.z > 0.0) {
        albedo = combined_reflectance(int(material.retro.z) - 1, material.albedo.rgb, texel, material.blend.rgb);
        rl = textured_rl(material.albedo.w, material.albedo.rgb, albedo);
    }
#endif

#if LAMP_COUNT > 0
    EACH_LAMP(ADD_LAMP)
#endif

    float e_sky = sky_lx * 0.5 * (1.0 + n.z);
    illuminance += e_sky;
#if WANT_SEEN
    light += vec3(diffuse_luminance(albedo.r, e_sky), diffuse_luminance(albedo.g, e_sky), diffuse_luminance(albedo.b, e_sky));
#if GLOSS
    light += vec3(material.gloss.x * (sky_lx * photometry_inverse_pi) *
                  dielectric_reflectance(facet_cosine(max(dot(n, normalize(to_eye)), 0.0), material.gloss.y), facet_index));
#endif
#endif

#if WANT_SEEN
    light += material.emission.rgb;
    float luminance = dot(luminance_weights, light);
#endif
#if WANT_COLOUR
    vec3 adapted = white_adapted(light, white[0], white[1], white[2]);
    vec3 shown = luminance > 0.0 ? clamp(adapted * (toned(luminance) / dot(luminance_weights, adapted)), 0.0, 1.0) : vec3(0.0);
    out_colour = vec4(srgb_encoded(shown.r), srgb_encoded(shown.g), srgb_encoded(shown.b), 1.0);
#endif
#if WANT_ILLUMINANCE
    out_illuminance_lx = illuminance;
#endif
#if WANT_TARGET
    out_target_lx = target;
#endif
#if WANT_LUMINANCE
    out_luminance_cdm2 = luminance;
#endif
#if WANT_LIGHT
    out_light = vec4(light, 1.0);
#endif
#if WANT_DEPTH
    out_depth_m = dot(p - eye_m, eye_axis.xyz);
#endif
#if WANT_IDS
    out_id = v_mesh;
#endif
}
