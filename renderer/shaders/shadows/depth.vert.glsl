// Shadow maps: depth only.
layout(location = 0) in vec3 position_m;
layout(location = 3) in vec4 mesh_offset_m;
#include "turned.glsl"

uniform mat4 clip_from_ego;

invariant gl_Position;

void main() {
    gl_Position = clip_from_ego * vec4(mesh_offset_m.xyz + turned(position_m), 1.0);
}
