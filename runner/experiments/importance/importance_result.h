// What `fernlicht importance` found. The writers only format it.
#pragma once

#include "metrics/importance/changed_beam.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

namespace fernlicht {

/// A moment that decides the reading.
struct ImportanceMoment {
    int tick = 0;
    double time_s = 0.0, distance_m = 0.0;
    double share = 0.0; ///< d reading / d figure of the moment
    Value figure;
};

struct ImportanceLamp {
    std::string lamp, file;
    double per_percent = 0.0;                      ///< what 1 % more of its light changes, in every direction
    double h_deg = 0.0, v_deg = 0.0, per_cd = 0.0; ///< the sample of its table that matters most
    std::size_t samples = 0;                       ///< whose derivative is not 0
};

/// What a round spot of light changes, added to all lamps that have this file: a place where it changes much.
struct ImportanceSpot {
    std::vector<std::string> lamps;
    std::string file;
    double h_deg = 0.0, v_deg = 0.0;
    double cd_there = 0.0; ///< of the table
    double foretold = 0.0; ///< by the gradient, of a spot of spot_cd there
    Value found;           ///< of the drive with such a spot
};

/// The same over the beam.
struct ImportanceMap {
    std::vector<std::string> lamps;
    std::shared_ptr<const LampFile> file;
    SpotMap of_reading, of_mean; ///< of the mean over the moments
};

/// Smooth random changes of one size.
struct ImportanceCheck {
    double size = 0.0; ///< largest relative change of any sample
    int count = 0;
    int bounds = 0;           ///< of them, whose reading was no number
    double found_rms = 0.0;   ///< changes found
    double error_rms = 0.0;   ///< foretold less found
    double worst_error = 0.0; ///< largest size of these
    double error_share() const { return found_rms > 0.0 ? error_rms / found_rms : 0.0; }
};

struct ImportanceResult : Findings {
    std::string drive, title, lamp_set;
    std::string reading, unit, figure_unit; ///< its name; units of it, and of a moment's figure
    Value value;                            ///< by the twin
    std::string why_not;                    ///< why it is not measured; "" where it is
    int first_tick = 0, moments = 0;
    double spot_deg = 0.5, spot_cd = 1000.0;
    std::vector<ImportanceMoment> deciders;
    std::vector<ImportanceLamp> lamps;
    std::vector<ImportanceSpot> spots;    ///< of each file those that change most, the largest first
    std::vector<ImportanceMap> maps;      ///< by file; not in JSON
    std::vector<ImportanceCheck> checks;  ///< by size, smallest first
    BeamGradient gradient, mean_gradient; ///< not in JSON
    bool decided() const { return !gradient.empty(); }
};

/// How far foretold and found may differ, root mean square: of the smallest changes, and as far as the gradient is said to hold.
inline constexpr double agreed_share = 0.01, linear_share = 0.1;
/// Nothing was tried, or the smallest changes were foretold.
inline bool agrees(const ImportanceResult& result) { return result.checks.empty() || result.checks.front().error_share() <= agreed_share; }
/// The largest size up to which all that were tried were foretold within linear_share; nullopt: none, or nothing was tried.
std::optional<double> linear_to(const ImportanceResult& result);

/// docs/importance.md tells how to read it.
Document document(const ImportanceResult& result);
JsonMembers importance_members(ImportanceResult& result); ///< of importance.json
/// Each sample of a lamp's table that the reading, or the mean over the moments, turns on, a line each.
std::string importance_csv(const ImportanceResult& result);
/// What 1000 cd more in a spot change; rows from the top.
Image<float> image_of_map(const SpotMap& map);
/// All maps as float channels, per 1000 cd; "" where there are none.
std::string importance_exr(const ImportanceResult& result);

} // namespace fernlicht
