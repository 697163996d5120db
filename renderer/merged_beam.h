// All lamps of a car in one projected texture, as the founding thesis proposes for less work in each pixel: one projection and one
// distance in place of one for each lamp.
#pragma once

#include "renderer/projected_beam.h"
#include "scenarios/drives/play/moment.h"

#include <span>

namespace fernlicht {

/// Where the one lamp stands that stands for all that are on: midway between them (the mean of their positions), x forward along the mean
/// of their axes, upright as they are on average; in the frame of their poses. Not moved by lamps that are off. No lamp on: the origin.
/// Throws InputError where the axes cancel.
Pose merged_pose(std::span<const LitLamp> lamps);

/// The texture to project from merged_pose(): for each direction from there the sum of all lamps' facing illuminance at its point 25 m
/// away. With E = texel * 625 / d^2, d from the merged pose, it is exact at 25 m; nearer, the beams lie closer together than
/// in truth, farther away wider apart. Depends on where the lamps stand to each other, not on where the car is.
ProjectedBeam make_merged_beam(std::span<const LitLamp> lamps, const BeamTexels& texels);

} // namespace fernlicht
