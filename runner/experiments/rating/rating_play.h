// The light on a rating's photometers while a drive is played.
#pragma once

#include "metrics/readings/readings.h"
#include "runner/experiments/rating/rating_result.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/moment.h"
#include "scenarios/drives/play/nudge.h"
#include "scenarios/light/light_gradient.h"

#include <map>
#include <memory>

namespace fernlicht {

/// Throws InputError naming the row's key.
[[noreturn]] void refuse_row(const Rating& rating, const RatingRow& row, const std::string& key, const std::string& found,
                             const std::string& expected);

/// A drive with one lamp set, played. Its moments are made one at a time: a state of a lamp's pixels is a whole table.
struct PlayedRating {
    std::unique_ptr<Stage> owned;
    const Stage& stage;
    const LampSet& lamp_set;
    std::vector<State> states;
    std::map<double, Readings> readings; ///< by how far all lamps are aimed higher, rad

    /// Throws InputError for wet roads.
    explicit PlayedRating(Drive drive);
    Moment at(const State& state) const { return moment_at(state, stage.drive, stage.route, lamp_set); }
};

/// All lamps by nudge_aim_deg.
Nudge aimed_higher();

/// What a row's photometers get while the car comes nearer, and where it was, tick by tick.
struct Approaches {
    struct Place {
        glm::dvec2 ego_m;
        double speed_mps;
    };
    std::vector<LightApproach> as_aimed, higher; ///< by photometer: as lamps are, and all of them aimed a little higher
    std::vector<std::vector<LightPlace>> lit;    ///< by photometer and sample
    std::vector<Place> places;
};

/// Of the moments in which a photometer lies ahead of the car's reference.
Approaches approaches_of(const Rating& rating, const RatingRow& row, const std::vector<Photometer>& photometers,
                         const PlayedRating& played);

} // namespace fernlicht
