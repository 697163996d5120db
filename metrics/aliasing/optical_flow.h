// Where what one picture shows is seen in the next, estimated from the pictures alone: for frames whose geometry is not known. Where depth
// and the camera's path are known, motion by them is exact and better (runner/experiments/aliasing/motion.h).
// Points of a scene followed through a sequence of pictures by optical flow.
#pragma once

#include "metrics/aliasing/temporal_aliasing.h"
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

/// 1 where going there and back ends within `max_px` of the start; 0 where it does not, or leaves the picture: hidden in one of them, or
/// not to be found. Throws std::invalid_argument for sizes that differ.
Image<std::uint8_t> found_again(const Flow& there, const Flow& back, double max_px);

/// 1 where a picture has contrast in two directions, without which no motion can be told: the smaller eigenvalue of its structure tensor
/// over 9 x 9 pixels (Shi and Tomasi 1994) is above four times what rounding to the 8 bits that the search sees puts there, and the
/// picture's own rounding: `step_cdm2`, the size of one step at each pixel, as large as the picture; empty where it is not rounded. Same
/// demands on the picture as of optical_flow(), and std::invalid_argument for steps of another size.
Image<std::uint8_t> has_contrast(const Image<float>& picture, const Image<float>& step_cdm2 = {});

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

/// Pixels with centres at whole numbers.
struct Place {
    double x = 0.0, y = 0.0;
};
/// Where a point is seen in each picture.
using Path = std::vector<Place>;

struct FlowPaths {
    std::vector<Path> paths;
    std::size_t started = 0;       ///< points that were to be followed
    std::size_t flat = 0;          ///< of them, those without contrast, which cannot be
    double median_motion_px = 0.0; ///< from one picture to the next, of the points followed
    double median_return_px = 0.0; ///< how far from the start going there and back ends, of the same
};

/// How far going there and back may end from the start.
inline constexpr double max_return_px = 0.5;

/// Every `stride`-th pixel each way of picture `from`, followed from one picture to the next in both directions of time. Left out is what
/// has_contrast() does not tell in picture `from`, which was rounded by `step_cdm2`, what found_again() does not find within max_return_px
/// at any step, and what leaves the picture: dark, hidden or wrong. Errors of the steps add up along a path. Throws std::invalid_argument
/// as optical_flow() and for `from` beyond the pictures.
FlowPaths paths_by_flow(const std::vector<Image<float>>& pictures, std::size_t from, int stride, FlowMethod method = FlowMethod::dis,
                        const Image<float>& step_cdm2 = {});

/// The pixels nearest to a path's places in pictures of that size, which it stays in.
PixelTrack track_of(const Path& path, int width, int height);

/// Brightness along each path at its places between pixels, by a sinc under a Hann window of 8 pixels to each side, which is within 1 % of
/// what a picture holds up to 0.4 cycles per pixel; the level is the r.m.s. over the 33 x 33 pixels around. Beyond its edges a picture is
/// mirrored. Paths have as many places as there are pictures, within them.
std::vector<TrackSamples> samples_along(const std::vector<Path>& paths, const std::vector<Image<float>>& pictures);

} // namespace fernlicht
