// What a regulation check and a cut-off's measurement say, for a terminal and as JSON.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/beam/cut_off_elbow.h"
#include "metrics/regulation/regulation_check.h"

#include <string>
#include <vector>

namespace fernlicht {

/// `lamps`: the names of the files under test, one or two.
std::string text_of(const Regulation& regulation, const RegulationCheck& check, const std::vector<std::string>& lamps);
std::string json_of(const Regulation& regulation, const RegulationCheck& check, const std::vector<std::string>& lamps);

/// Under left-hand traffic the cut-off is that of the mirrored table, and is mirrored back here.
std::string text_of(const CutOffFigures& cut_off, const CutOffElbow& elbow, const std::string& lamp, const CutOffOptions& options,
                    bool left_hand_traffic);
std::string json_of(const CutOffFigures& cut_off, const CutOffElbow& elbow, const std::string& lamp, const CutOffOptions& options,
                    bool left_hand_traffic);

/// All ids with edition, source and what is in them.
std::string regulation_list_text();
std::string regulation_list_json();

} // namespace fernlicht
