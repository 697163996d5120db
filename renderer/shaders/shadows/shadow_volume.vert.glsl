// Hulls of what lies in shadow. A corner with w = 0 is that with w = 1 moved away from the lamp to infinity.
layout(location = 0) in vec4 corner; // in its body's frame

uniform mat4 clip_from_ego;
uniform vec3 offset_m; // of the body's frame from the car
uniform vec4 turn;     // quaternion
uniform vec3 lamp_m;
uniform vec3 gap;      // metres and share of the distance by which a shadow begins behind its caster; how much lower all of it lies
uniform float farthest; // w of far corners: 0 is infinity, which a map has no place for

void main() {
    vec3 p = corner.xyz + 2.0 * cross(turn.xyz, cross(turn.xyz, corner.xyz) + turn.w * corner.xyz) + offset_m;
    vec3 away = p - lamp_m;
    float distance_m = max(length(away), 1e-6);
    vec4 place = corner.w > 0.5 ? vec4(p + away * (gap.x / distance_m + gap.y), 1.0) : vec4(away + farthest * p, farthest);
    place.z -= gap.z * place.w;
    gl_Position = clip_from_ego * place;
}
