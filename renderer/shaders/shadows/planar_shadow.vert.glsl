// Casters flattened onto a plane by a lamp's light, in a view. Only what lies between plane and lamp is left.
layout(location = 0) in vec3 position_m;
layout(location = 3) in vec4 mesh_offset_m;
#include "turned.glsl"

uniform mat4 clip_from_ego; // lowered by a target's height
uniform vec4 plane;         // unit normal; -normal . place: heights above it are dot(plane, (p, 1))
uniform vec3 lamp_m;

out float gl_ClipDistance[2];

void main() {
    vec3 p = mesh_offset_m.xyz + turned(position_m);
    float height = dot(plane.xyz, p) + plane.w;
    float lamp_height = dot(plane.xyz, lamp_m) + plane.w;
    // L + (P - L) h_L / (h_L - h_P), without the division.
    gl_Position = clip_from_ego * vec4(lamp_height * p - height * lamp_m, lamp_height - height);
    gl_ClipDistance[0] = lamp_height - height - 1e-4; // as high as the lamp: its shadow ends at infinity
    gl_ClipDistance[1] = height;                      // below the plane nothing casts
}
