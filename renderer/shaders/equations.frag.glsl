// One equation at many points: a fragment takes its 16 arguments from a list. EQUATION is its number in equation_calls.glsl.
#include "photometry.glsl"

#include "equation_calls.glsl"

layout(std430, binding = 0) readonly buffer Arguments { vec4 arguments[]; };
uniform int row_length;
layout(location = 0) out vec4 value;

void main() {
    int point = 4 * (int(gl_FragCoord.y) * row_length + int(gl_FragCoord.x));
    value = equation_value(EQUATION, arguments[point], arguments[point + 1], arguments[point + 2], arguments[point + 3]);
}
