// How much time pruning saves on a drive, measured while the run still has its device.
#pragma once

#include "renderer/renderer.h"
#include "runner/findings/report.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// The technique that leaves out, and the one that draws the same bytes with everything in.
inline constexpr std::string_view pruned_technique = "photometric", unpruned_technique = "photometric-unpruned";

/// How many moments, at most 4, both can draw in seven rounds within two seconds, and within a fifth of the `run_s` that the moments took,
/// when a frame takes `frame_s`, pruned and read back.
int affordable_moments(double frame_s, double run_s);

/// Why savings are not measured for what was played; "" where they can be: by the pruned technique, with a perspective view, long enough
/// for frames to have been timed, in two seconds, and in a fifth of the time that was played.
std::string no_savings(const Drive& drive, const PlayedCell& played);

/// The middles of equal parts of the ticks played, from `first_tick` on, in seven rounds: in each both draw all of them, in an order drawn
/// anew from the drive's seed. Both renderers are of the stage's scene. Throws DeviceError.
PruningSavings measure_savings(const Stage& stage, const LampSet& lamp_set, const PlayedCell& played, int first_tick, Renderer& pruned,
                               Renderer& unpruned);

} // namespace fernlicht
