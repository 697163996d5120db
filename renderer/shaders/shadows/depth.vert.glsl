// Shadow maps: depth only.
layout(location = 0) in vec3 position_m;
layout(location = 3) in vec4 mesh_offset_m;
#include "turned.glsl"

uniform mat4 clip_from_ego;
uniform float ground_lowered; // over the distance along the light's axis: see docs/decisions/0011

invariant gl_Position;

void main() {
    vec4 place = clip_from_ego * vec4(mesh_offset_m.xyz + turned(position_m), 1.0);
    gl_Position = mesh_offset_m.w < 0.0 ? place - clip_from_ego[2] * (ground_lowered * place.w) : place;
}
