// What is visible, for the CPU to light (light_pass/): pieces drawn from numbered lists (draw_list.h).
#include "surface.vert.glsl"

uniform mat4 clip_from_ego;

invariant gl_Position;

flat out uint v_id;
#if TEXTURED
out vec2 v_uv;
flat out float v_layer;
#endif

void main() {
    v_id = uint(int(mesh_offset_m.w) + gl_VertexID);
#if TEXTURED
    v_uv = uv;
    v_layer = materials[material].emission.w;
#endif
    gl_Position = clip_from_ego * vec4(mesh_offset_m.xyz + turned(position_m), 1.0);
}
