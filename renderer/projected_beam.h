// A beam as a texture that is projected into the scene from the lamp, as the founding thesis lit its roads: illuminance in lux on a
// grid in the lamp's tangent plane, and the matrices that put a point on it. It is the approximation, not the reference: how far it
// lies from the candela table is part of it.
// All lamps of a car in one projected texture, as the founding thesis proposes for less work in each pixel: one projection and one
// distance in place of one for each lamp.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/lamps/beam_texels.h"
#include "scenarios/lamps/candela_table.h"

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <span>

namespace fernlicht {

/// A frustum by its tangents in lamp space (x right, y up, z forward): left and right of x / z, bottom and top of y / z.
struct TangentWindow {
    double left = -1.4, right = 1.4, bottom = -0.45, top = 0.36;
};

/// Texel (i, k) stands at ((i + 0.5) / width, (k + 0.5) / height) of the window, as in an ordinary texture; rows from bottom to top.
/// Outside the window there is no light; in the half texel along its edges the outermost texel holds (clamp to edge).
struct ProjectedBeam {
    int width = 0, height = 0;
    TangentWindow window;
    double distance_m = 25.0;         ///< at which the lux hold, facing the lamp
    double scale_lx = 0.0;            ///< the largest value, that of the largest step
    int bits = 32;                    ///< of a texel: 8, 16 or 32
    std::vector<float> lx;            ///< empty with less than 32 bits
    std::vector<std::uint16_t> steps; ///< lx = step / largest_step(bits) * scale_lx; empty when float
    /// Against what the texture was made from, in shares of the largest illuminance met there, sampled on and between the texels of the
    /// window.
    double worst_error_of_peak = 0.0;

    std::size_t bytes() const { return (lx.size() + steps.size()) * static_cast<std::size_t>(bits / 8); }
};

/// The smallest window that holds all cells of the table with light in them, within 54 degrees left and right, 24 down and 20 up: what a
/// wider window gains at the sides it loses in texels on the road. A table without light there gives the whole of it.
TangentWindow lit_window(const CandelaTable& table);

/// E_m = I / 625 in lux at 25 m over lit_window(). The thesis had 512 x 128 in 8 bits. Width and height from 1 to 16384.
ProjectedBeam make_projected_beam(const CandelaTable& table, const BeamTexels& texels);

/// Bilinear by hand at s, t in 0..1 across and up the window; 0 outside.
double projected_lx(const ProjectedBeam& beam, double s, double t);

/// Lamp space to texture: (s, t, r, q) = B P (x, y, z, 1), s/q and t/q in 0..1 inside the window, q = z, r/q = 1 - near / z the depth with
/// near = 0.1 m. Only q > 0 is in front of the lamp.
glm::dmat4 texture_from_lamp(const TangentWindow& window);
/// The same as the thesis prints it, with q = 1 + z: too wide near the lamp (twice at 1 m, 4 % at 25 m), and points up to 1 m behind it
/// pass q > 0.
glm::dmat4 texture_from_lamp_as_printed(const TangentWindow& window);

/// A texture of any illuminance over a window, with its error; for beams that are not one table.
/// `illuminance_lx` gets the tangents x / z and y / z, is called from several threads, and its result is >= 0.
ProjectedBeam sampled_beam(const TangentWindow& window, const BeamTexels& texels,
                           const std::function<double(double, double)>& illuminance_lx);

/// The lamps that are on, in the frame of a pose.
std::vector<LitLamp> shining_in(const Pose& pose, std::span<const LitLamp> lamps);

/// Where the one lamp stands that stands for all that are on: midway between them (the mean of their positions), x forward along the mean
/// of their axes, upright as they are on average; in the frame of their poses. Not moved by lamps that are off. No lamp on: the origin.
/// Throws InputError where the axes cancel.
Pose merged_pose(std::span<const LitLamp> lamps);

/// The texture to project from merged_pose(): for each direction from there the sum of all lamps' facing illuminance at its point 25 m
/// away. With E = texel * 625 / d^2, d from the merged pose, it is exact at 25 m; nearer, the beams lie closer together than
/// in truth, farther away wider apart. Depends on where the lamps stand to each other, not on where the car is.
ProjectedBeam make_merged_beam(std::span<const LitLamp> lamps, const BeamTexels& texels);

} // namespace fernlicht
