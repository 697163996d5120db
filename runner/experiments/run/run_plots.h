// The figures of a run's report.
#pragma once

#include "runner/experiments/run/run_document.h"

namespace fernlicht {

/// Adds what was drawn, if anything, small enough for two beside each other.
void add_plot(Section& section, const std::string& name, std::optional<plots::Figure> figure);
void add_plots(Section& section, const std::string& name, std::vector<plots::Figure> figures);

/// Reach in the own lane over the drive, by distance or, where the car stands still or moves on springs, by time: a line per lamp set, the
/// twin's as a thin dashed line, the band of +-0.1 degrees of aim. nullopt when nothing of that plane and limit was measured.
std::optional<plots::Figure> reach_figure(const ComparedDrive& drive, Surface surface, double threshold_lx);

/// What the drive asks of glare and seeing: for each subject its drawn columns over the distance, a line per lamp set.
std::vector<plots::Figure> seeing_figures(const ComparedDrive& drive);
/// The same of lamp control. Empty where the drive has none.
std::vector<plots::Figure> control_figures(const ComparedDrive& drive);

/// Where those of a lamp set's pixel lamps lie in the report's folder, without extension: "levels-DRIVE-LAMPS".
std::string levels_name(const PlayedCell& played);
/// What the pixels of each of its lamps did: a file's name of its own, and what it shows.
std::vector<Plot> level_plots(const PlayedCell& played);

/// Signals from a bus: what was heard of each, over time with bands where it was not fresh, then reach in the own lane and light in
/// oncoming eyes, where they were measured. All lamp sets of a drive hear the same bus.
void add_signals(const ComparedDrive& drive, std::vector<Section>& sections);

/// Speed over time. All lamp sets drive alike, so the first one's. nullopt without samples.
std::optional<plots::Figure> speed_figure(const ComparedDrive& drive);

/// What the car of a drive with a vehicle does, over time: pitch and roll of the body against the road, lift of the body over the rear
/// axle, angles of levelling and swivel. A line per lamp set, one where all that have it agree. Without those that nobody has; none without
/// a vehicle.
std::vector<plots::Figure> car_figures(const ComparedDrive& drive);

/// How a swaying car spreads what its lamps do over the moments: the share of the moments below each swing of the cut-off and below each
/// reach on targets in the own lane; of the light in others' eyes, in each range before an oncoming driver and at each gap of mirrors, the
/// 5th to 95th percentile, median and largest. Empty where no car sways by 0.01 degrees: nothing disturbs the drive.
std::vector<plots::Figure> spread_figures(const ComparedDrive& drive);

/// Time per moment of the pass "frame" per lamp set, with its median. nullopt without samples.
std::optional<plots::Figure> timing_figure(const ComparedDrive& drive);

/// Error of illuminance on the road (95 % of the pixels) over the time of a frame, both logarithmic: a point a lamp set with bars from the
/// least to the most of the moments and of the frames' times, and the reference's noise as the band that nothing is claimed in. nullopt
/// where no lamp set has both.
std::optional<plots::Figure> error_figure(const ComparedDrive& drive);

/// Ticks over their lateness, both logarithmic, and lateness over the drive. None without ticks, and of what did not wait.
std::vector<plots::Figure> lateness_figures(const LiveFigures& live);

/// Limits worth a figure: 1 and 5 lx where they were measured, else the lowest and the highest that were.
std::vector<double> plotted_thresholds_lx(const ComparedDrive& drive);

} // namespace fernlicht
