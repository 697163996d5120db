// Each pixel gets the share of it that the face covers: the right luminance where it covers pixels, and where it is smaller than one the same
// light at the eye, wherever it lies between pixels.
#include "photometry.glsl"
#include "outputs.glsl"

in vec2 v_px;
flat in vec4 v_place_px;
flat in vec3 v_light;

float toned(float l) {
    if (TONE_KIND == 0)
        return tone_linear(l, TONE_L_MAX);
    return TONE_KIND == 1 ? tone_rational(l, TONE_L_MAX, TONE_S) : tone_logarithmic(l, TONE_L_MAX, TONE_S);
}

void main() {
    vec2 pixel = floor(v_px) + 0.5, low = v_place_px.xy - 0.5 * v_place_px.zw, high = v_place_px.xy + 0.5 * v_place_px.zw;
    vec2 covered = max(min(pixel + 0.5, high) - max(pixel - 0.5, low), vec2(0.0));
    vec3 light = v_light * (covered.x * covered.y);
    float luminance = dot(vec3(0.2126, 0.7152, 0.0722), light);
#if WANT_COLOUR
    vec3 shown = luminance > 0.0 ? clamp(light * (toned(luminance) / luminance), 0.0, 1.0) : vec3(0.0);
    out_colour = vec4(quick_srgb_encoded(shown.r), quick_srgb_encoded(shown.g), quick_srgb_encoded(shown.b), 1.0);
#endif
#if WANT_LUMINANCE
    out_luminance_cdm2 = luminance;
#endif
#if WANT_LIGHT
    out_light = vec4(light, 1.0);
#endif
#if WANT_ILLUMINANCE
    out_illuminance_lx = 0.0;
#endif
#if WANT_TARGET
    out_target_lx = 0.0;
#endif
#if WANT_DEPTH
    out_depth_m = 0.0;
#endif
#if WANT_IDS
    out_id = 0u;
#endif
}
