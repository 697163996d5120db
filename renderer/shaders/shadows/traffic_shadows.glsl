// Share of a lamp of others that a surface sees, by a depth map for each lamp. traffic_shadows.h says which have one.
layout(binding = 22) uniform sampler2DArrayShadow traffic_shadow; // TRAFFIC_SHADOW_NEAR / distance along the axis; 0: nothing
// Of each map: rows that bring a place relative to the car to (texture coordinates, 1) times the distance along the axis; then what a
// look-up is raised by over that distance, the layer, and how much of its shadow is drawn.
layout(binding = 23) uniform samplerBuffer traffic_maps;

float traffic_row(vec4 row, vec3 p) { return dot(row.xyz, p) + row.w; }

// Weighted: what is not seen of the lamp, times how much of its shadow is drawn. Outside the map nothing is known to stand in the way.
float traffic_hidden(int map, vec3 p, vec3 n, float share) {
    vec4 axis = texelFetch(traffic_maps, 4 * map + 2);
    vec4 more = texelFetch(traffic_maps, 4 * map + 3);
    // Raised above the surface by what a texel spans there, but for level ground: see docs/decisions/0005 and 0011.
    vec3 raised = p + n * share * max(TRAFFIC_SHADOW_TOLERANCE, more.x * traffic_row(axis, p));
    float z = max(traffic_row(axis, raised), TRAFFIC_SHADOW_NEAR);
    vec2 at = vec2(traffic_row(texelFetch(traffic_maps, 4 * map), raised), traffic_row(texelFetch(traffic_maps, 4 * map + 1), raised)) / z;
    float seen = textureGrad(traffic_shadow, vec4(at, more.y, TRAFFIC_SHADOW_NEAR / z), vec2(0.0), vec2(0.0));
    return more.z * (1.0 - seen);
}

// What is left of the light of one lamp of an entry: e, lx, without the shadow. A lamp that stands for two is hidden as far as these are.
// No branches: llvmpipe would compute both sides; a loop it leaves where no fragment needs the second map.
float traffic_left(TrafficUnit unit, vec4 entry, int lamp, vec3 p, vec3 n, float e) {
    bool casts = entry.w < -1.5;
    int code = casts ? int(-entry.w) - 2 : 0;
    bool two = (code & 1) == 1;
    int first = code / 2 + (two && lamp == 1 ? 1 : 0);
    int last = first + (two && lamp == 2 ? 1 : 0);
    float hidden = 0.0, raised = 1.0 - v_level * inversesqrt(dot(v_traffic_n, v_traffic_n));
    int map = first;
    do {
        hidden += traffic_hidden(map, p, n, raised);
        ++map;
    } while (map <= last);
    float least = (lamp == 2 ? 1.0 : 0.5) * TRAFFIC_SHADOW_LEAST * unit.position_m.w;
    float share = casts ? clamp((e - least) / least, 0.0, 1.0) / float(map - first) : 0.0;
    return 1.0 - hidden * share;
}
