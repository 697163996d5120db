// Of the scene, as scene_buffers.cpp packs them.
struct Material {
    vec4 albedo;   // w: retro_rl
    vec4 emission; // cd/m2; w: texture layer
    vec4 retro;    // reference angle, 1 / fall-off, texture mode (0: none); w: 1 where it gets wet
    vec4 blend;
    vec4 tint; // of retroreflected light
    vec4 gloss; // share, roughness, retroreflection left under water
};

layout(std430, binding = 1) readonly buffer Materials { Material materials[]; };
