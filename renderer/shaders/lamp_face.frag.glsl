// Each pixel gets the share of it that the face covers: the right luminance where it covers pixels, and where it is smaller than one the same
// light at the eye, wherever it lies between pixels.
#include "photometry.glsl"
#include "outputs.glsl"

in vec2 v_px;
flat in vec4 v_place_px;
flat in vec3 v_light;

void main() {
    vec2 pixel = floor(v_px) + 0.5, low = v_place_px.xy - 0.5 * v_place_px.zw, high = v_place_px.xy + 0.5 * v_place_px.zw;
    vec2 covered = max(min(pixel + 0.5, high) - max(pixel - 0.5, low), vec2(0.0));
    vec3 light = v_light * (covered.x * covered.y);
    float luminance = dot(vec3(0.2126, 0.7152, 0.0722), light);
#include "seen_outputs.glsl"
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
