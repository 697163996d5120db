// What drawing one view of one moment gives. A picture that was not asked for is empty.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/values/image.h"

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

struct Rgb8 {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Rgb8&) const = default;
};

struct FrameOutputs {
    bool colour = false, illuminance = false, target = false, luminance = false, light = false, depth = false, ids = false;
    bool seen() const { return colour || luminance || light; } ///< anything that an eye sees
    bool operator==(const FrameOutputs&) const = default;
};

struct Frame {
    Image<Rgb8> colour;          ///< tone-mapped, sRGB-encoded
    Image<float> illuminance_lx; ///< on the surface seen in the pixel, all lamps and sky; 0 where nothing is seen
    Image<float> target_lx; ///< of a target at the pixel's place (raised by the view's target height) that faces each lamp: sum of I / d^2
    Image<float> luminance_cdm2; ///< towards the camera
    Image<glm::vec3> light;      ///< the luminance with its colour: linear in sRGB's primaries, Y in cd/m2, towards the camera
    Image<float> depth_m;        ///< distance from the camera along its axis; 0: nothing
    Image<std::uint32_t> ids;    ///< mesh index + 1; 0: nothing
    double cpu_s = 0.0;          ///< submit to finish
    std::vector<std::pair<std::string, double>> pass_s; ///< seconds by pass, where passes were timed
};

/// A frame on its way; call it once to wait for the pixels.
using Pending = std::function<Frame()>;

} // namespace fernlicht
