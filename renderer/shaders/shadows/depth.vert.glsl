// Shadow maps: depth only.
layout(location = 0) in vec3 position_m;
layout(location = 3) in vec4 mesh_offset_m;
#ifdef MOVING
layout(location = 5) in vec4 body_turn;
vec3 turned(vec3 v) { return v + 2.0 * cross(body_turn.xyz, cross(body_turn.xyz, v) + body_turn.w * v); }
#else
vec3 turned(vec3 v) { return v; }
#endif

uniform mat4 clip_from_ego;

invariant gl_Position;

void main() {
    gl_Position = clip_from_ego * vec4(mesh_offset_m.xyz + turned(position_m), 1.0);
}
