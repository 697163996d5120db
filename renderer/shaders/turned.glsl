// A vector of a mesh as its body stands, where bodies move.
#ifdef MOVING
layout(location = 5) in vec4 body_turn; // quaternion; 0 0 0 1 for what stands in the world, to the bit
vec3 turned(vec3 v) { return v + 2.0 * cross(body_turn.xyz, cross(body_turn.xyz, v) + body_turn.w * v); }
#else
vec3 turned(vec3 v) { return v; }
#endif
