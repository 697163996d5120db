// The results that a view wants, each in the target that it has (gl/targets.cpp defines WANT_* and OUT_*).
#if WANT_COLOUR
layout(location = OUT_COLOUR) out vec4 out_colour;
#endif
#if WANT_ILLUMINANCE
layout(location = OUT_ILLUMINANCE) out float out_illuminance_lx;
#endif
#if WANT_TARGET
layout(location = OUT_TARGET) out float out_target_lx;
#endif
#if WANT_LUMINANCE
layout(location = OUT_LUMINANCE) out float out_luminance_cdm2;
#endif
#if WANT_LIGHT
layout(location = OUT_LIGHT) out vec4 out_light; // rgb: cd/m2 in sRGB's primaries
#endif
#if WANT_DEPTH
layout(location = OUT_DEPTH) out float out_depth_m;
#endif
#if WANT_IDS
layout(location = OUT_IDS) out uint out_id;
#endif

#ifdef TONE_KIND
float toned(float l) {
    if (TONE_KIND == 0)
        return tone_linear(l, TONE_L_MAX);
    return TONE_KIND == 1 ? tone_rational(l, TONE_L_MAX, TONE_S) : tone_logarithmic(l, TONE_L_MAX, TONE_S);
}

/// Shares of the display's channels, which may lie outside 0..1; the luminance is toned, the colour is as the eye sees it.
vec3 shown_light(vec3 light, float luminance) {
#ifdef WHITE_R
    light = white_adapted(light, WHITE_R, WHITE_G, WHITE_B);
    return light * (toned(luminance) / dot(vec3(0.2126, 0.7152, 0.0722), light));
#else
    return light * (toned(luminance) / luminance);
#endif
}
#endif
