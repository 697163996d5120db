// How far ahead targets on the road are detected, over a drive: visibility level after Adrian (metrics/seeing/visibility.h) in the light of
// the lamps' tables in double, against what the driver sees behind them: the road, or the dark beyond it.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/folds/target_squares.h"
#include "metrics/readings/readings.h"

#include <array>

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
    /// Visibility level in a moment of a target so far ahead of the bumper, which is not folded; beyond a crest 0. The eye is adapted to
    /// what lies behind the target and to `veil_cdm2` of glare over it, which adds to target and background alike (Adrian 1989).
    Value level_at(const Moment& moment, const VisibilityTarget& target, Across across, double ahead_m, const Value& veil_cdm2) const;

  private:
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

    struct Place {
        double ahead_m = 0.0, along_m = 0.0;    ///< from the bumper, on the route
        std::vector<TargetSquare> squares = {}; ///< none without such a lane
    };
    /// What the weather adds to one square: light in the air before it and before what is behind it, light by way of a wet road.
    using Added = std::array<double, 3>;

    /// As it stands that far along the route, in clear air and by the lamps' own light.
    std::vector<TargetSquare> squares(const Moment& moment, const SeenLane& ahead, double along_m, const Stand& stand) const;
    /// What air and water take and add, places from near to far.
    void add_weather(const Moment& moment, const SeenLane& ahead, std::vector<Place>& places) const;
    Added added(const Moment& moment, const SeenLane& ahead, double along_m, const TargetSquare& square) const;
    void add_stand(const Moment& lit, const SeenLane& ahead, double bumper_m, Stand& stand) const;
    void add_background(const Moment& lit, const SeenLane& ahead, double ahead_m, Background& background) const;

    const Drive& drive_;
    const Route& route_;
    std::vector<int> ticks_;
    std::vector<double> along_m_;
    std::vector<Stand> stands_;
    std::vector<Background> backgrounds_; ///< by distance
};

} // namespace fernlicht
