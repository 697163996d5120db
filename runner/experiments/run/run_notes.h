// What a report says beside its figures: notes of each lamp set, warnings of the run, the command that repeats a verdict.
#pragma once

#include "renderer/renderer.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/play/stage.h"

#include <deque>

namespace fernlicht {

/// What bounds the figures of one lamp set: of its files, of the road, of what the technique leaves out.
std::vector<std::string> notes_for(const Stage& stage, const LampSet& lamp_set, const Renderer& renderer);

/// Of eyes that look into the lamps (gazes.h).
std::vector<std::string> gaze_warnings(const std::vector<PlayedCell>& played);

/// So that nobody takes a part for the whole drive, a technique's own shadows, or none, for those that were asked for, what a display hides
/// for what lamps do not light, and what policies made up for what a car said.
void add_warnings(const std::deque<Stage>& stages, const std::vector<Drive>& drives, const TickRange& ticks, Report& report);

/// Of each verdict how it is repeated: with its own drive alone.
void add_reruns(const std::vector<Drive>& drives, const RunOptions& options, Report& report);

} // namespace fernlicht
