// What `fernlicht masks` found. The writers only format it.
#pragma once

#include "metrics/folds/mask_scene.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

namespace fernlicht {

/// One lamp set, with one margin where it masks others. Illuminances are means over the targets, times seconds over the drive.
struct MaskedDrive {
    std::string lamp_set;
    std::optional<double> margin_deg = {}; ///< nullopt: it masks nobody
    bool as_it_is = true;                  ///< the lamp set's own margin
    double lane_lxs = 0.0, verge_lxs = 0.0, both_lxs = 0.0;
    double lost_lxs = 0.0;                   ///< of both, against the lamp set that counts as full light
    std::optional<double> lost_percent = {}; ///< nullopt: that lamp set gives no light there
    double others_lxs = 0.0;                 ///< each other's brightest photometer, all of them added up
    double above_lxs = 0.0;                  ///< of it what is above limits
    double most_lx = 0.0;
    std::optional<double> most_of_limit = {}; ///< largest share of a limit; nullopt: none held
    /// Where that was, or without limits the largest light.
    std::string worst_user = {};
    double worst_s = 0.0, worst_m = 0.0;
    Value left_m = {}, right_m = {}; ///< from how far away the pedestrians at each edge are detected: median over oncoming road users
    struct Moment {
        double time_s = 0.0, lane_lx = 0.0, verge_lx = 0.0, both_lx = 0.0, others_lx = 0.0, above_lx = 0.0;
    };
    std::vector<Moment> moments = {}; ///< not in JSON
};

struct MasksFound : Findings {
    std::string drive, title;
    std::string against;        ///< the lamp set whose light is full
    std::string limits, walker; ///< the rating that limits are of; the visibility target on foot
    double walker_level = 0.0;
    MaskPlaces places;
    int moments = 0;
    double step_s = 0.0;
    std::vector<MaskedDrive> drives; ///< in the order of lamp sets, by margin
    std::vector<std::string> notes;
};

Document document(const MasksFound& found);
JsonMembers masks_members(MasksFound& found);   ///< of masks.json
std::string masks_csv(const MasksFound& found); ///< a line for each lamp set and margin
std::string masks_moments_csv(const MasksFound& found);

} // namespace fernlicht
