// Where what one picture shows is seen in the next, estimated from the pictures alone: for frames whose geometry is not known. Where depth
// and the camera's path are known, motion by them is exact and better (runner/experiments/aliasing/motion.h).
#pragma once

#include "scenarios/values/image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fernlicht {

/// What pixel (x, y) of one picture shows is seen at (x + dx, y + dy) of the other.
struct Flow {
    Image<float> dx_px, dy_px;
};

enum class FlowMethod : std::uint8_t {
    dis,      ///< dense inverse search (Kroeger, Timofte, Dai, Van Gool 2016) with variational refinement
    farneback ///< polynomial expansion (Farnebäck 2003)
};

/// By OpenCV; its number of threads changes no bit (its dense inverse search cuts pictures into eight stripes whatever it is). `from` and
/// `to` are luminances in cd/m2, at least 0; both are told apart by ratio rather than difference, as eyes do: log(1 + L / 0.005 cd/m2), the
/// brightest of both as 255. Throws std::invalid_argument unless both have one size of at least 32 x 32 pixels and values that are finite.
Flow optical_flow(const Image<float>& from, const Image<float>& to, FlowMethod method = FlowMethod::dis);

/// 1 where going there and back ends within `most_px` of the start; 0 where it does not, or leaves the picture: hidden in one of them, or
/// not to be found. Throws std::invalid_argument for sizes that differ.
Image<std::uint8_t> found_again(const Flow& there, const Flow& back, double most_px);

/// 1 where a picture has contrast in two directions, without which no motion can be told: the smaller eigenvalue of its structure tensor
/// over 9 x 9 pixels (Shi and Tomasi 1994) is above four times what rounding to the 8 bits that the search sees puts there, and the
/// picture's own rounding: `step_cdm2`, the size of one step at each pixel, as large as the picture; empty where it is not rounded. Same
/// demands on the picture as of optical_flow(), and std::invalid_argument for steps of another size.
Image<std::uint8_t> has_contrast(const Image<float>& picture, const Image<float>& step_cdm2 = {});

/// Between pixels' centres, linear; (x, y) are pixels with centres at whole numbers, clamped to the picture.
double between_pixels(const Image<float>& picture, double x, double y);

/// How far an estimated flow is off one that is known.
struct FlowError {
    std::size_t points = 0;        ///< that are known, seen in both pictures
    double left_out_percent = 0.0; ///< of them, those that found_again() leaves out; the rest below is of those it keeps
    double mean_px = 0.0;          ///< end-point error
    double median_px = 0.0;        ///<
    double far_percent = 0.0;      ///< off by more than half a pixel
    double known_motion_px = 0.0;  ///< median length of what is known, to hold the error against
};

/// An estimate, where found_again() keeps it, and what is known of it where that is 1; all of one size.
struct FlowPair {
    Flow estimated;
    Image<std::uint8_t> kept;
    Flow known;
    Image<std::uint8_t> known_at;
};

/// Over all pairs. Throws std::invalid_argument for sizes that differ.
FlowError flow_error(const std::vector<FlowPair>& pairs);

} // namespace fernlicht
