// The triangle that a pixel shows, by its last corner, and the texel there: on a CPU device that is looked up in 8 bits and loses nothing.
layout(location = 0) out uvec2 out_visible;

flat in uint v_id;
#if TEXTURED
layout(binding = 15) uniform sampler2DArray surface_textures;
in vec2 v_uv;
flat in float v_layer;
#endif

void main() {
#if TEXTURED
    out_visible = uvec2(v_id, packUnorm4x8(texture(surface_textures, vec3(v_uv, v_layer))));
#else
    out_visible = uvec2(v_id, 0u);
#endif
}
