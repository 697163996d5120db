// The lamps of a moment: their beam textures, shadow maps, and what reaches a point.
#include "photometry.glsl"

#if LAMP_COUNT > 0

struct Lamp {
    vec4 position_m;  // relative to the car
    vec4 right;       // axes of lamp space
    vec4 up;
    vec4 forward;
    vec4 grid;        // first H, first V, 1 / step H, 1 / step V (beam_position)
    vec4 count;       // texels across, up; intensity factor; shadow map: 1 if there is one
    vec4 colour;      // linear sRGB, luminance 1
    vec4 shadow;      // tangent window: first x, first y, texels per unit x, texels per unit y
};

layout(std140, binding = 0) uniform Lamps { Lamp lamps[LAMP_COUNT]; };

layout(binding = 0) uniform sampler2D beams[LAMP_COUNT]; // candela

#if SHADOWS
layout(binding = 8) uniform sampler2D shadow_maps[LAMP_COUNT]; // shadow_near_m / distance along the axis; 0: nothing

uniform float shadow_tolerance_m;
const float shadow_near_m = 0.05; // as in lamp_lights.cpp

// 1 where the shadow map's texel sees nothing above the point's tangent plane, else 0. See height_above_plane.
float texel_lit(Lamp lamp, sampler2D map, ivec2 texel, vec3 point, vec3 normal) {
    float inverse_z = texelFetch(map, texel, 0).r / shadow_near_m;
    if (inverse_z <= 0.0)
        return 1.0;
    vec2 ray = (vec2(texel) + 0.5) / lamp.shadow.zw + lamp.shadow.xy;
    vec3 occluder = lamp.position_m.xyz + (lamp.right.xyz * ray.x + lamp.up.xyz * ray.y + lamp.forward.xyz) / inverse_z;
    return height_above_plane(occluder, point, normal) > shadow_tolerance_m ? 0.0 : 1.0;
}

// Share of the lamp that is seen from the point: four texels, weighted. Outside the map nothing is known to stand in the way.
float visibility(Lamp lamp, sampler2D map, vec3 w, vec3 point, vec3 normal) {
    vec2 at = (w.xy / w.z - lamp.shadow.xy) * lamp.shadow.zw - 0.5;
    ivec2 size = textureSize(map, 0);
    if (at.x < 0.0 || at.y < 0.0 || at.x >= float(size.x - 1) || at.y >= float(size.y - 1))
        return 1.0;
    ivec2 base = ivec2(at);
    vec2 f = at - vec2(base);
    return bilinear(texel_lit(lamp, map, base, point, normal), texel_lit(lamp, map, base + ivec2(1, 0), point, normal),
                    texel_lit(lamp, map, base + ivec2(0, 1), point, normal), texel_lit(lamp, map, base + ivec2(1, 1), point, normal), f);
}
#endif

// Candela towards w (lamp space); 0 behind the lamp and outside its table.
float intensity_towards(Lamp lamp, sampler2D beam, vec3 w) {
    if (w.z <= 0.0)
        return 0.0;
    vec2 position = beam_position(goniometer_angles(w), lamp.grid);
    if (beam_known(position, lamp.count.xy) == 0.0)
        return 0.0;
    ivec2 base = min(ivec2(position), ivec2(lamp.count.xy) - 2);
    vec2 f = position - vec2(base);
    return lamp.count.z * bilinear(texelFetch(beam, base, 0).r, texelFetch(beam, base + ivec2(1, 0), 0).r, texelFetch(beam, base + ivec2(0, 1), 0).r,
                                   texelFetch(beam, base + ivec2(1, 1), 0).r, f);
}

#endif
