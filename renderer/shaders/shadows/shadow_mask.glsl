// Share of a lamp that a surface sees, decided before for each pixel of the view.
layout(binding = 8) uniform usampler2D shadow_mask; // bit i: the surface does not see lamp i; bit 8 + i: the target above it does not
uint hidden_lamps = texelFetch(shadow_mask, ivec2(gl_FragCoord.xy), 0).x;

#define SEEN(i, map) ((hidden_lamps & (1u << i)) != 0u ? 0.0 : 1.0)
#define SEEN_TARGET(i, map, w) ((hidden_lamps & (256u << i)) != 0u ? 0.0 : 1.0)
