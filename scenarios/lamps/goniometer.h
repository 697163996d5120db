// From other systems of angles to the UN goniometer's H = atan2(x, z), V = asin(y), by resampling with a bounded error.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/lamps/measured_grid.h"

#include <cstddef>
#include <glm/vec3.hpp>

namespace fernlicht {

/// Unit vector: x right, y up, z forward.
glm::dvec3 direction_of(double h_deg, double v_deg);

/// IES type B, horizontal polar axis: h = asin(x), v = atan2(y, z).
AngleSystem type_b();
/// Angles as read off a flat screen square to the axis: h = atan(x / z), v = atan(y / z).
AngleSystem flat_screen();
/// C planes about a beam that points along the luminaire's gamma = 0, here forward: h = -C, v = gamma - 90, C 0 to the right, C 90 up,
/// as a plan view of the luminaire is read.
AngleSystem beam_along_nadir();

/// Most samples of a table brought onto H and V. Set to fewer where many files are read for their form alone (tests/fuzz).
inline std::size_t most_resampled = 500'000;

/// Sets lamp.measured to the table `native` over the angles of `system`, and lamp.table to the same brought onto H and V. The axes hold the
/// native angles, the peak's direction, and as many more as bring the difference between the two tables below 0.1 % of the peak, up to
/// `most_resampled` samples. Of the cells in which the native data end, at most 0.1 degrees wide where the samples suffice, as many are
/// data as hold the light of those parts that have data: the flux stays, and the border runs to the cell. The others are gaps. Adds a note
/// with the size and the worst difference found by probing.
void bring_onto_goniometer(CandelaTable native, AngleSystem system, LampFile& lamp);

/// Type C photometry (IES type C, EULUMDAT), half planes C about the vertical, gamma from the nadir up: how the planes that a file stores
/// stand for the whole turn.
enum class PlaneSymmetry { none, rotational, about_c0_c180, about_c90_c270, quadrants };

/// `planes`: h_deg = C (any turn), v_deg = gamma, 0..180, in order. C grows against the clock, seen from above (LM-63, CIE 121).
/// Axis horizontal: the horizon is gamma 90, and forward is the plane, out of 0, 90, 180 and 270, nearest to the mean direction of the
/// light. Axis nadir: forward is gamma 0, C 0 to the right, C 90 up. Automatic: nadir when the mean direction of the light (the
/// integral of I times the unit vector) lies within 45 degrees of gamma 0, else horizontal. Notes say which, and why.
/// Planes that end short of the whole turn are joined when the hole is at most 1.5 steps wide; a wider hole has no data.
void from_c_planes(const MeasuredGrid& planes, PlaneSymmetry symmetry, const LampReadOptions& options, LampFile& lamp);

} // namespace fernlicht
