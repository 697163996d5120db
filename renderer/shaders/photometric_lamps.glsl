// The lamps of a moment. Their beams' grids are constants of the variant (BEAM_*), since a beam does not change while a lamp moves.
#include "photometry.glsl"

#if LAMP_COUNT > 0

struct Lamp {
    vec4 position_m; // relative to the car
    vec4 right;      // axes of lamp space
    vec4 up;
    vec4 forward;
    vec4 colour; // linear sRGB, luminance 1; w: intensity factor, 0 for a lamp that is off
    vec4 eye;    // in lamp space; w: 1 a place, 0 (maps) a direction
    vec4 raise;  // from a point to the target above it, in lamp space
};

layout(std140, binding = 0) uniform Lamps { Lamp lamps[LAMP_COUNT]; };

#endif
