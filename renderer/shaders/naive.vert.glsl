// The technique `photometric-naive`: everything that a fragment needs is computed there.
#include "surface.vert.glsl"

uniform mat4 clip_from_ego;

invariant gl_Position;
out vec3 v_position_m;
out vec3 v_normal;
out vec2 v_uv;
flat out uint v_material;
flat out uint v_mesh;

void main() {
    vec3 p = mesh_offset_m.xyz + turned(position_m);
    v_position_m = p;
    v_normal = turned(normal);
    v_uv = uv;
    v_material = material;
    v_mesh = uint(abs(mesh_offset_m.w));
    gl_Position = clip_from_ego * vec4(p, 1.0);
}
