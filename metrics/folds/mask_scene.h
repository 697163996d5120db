// Where masks in a beam take light, in one moment of a drive: from the driver on his own lane and on the verge, from pedestrians beside
// oncoming cars, and, as is meant, from eyes and mirrors of other road users. By the twin, in double. Crests of the road hide lamps, and
// the boxes of road users do from targets and eyes: what lies in somebody's shadow is no loss. Nothing else hides any.
#pragma once

#include "metrics/folds/visibility_fold.h"
#include "metrics/glare/glare.h"
#include "scenarios/ratings/rating.h"

namespace fernlicht {

/// Targets that face the lamps, in the middle of cells of equal size over the own lane and over a verge as wide as `verge_m` beside the
/// driving lanes on the kerb's side; a hard shoulder belongs to it. Ours: from where somebody may step onto the road; nearer ground lies
/// below all masks.
struct MaskPlaces {
    double from_m = 20.0, to_m = 200.0; ///< from the front bumper, along the route
    double row_m = 4.0, across_m = 0.5; ///< size of a cell at most
    double above_m = 0.25;              ///< the road
    double verge_m = 3.0;
    bool left_hand = false; ///< the kerb is on the left
};

/// What one lamp set does there.
struct MaskLight {
    double lane_lx = 0.0, verge_lx = 0.0, both_lx = 0.0; ///< means over the targets
    /// Light on a photometer of a road user: of the eye of an oncoming one, of the mirrors of a preceding one.
    struct Eye {
        std::size_t user = 0; ///< of Drive::traffic
        double distance_m = 0.0, lx = 0.0;
        std::optional<double> limit_lx = {}; ///< nullopt: no limit at that distance
    };
    std::vector<Eye> eyes;
    /// A pedestrian level with the front of an oncoming road user: at the edges of the road as the driver sees them.
    struct Walker {
        std::size_t user = 0;
        double ahead_m = 0.0; ///< from the front bumper
        Value left, right;    ///< visibility levels
    };
    std::vector<Walker> walkers;
};

class MaskScene {
  public:
    /// Geometry of the moment, and the glare of other lamps, which all lamp sets share. Of `limits` photometers on road users count, those
    /// that face forward on oncoming ones, those that face backward on preceding ones, each with the limits of the first row that names it.
    /// `walker`: the pedestrian. Drive, which asks for visibility, route, `limits` and `walker` must outlive it.
    MaskScene(const Drive& drive, const Route& route, const Rating& limits, const MaskPlaces& places, const VisibilityTarget& walker,
              const Moment& moment);
    /// The same moment with some lamp set. `visibility`: of the drive.
    MaskLight light(const Moment& moment, const VisibilityFold& visibility) const;

    double lane_m2() const { return lane_m2_; } ///< of which there are targets
    double verge_m2() const { return verge_m2_; }

  private:
    struct Target {
        glm::dvec3 point_m;
        double area_m2;
        bool verge;
    };
    struct Place {
        std::size_t user;
        glm::dvec3 point_m, gaze;
        double distance_m;
        std::optional<double> limit_lx;
        std::optional<RoadBetween> road; ///< nullopt: not on the route
    };
    void add_targets(const Drive& drive, const Route& route, const MaskPlaces& places, const Moment& moment, const glm::dvec3& lamps_m);
    void add_eyes(const Drive& drive, const Route& route, const Rating& limits, const Moment& moment, const glm::dvec3& lamps_m);
    void add_veils(const Drive& drive, const Route& route, Moment moment);

    std::vector<Target> targets_; ///< those that nothing hides
    double lane_m2_ = 0.0, verge_m2_ = 0.0;
    std::vector<Place> eyes_;
    struct Walker {
        std::size_t user;
        double ahead_m;
        Value left_veil_cdm2 = {}, right_veil_cdm2 = {};
    };
    std::vector<Walker> walkers_;
    const VisibilityTarget& walker_;
};

/// The middle of the moment's lamps, from which a MaskScene looks for what hides targets and eyes.
glm::dvec3 middle_of_lamps_m(const Moment& moment);

} // namespace fernlicht
