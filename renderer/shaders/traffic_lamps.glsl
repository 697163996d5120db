// Lamps of others: any number, by lists. An entry names a lamp, its weight, and where it is drawn as a point its intensity.
// traffic_lights.h says how lists are made. Light below a lamp's least lux is left out by a ramp from 1 to 2 times it, so that nothing pops.
struct TrafficLamp {
    vec4 position_m; // relative to the car; w: least lux
    vec4 right;
    vec4 up;
    vec4 forward;
    vec4 colour; // linear sRGB, luminance 1; w: intensity factor
    vec4 grid;   // first H, first V, 1 / step H, 1 / step V
    vec4 beam;   // where its samples begin, samples across, up
};

layout(std430, binding = 2) readonly buffer TrafficLamps { TrafficLamp traffic_lamps[]; };
layout(std430, binding = 3) readonly buffer TrafficEntries { vec4 traffic_entries[]; }; // lamp, weight, candela (below 0: by the beam)
layout(std430, binding = 4) readonly buffer TrafficBeams { float traffic_cd[]; };
layout(std430, binding = 5) readonly buffer TrafficCells { uvec2 traffic_cells[]; };

float traffic_intensity(int i, vec3 w, float inverse_d) {
    vec4 beam = traffic_lamps[i].beam;
    vec2 at = beam_position(quick_goniometer_angles(w, inverse_d, true), traffic_lamps[i].grid);
    float known = w.z > 0.0 ? beam_known(at, beam.yz) : 0.0;
    vec2 base = clamp(floor(at), vec2(0.0), beam.yz - 2.0);
    int first = int(beam.x) + int(base.y) * int(beam.y) + int(base.x);
    int above = first + int(beam.y);
    float cd = bilinear(traffic_cd[first], traffic_cd[first + 1], traffic_cd[above], traffic_cd[above + 1], at - base);
    return known > 0.0 ? cd * traffic_lamps[i].colour.w : 0.0;
}

// lx on a surface with this unit normal; e_perp: facing the lamp.
float traffic_lx(vec4 entry, vec3 p, vec3 n, OUT(float) e_perp) {
    int i = int(entry.x);
    vec3 v = p - traffic_lamps[i].position_m.xyz;
    float inverse_d = inversesqrt(max(dot(v, v), 1e-6));
    float cosine = max(-dot(n, v) * inverse_d, 0.0);
    vec3 w = lamp_space(v, traffic_lamps[i].right.xyz, traffic_lamps[i].up.xyz, traffic_lamps[i].forward.xyz);
    float cd = entry.z >= 0.0 ? (w.z > 0.0 ? entry.z : 0.0) : traffic_intensity(i, w, inverse_d);
    float facing = facing_illuminance_at(cd, inverse_d);
#if FOG
    facing *= transmittance(TRAFFIC_EXTINCTION, 1.0 / inverse_d);
#endif
    float e = facing * cosine, least = traffic_lamps[i].position_m.w;
    float kept = entry.y * clamp((e - least) / least, 0.0, 1.0);
    e_perp = facing * kept;
    return e * kept;
}
