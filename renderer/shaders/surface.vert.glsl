// What a vertex of the scene brings along. One draw for many pieces: the instance carries the place of the piece's mesh.
layout(location = 0) in vec3 position_m; // relative to the mesh's origin
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;
layout(location = 3) in vec4 mesh_offset_m; // mesh origin relative to the car; w: mesh index + 1, of ground negative
layout(location = 4) in vec2 uv;
#include "turned.glsl"
#include "materials.glsl"
