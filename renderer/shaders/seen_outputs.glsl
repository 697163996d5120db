// What an eye sees of `light`, whose luminance is `luminance`.
#if WANT_COLOUR
    vec3 shown = luminance > 0.0 ? clamp(shown_light(light, luminance), 0.0, 1.0) : vec3(0.0);
    out_colour = vec4(quick_srgb_encoded(shown.r), quick_srgb_encoded(shown.g), quick_srgb_encoded(shown.b), 1.0);
#endif
#if WANT_LUMINANCE
    out_luminance_cdm2 = luminance;
#endif
#if WANT_LIGHT
    out_light = vec4(light, 1.0);
#endif
