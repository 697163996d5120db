// The luminous face of a lamp as the eye sees it: a rectangle in the picture, one pixel larger on each side.
struct Face {
    vec4 place_px; // middle, width, height
    vec4 light;    // colour times luminance, cd/m2; w: depth
};
layout(std430, binding = 6) readonly buffer Faces { Face faces[]; };
uniform vec2 picture_px;

out vec2 v_px;
flat out vec4 v_place_px;
flat out vec3 v_light;

void main() {
    Face face = faces[gl_InstanceID];
    vec2 corner = vec2((gl_VertexID & 1) != 0 ? 0.5 : -0.5, (gl_VertexID & 2) != 0 ? 0.5 : -0.5);
    v_px = face.place_px.xy + corner * (face.place_px.zw + 2.0);
    v_place_px = face.place_px;
    v_light = face.light.rgb;
    gl_Position = vec4(v_px / picture_px * 2.0 - 1.0, face.light.w, 1.0);
}
