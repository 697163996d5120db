// The light of a picture over packs: what light_pass.cpp hands to its arithmetic, as plain numbers. Camera space: right, up, along the
// axis, from the eye.
#pragma once

#include "scenarios/packs/level.h"

#include <cstdint>

namespace fernlicht::packs {

struct PassMaterial {
    float albedo[3], rl, rl_per_y, blend[3], emission[3], retro_reference, retro_inverse_falloff, tint[3], gloss, roughness;
    std::int32_t texture_mode; ///< -1: none
    bool retroreflecting, emissive, glossy;
};

/// Seen at (X, Y, 1) in the picture: tangents, of maps metres.
struct PassTriangle {
    float nearness[3];       ///< . (X, Y, 1): 1 / depth; of maps depth
    float nearest, farthest; ///< what the corners have of depth
    float normal[9];         ///< rows . (X, Y, 1): of any length
    const PassMaterial* material;
    std::int32_t mesh;
    bool flat; ///< one normal, of unit length
    bool ground, lit, shadowed;
};

/// Depth maps from one place or several, near / w as they are drawn.
struct PassShadow {
    float rows[16]; ///< camera space to x, y in the texture over w, w, and what a look-up is raised by
    float near, tolerance;
    std::int32_t width, height, layers;
    const float* shifts;               ///< of x and y, of each layer
    const float *depth, *target_depth; ///< rows from the lowest; for targets above surfaces
    float box[4];                      ///< in texels, low and high x, low and high y: look-ups beside it meet nothing
};

struct PassLamp {
    float position[3], right[3], up[3], forward[3], colour[3], factor, raise[3], raise_in_camera[3];
    float grid[4], count[2];
    bool steep;
    const float* cd; ///< with one column and one row more, which repeat the last
    const PassShadow* shadow;
};

struct PassPicture {
    std::int32_t width;
    double x_first, x_step, y_first, y_step; ///< X and Y of pixels' centres
    bool is_map;
    const std::int32_t* visible; ///< id and texel (8 bits each: r, g, b, a) of each pixel
    const PassLamp* lamps;
    std::int32_t lamp_count;
    const float* colour_of_all; ///< of lamps; nullptr: they differ
    float sky_lx, upwards[3];
    // What is wanted; nullptr: nothing of it.
    unsigned char* colour;
    float *illuminance, *target, *luminance, *light, *depth;
    std::int32_t* ids;
    unsigned char background[3]; ///< where nothing is seen
    float sky_luminance;
    std::int32_t tone_kind; ///< 0 linear, 1 rational, else logarithmic
    float tone_s, tone_l_max;
    const float* white_rows;                                    ///< of the eye's adaptation, three of three; nullptr: none
    const PassTriangle& (*triangle)(void* of, std::int32_t id); ///< until the next call
};

AT_EACH_LEVEL(void light_rows(const PassPicture& picture, void* triangles, std::int32_t first_row, std::int32_t end_row);)

/// What pixels asked for: additions, multiplications, comparisons and the like; divisions and square roots; look-ups of two neighbours.
struct PassCounts {
    long long operations, divisions, look_ups;
};
namespace counting {
/// light_rows over packs of one lane, so that each pixel asks for what it needs by itself. Some hundred times slower.
PassCounts count_rows(const PassPicture& picture, void* triangles, std::int32_t first_row, std::int32_t end_row);
} // namespace counting

} // namespace fernlicht::packs
