// Lamps of others: any number, by lists. An entry names a unit (one lamp or two with one beam and one aim) and says how it is drawn.
// traffic_lights.h says how lists are made. Light below a lamp's least lux is left out by a ramp from 1 to 2 times it, so that nothing pops.
// All of it is read by texel fetches: on llvmpipe these are a vector's loads, while storage blocks are read lane by lane.
struct TrafficUnit {
    vec4 position_m; // midway between the lamps, relative to the car; w: least lux
    vec4 forward;    // w: intensity factor of all lamps together
    vec4 up;         // w: where the beam's samples begin
    vec4 apart_m;    // from the middle to the second lamp, 0 for one lamp; w: samples across
    vec4 colour;     // linear sRGB, luminance 1; w: samples up
    vec4 grid;       // first H, first V, 1 / step H, 1 / step V
};

layout(binding = 18) uniform samplerBuffer traffic_units;   // as above
layout(binding = 19) uniform samplerBuffer traffic_entries; // unit, weight of each lamp, of one for all, candela (below 0: by the beam; below -1: with maps, see traffic_left())
layout(binding = 20) uniform samplerBuffer traffic_cd;
layout(binding = 21) uniform samplerBuffer traffic_cells; // first entry, entries

TrafficUnit traffic_unit(int i) {
    TrafficUnit unit;
    unit.position_m = texelFetch(traffic_units, 6 * i);
    unit.forward = texelFetch(traffic_units, 6 * i + 1);
    unit.up = texelFetch(traffic_units, 6 * i + 2);
    unit.apart_m = texelFetch(traffic_units, 6 * i + 3);
    unit.colour = texelFetch(traffic_units, 6 * i + 4);
    unit.grid = texelFetch(traffic_units, 6 * i + 5);
    return unit;
}

// Of an entry's lamps: 0 and 1 each lamp, 2 one for all.
int first_traffic_lamp(vec4 entry) { return entry.y > 0.0 ? 0 : 2; }
int end_of_traffic_lamps(vec4 entry) { return entry.z > 0.0 ? 3 : 2; }

vec3 traffic_place(TrafficUnit unit, int lamp) {
    return unit.position_m.xyz + (lamp == 2 ? 0.0 : 2.0 * float(lamp) - 1.0) * unit.apart_m.xyz;
}

float traffic_intensity(TrafficUnit unit, vec3 w, float inverse_d) {
    vec2 count = vec2(unit.apart_m.w, unit.colour.w);
    vec2 at = beam_position(quick_goniometer_angles(w, inverse_d, true), unit.grid);
    float known = w.z > 0.0 ? beam_known(at, count) : 0.0;
    vec2 base = clamp(floor(at), vec2(0.0), count - 2.0);
    int first = int(unit.up.w) + int(base.y) * int(count.x) + int(base.x);
    int above = first + int(count.x);
    float cd = bilinear(texelFetch(traffic_cd, first).x, texelFetch(traffic_cd, first + 1).x, texelFetch(traffic_cd, above).x,
                        texelFetch(traffic_cd, above + 1).x, at - base);
    return known > 0.0 ? cd : 0.0;
}

// lx on a surface with this unit normal, v from the lamp to it; e_perp: facing the lamp; whole: without ramp and weights.
float traffic_lx(TrafficUnit unit, vec4 entry, int lamp, vec3 v, vec3 n, OUT(float) e_perp, OUT(float) whole) {
    float share = lamp == 2 ? 1.0 : 0.5; // of intensity and of least lux
    float inverse_d = inversesqrt(max(dot(v, v), 1e-6));
    float cosine = max(-dot(n, v) * inverse_d, 0.0);
    vec3 w = lamp_space(v, cross(unit.forward.xyz, unit.up.xyz), unit.up.xyz, unit.forward.xyz);
    float cd = entry.w >= 0.0 ? (w.z > 0.0 ? entry.w : 0.0) : traffic_intensity(unit, w, inverse_d) * (share * unit.forward.w);
    float facing = facing_illuminance_at(cd, inverse_d);
#if FOG
    facing *= transmittance(TRAFFIC_EXTINCTION, 1.0 / inverse_d);
#endif
    float e = facing * cosine, least = share * unit.position_m.w;
    float kept = (lamp == 2 ? entry.z : entry.y) * clamp((e - least) / least, 0.0, 1.0);
    e_perp = facing * kept;
    whole = e;
    return e * kept;
}
