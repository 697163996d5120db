// Two lamps told apart: as text, as JSON, as a picture.
#pragma once

#include "metrics/beam/lamp_difference.h"
#include "runner/write/plots/svg.h"
#include "scenarios/lamps/lamp_file.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

/// Throws InputError naming the lamp that has no light.
LampDifference difference_of(const LampFile& tested, const LampFile& against, double noise_relative);

std::string difference_text(const LampFile& tested, const LampFile& against, const LampDifference& difference);
/// Figures with units in their names; null where nothing is claimed.
nlohmann::ordered_json difference_json(const LampDifference& difference);

/// Tested over against, less 1, in per cent over H and V: blue is dimmer, orange brighter, grey not compared. As they are, with no shift
/// undone; frames are the zones that are claimed.
plots::Figure difference_figure(const LampFile& tested, const LampFile& against, const LampDifference& difference);

/// An axis for ratios, round 1, to the least 1 %, 2 %, 5 %, 10 % or 20 % that holds 98 % of them; where they lie farther from 1, to a
/// factor of 2, 5, 10, 100 or 1000 on a logarithmic scale. Values that are not above 0 do not count.
plots::Axis ratio_axis(const Image<float>& values);

} // namespace fernlicht
