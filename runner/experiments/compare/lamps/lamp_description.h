// What can be said of a lamp file by looking at its table.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/lamps/spots/spot_fit.h"

#include <string>

namespace fernlicht {

struct LampDescription {
    std::string name, format;
    BetweenSamples rule = BetweenSamples::linear_cd;
    std::size_t h_samples = 0, v_samples = 0;
    double h_from_deg = 0.0, h_to_deg = 0.0, v_from_deg = 0.0, v_to_deg = 0.0;
    double h_finest_deg = 0.0, h_coarsest_deg = 0.0, v_finest_deg = 0.0, v_coarsest_deg = 0.0;
    double covered_share = 0.0; ///< of the full sphere; without gaps
    std::size_t gap_cells = 0;
    double edge_cd = 0.0; ///< most intense sample beside what the table does not cover: the light that the cut takes off there
    Peak peak;
    double hv_cd = 0.0;   ///< straight ahead
    double flux_lm = 0.0; ///< by integration
    std::optional<double> declared_flux_lm;
    InterpolationError interpolation;
    std::optional<SpotFit> spots; ///< where asked for; describe() fits none
    std::vector<std::pair<std::string, std::string>> labels;
    std::vector<std::string> notes;
};

LampDescription describe(const LampFile& lamp);
std::string text_of(const LampDescription& description); ///< for a terminal: lines of at most about 100 characters
std::string json_of(const LampDescription& description); ///< one object, two blanks of indent, newline at the end

} // namespace fernlicht
