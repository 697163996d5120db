// The figures of report.html as SVG, ready to stand in the page.
#pragma once

#include "runner/experiments/run/page_parts.h"
#include "runner/write/plots/svg.h"

namespace fernlicht {

/// Lux on the road from above, ahead to the right: false colours on one fixed logarithmic scale (0.1 to 100 lx, so that any two maps
/// compare), isolux lines at 1, 3, 5, 10, 30 and 50 lx, lane and road edges, metres from the car's origin. "" for an empty map.
std::string lux_map_svg(const LuxMap& map, const std::string& lamp);

/// A map's lanes and the car as lines, in one colour.
void add_edges(plots::Figure& figure, const LuxMap& map, plots::Colour colour);

/// Reach in the own lane over the drive, by distance or, where the car stands still or moves on springs, by time: a line per lamp set, the
/// twin's as a thin dashed line, the band of +-0.1 degrees of aim. "" when nothing of that plane and limit was measured.
std::string reach_svg(const ComparedDrive& drive, ExtentPlane plane, double limit_lx);

/// What the drive asks of glare and seeing: for each subject its drawn columns over the distance, a line per lamp set.
std::vector<std::string> seeing_svgs(const ComparedDrive& drive);
/// The same of lamp control. Empty where the drive has none.
std::vector<std::string> control_svgs(const ComparedDrive& drive);

/// A lamp set's colour in every plot.
plots::Colour colour_of(std::size_t variant);

/// Speed over time. All lamp sets drive alike, so the first one's. "" without samples.
std::string speed_svg(const ComparedDrive& drive);

/// What the car of a drive with a vehicle does, over time: pitch of the body against the road, lift of the body over the rear axle, angles
/// of levelling and swivel. A line per lamp set, one where all that have it agree. Without those that nobody has; none without a vehicle.
std::vector<std::string> car_svgs(const ComparedDrive& drive);

/// Time per moment of the pass "frame" per lamp set, with its median. "" without samples.
std::string timing_svg(const ComparedDrive& drive);

/// Error of illuminance on the road (95 % of the pixels) over the time of a frame, both logarithmic: a point a lamp set with bars from the
/// least to the most of the moments and of the frames' times, and the reference's noise as the band that nothing is claimed in. "" where
/// no lamp set has both.
std::string error_svg(const ComparedDrive& drive);

/// Ticks over their lateness, both logarithmic, and lateness over the drive. None without ticks, and of what did not wait.
std::vector<std::string> live_svgs(const LiveFigures& live);

/// Limits worth a figure: 1 and 5 lx where they were measured, else the lowest and the highest that were.
std::vector<double> plotted_limits_lx(const ComparedDrive& drive);

} // namespace fernlicht
