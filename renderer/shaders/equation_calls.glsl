// Every equation of photometry.glsl under a number, with up to 16 arguments in four vectors: so that one text calls each of them on the GPU in
// float and in C++ in float and double (runner/experiments/stability/equations.h has the names, in this order). Same subset as photometry.glsl.
FN vec3 first_three(vec4 v) { return vec3(v.x, v.y, v.z); }

FN vec4 equation_value(int equation, vec4 a, vec4 b, vec4 c, vec4 d) {
    if (equation == 0) {
        vec3 w = lamp_space(first_three(a), first_three(b), first_three(c), first_three(d));
        return vec4(w.x, w.y, w.z, 0.0);
    }
    if (equation == 1) {
        vec2 angles = goniometer_angles(first_three(a));
        return vec4(angles.x, angles.y, 0.0, 0.0);
    }
    if (equation == 2)
        return vec4(quick_atan_unit(a.x), 0.0, 0.0, 0.0);
    if (equation == 3)
        return vec4(quick_atan(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 4)
        return vec4(quick_asin_half(a.x), 0.0, 0.0, 0.0);
    if (equation == 5 || equation == 6) {
        vec3 w = first_three(a);
        vec2 angles = quick_goniometer_angles(w, inversesqrt(dot(w, w)), equation == 6);
        return vec4(angles.x, angles.y, 0.0, 0.0);
    }
    if (equation == 7) {
        vec2 position = beam_position(vec2(a.x, a.y), b);
        return vec4(position.x, position.y, 0.0, 0.0);
    }
    if (equation == 8)
        return vec4(beam_known(vec2(a.x, a.y), vec2(b.x, b.y)), 0.0, 0.0, 0.0);
    if (equation == 9)
        return vec4(bilinear(a.x, a.y, a.z, a.w, vec2(b.x, b.y)), 0.0, 0.0, 0.0);
    if (equation == 10)
        return vec4(facing_illuminance(a.x, first_three(b)), 0.0, 0.0, 0.0);
    if (equation == 11)
        return vec4(facing_illuminance_at(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 12)
        return vec4(incidence(first_three(a), first_three(b)), 0.0, 0.0, 0.0);
    if (equation == 13)
        return vec4(diffuse_luminance(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation >= 14 && equation <= 17) {
        vec3 colour = combined_reflectance(equation - 14, first_three(a), b, first_three(c));
        return vec4(colour.x, colour.y, colour.z, 0.0);
    }
    if (equation == 18)
        return vec4(textured_rl(a.w, first_three(a), first_three(b)), 0.0, 0.0, 0.0);
    if (equation == 19)
        return vec4(textured_rl_at(a.w, first_three(a)), 0.0, 0.0, 0.0);
    if (equation == 20)
        return vec4(observation_angle(first_three(a), first_three(b)), 0.0, 0.0, 0.0);
    if (equation == 21)
        return vec4(quick_observation_angle(first_three(a), first_three(b)), 0.0, 0.0, 0.0);
    if (equation == 22)
        return vec4(retro_luminance(a.x, a.y, a.z, a.w, b.x, b.y), 0.0, 0.0, 0.0);
    if (equation == 23)
        return vec4(height_above_plane(first_three(a), first_three(b), first_three(c)), 0.0, 0.0, 0.0);
    if (equation == 24)
        return vec4(tone_linear(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 25)
        return vec4(tone_rational(a.x, a.y, a.z), 0.0, 0.0, 0.0);
    if (equation == 26)
        return vec4(tone_logarithmic(a.x, a.y, a.z), 0.0, 0.0, 0.0);
    if (equation == 27)
        return vec4(srgb_encoded(a.x), 0.0, 0.0, 0.0);
    if (equation == 29)
        return vec4(directional_illuminance(a.x, first_three(b), first_three(c)), 0.0, 0.0, 0.0);
    if (equation == 30)
        return vec4(sky_illuminance(a.x, first_three(b)), 0.0, 0.0, 0.0);
    if (equation == 31)
        return vec4(transmittance(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 32)
        return vec4(henyey_greenstein(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 33)
        return vec4(scattered_towards_eye(a.x, a.y, sqrt(1.0 - a.y * a.y), a.z, a.w, b.x, b.y), 0.0, 0.0, 0.0);
    if (equation == 34)
        return vec4(facet_cosine(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 35)
        return vec4(water_reflectance(a.x), 0.0, 0.0, 0.0);
    if (equation == 36)
        return vec4(wet_albedo(a.x, a.y, a.z), 0.0, 0.0, 0.0);
    if (equation == 37)
        return vec4(wet_mirrored(first_three(a), first_three(b), first_three(c), a.w), 0.0, 0.0, 0.0);
    if (equation == 38) {
        vec3 light = white_adapted(first_three(a), first_three(b), first_three(c), first_three(d));
        return vec4(light.x, light.y, light.z, 0.0);
    }
    if (equation == 39)
        return vec4(dielectric_reflectance(a.x, a.y), 0.0, 0.0, 0.0);
    if (equation == 40)
        return vec4(facet_mirrored(first_three(a), first_three(b), first_three(c), a.w, d.x), 0.0, 0.0, 0.0);
    return vec4(quick_srgb_encoded(a.x), 0.0, 0.0, 0.0);
}
