// Light of others' lamps that the air turns towards the eye (lamps_seen.h says what is left out). v_air: eye, number of lamps; v_air_min_cdm2.
struct AirLamp {
    vec4 position_m; // relative to the car; w: most candela
    vec4 right;
    vec4 up;
    vec4 forward;
    vec4 colour; // linear sRGB, luminance 1; w: intensity factor
    vec4 grid;   // first H, first V, 1 / step H, 1 / step V
    vec4 beam;   // where its samples begin, samples across, up
};

layout(std430, binding = 6) readonly buffer LampsInFogBlock { AirLamp lamps_in_fog[]; };
layout(std430, binding = 7) readonly buffer AirBeams { float air_cd[]; };

// Candela towards a unit vector in lamp space.
float air_intensity(int i, vec3 w) {
    vec4 beam = lamps_in_fog[i].beam;
    vec2 at = beam_position(quick_goniometer_angles(w, 1.0, true), lamps_in_fog[i].grid);
    float known = w.z > 0.0 ? beam_known(at, beam.yz) : 0.0;
    vec2 base = clamp(floor(at), vec2(0.0), beam.yz - 2.0);
    int first = int(beam.x) + int(base.y) * int(beam.y) + int(base.x);
    int above = first + int(beam.y);
    float cd = bilinear(air_cd[first], air_cd[first + 1], air_cd[above], air_cd[above + 1], at - base);
    return known > 0.0 ? cd * lamps_in_fog[i].colour.w : 0.0;
}

// cd/m2 by one lamp along a ray of unit direction from the eye.
float air_light_of(int i, vec3 eye, vec3 along_world, float way) {
    AirLamp lamp = lamps_in_fog[i];
    vec3 e = lamp_space(eye - lamp.position_m.xyz, lamp.right.xyz, lamp.up.xyz, lamp.forward.xyz);
    vec3 along = lamp_space(along_world, lamp.right.xyz, lamp.up.xyz, lamp.forward.xyz);
    float begin = e.z > 0.0 ? 0.0 : (along.z > 0.0 ? -e.z / along.z : way); // only what lies before the lamp is lit
    float end = along.z < 0.0 ? min(way, -e.z / along.z) : way;
    if (end <= begin)
        return 0.0;
    float nearest_along = -dot(e, along);
    vec3 nearest = e + nearest_along * along;
    float apart = max(length(nearest), 1e-3);
    nearest /= apart;
    float first = atan((begin - nearest_along) / apart);
    float last = atan((end - nearest_along) / apart);
    float scale = v_fog.z * (last - first) / apart;
#if AIR_BOUND
    float most = scale * lamp.position_m.w * henyey_greenstein(-sin(first), v_fog.w) * transmittance(v_fog.x, length(e));
    if (most * 1.1 <= v_air_min_cdm2)
        return 0.0;
#endif
    PRECISE float sum = 0.0;
    for (int k = 0; k < FOG_SAMPLES; ++k) {
        float x = 1.0 - (float(k) + 0.5) / float(FOG_SAMPLES);
        float angle = last - (last - first) * x * sqrt(x);
        float s = sin(angle);
        float c = max(cos(angle), 1e-6);
        sum += sqrt(x) * scattered_towards_eye(air_intensity(i, nearest * c + along * s), s, c, apart, nearest_along, v_fog.x, v_fog.w);
    }
    PRECISE float cdm2 = sum * (1.5 / float(FOG_SAMPLES)) * scale;
    return cdm2 * clamp((cdm2 - v_air_min_cdm2) / v_air_min_cdm2, 0.0, 1.0);
}

vec3 air_light_of_others() {
    PRECISE vec3 sum = vec3(0.0);
    if (v_fog.z <= 0.0)
        return sum;
    float way = length(v_from_eye);
    vec3 along = v_from_eye / way;
    for (int i = 0; i < int(v_air.w); ++i)
        sum += lamps_in_fog[i].colour.rgb * air_light_of(i, v_air.xyz, along, way);
    return sum;
}
