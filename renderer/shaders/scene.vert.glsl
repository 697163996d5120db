// Scene geometry, positions relative to the ego car. One draw for all visible meshes: the instance carries the mesh's place.
layout(location = 0) in vec3 position_m; // relative to the mesh's origin
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;
layout(location = 3) in vec4 mesh_offset_m; // mesh origin relative to the car; w: mesh index + 1

uniform mat4 clip_from_ego;

invariant gl_Position;
out vec3 v_position_m;
out vec3 v_normal;
flat out uint v_material;
flat out uint v_mesh;

void main() {
    vec3 p = mesh_offset_m.xyz + position_m;
    v_position_m = p;
    v_normal = normal;
    v_material = material;
    v_mesh = uint(mesh_offset_m.w);
    gl_Position = clip_from_ego * vec4(p, 1.0);
}
