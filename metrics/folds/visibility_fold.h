// How far ahead targets on the road are detected, over a drive: visibility level after Adrian (metrics/seeing/visibility.h) in the light of
// the lamps' tables in double, against what the driver sees behind them: the road, or the dark beyond it.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/readings/readings.h"
#include "metrics/road/lit_line.h"
#include "metrics/seeing/visibility.h"

namespace fernlicht {

class VisibilityFold {
  public:
    /// The drive must ask for visibility. Drive and route must outlive the fold.
    VisibilityFold(const Drive& drive, const Route& route);

    void add(const Moment& moment);
    /// Of each target at each of its places ("card_own", "pedestrian-dark_right"): detection_card_own_m, _min_m, _p05_m;
    /// undetected_before_detection_card_own_m; at each distance visibility_level_card_own_at_50m. At each distance on the own lane
    /// background_luminance_own_at_50m_cdm2, mesopic_luminance_own_at_50m_cdm2. Medians.
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    /// A square of a target as the driver sees it; nullopt where something of that is not known.
    struct Square {
        double illuminance_lx = 0.0, background_cdm2 = 0.0, adaptation_cdm2 = 0.0, size_arcmin = 0.0;
        bool hidden = false;
        std::string unknown; ///< why it has no level; "" where it has
    };
    struct Detection {
        Value from_m, undetected_m; ///< not measured where the route's end cuts them off
    };
    /// A target at one of its places.
    struct Sight {
        const VisibilityTarget* target;
        ReadingKey key; ///< of its detection distance
        std::vector<Detection> detections;
        struct AtDistance {
            std::vector<double> level;
            std::string no_level;
            std::vector<Value> series;
        };
        std::vector<AtDistance> at;
    };
    /// Targets of one form at one place: light and backgrounds are the same for all.
    struct Stand {
        Across across;
        double size_m;
        int squares;
        std::vector<Sight> sights;
    };
    struct Background {
        std::vector<double> photopic, mesopic;
        std::string missing;
    };

    std::vector<Square> squares(const Moment& moment, const LaneAhead& lane, const Pose& foot, const Stand& stand,
                                const glm::dvec3& eye_m) const;
    Value level(const std::vector<Square>& squares, const VisibilityTarget& target) const;
    void add_stand(const Moment& lit, const LaneAhead& lane, const glm::dvec3& eye_m, double bumper_m, Stand& stand) const;
    void add_background(const Moment& lit, const LaneAhead& lane, const glm::dvec3& eye_m, double ahead_m, Background& background) const;

    const Drive& drive_;
    const Route& route_;
    Material road_;
    std::vector<int> ticks_;
    std::vector<double> along_m_;
    std::vector<Stand> stands_;
    std::vector<Background> backgrounds_; ///< by distance
};

} // namespace fernlicht
