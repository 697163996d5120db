// Two lamps told apart: in words, as JSON, as a picture.
#pragma once

#include "metrics/beam/lamp_difference.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/plots/figure.h"
#include "scenarios/lamps/lamp_file.h"

namespace fernlicht {

/// What a lamp is called beside another one: its file, and in brackets its own name where that says something else: "halogen-low.ies
/// (halogen low beam (model))". Files of one name with their folders. A lamp that was read from no file has its own name alone.
std::string distinct_label(const LampFile& lamp, const LampFile& other);

/// By the trade's named places. Throws InputError naming the lamp that has no light.
LampDifference difference_of(const LampFile& tested, const LampFile& against, double noise_relative);

/// What is told of it: "lamp", "against", "difference", "noise", "compared", and what each is.
std::vector<std::pair<std::string, std::string>> difference_lines(const LampFile& tested, const LampFile& against,
                                                                  const LampDifference& difference);
/// The trade's named places: what both lamps give there, and whether the change is more than noise.
Table named_places_table(const LampDifference& difference);
/// Figures with units in their names; null where nothing is claimed.
JsonPart difference_part(LampDifference& difference);
nlohmann::ordered_json difference_json(const LampDifference& difference);

/// Tested over against, less 1, in per cent over H and V: blue is dimmer, orange brighter, grey not compared. As they are, with no shift
/// undone; frames are the zones that are claimed.
plots::Figure difference_figure(const LampFile& tested, const LampFile& against, const LampDifference& difference);

/// An axis for ratios, round 1, to the least 1 %, 2 %, 5 %, 10 % or 20 % that holds 98 % of them; where they lie farther from 1, to a
/// factor of 2, 5, 10, 100 or 1000 on a logarithmic scale. Values that are not above 0 do not count.
plots::Axis ratio_axis(const Image<float>& values);

} // namespace fernlicht
