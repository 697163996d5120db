// What the lamps do to the eyes of others over a drive: an oncoming driver who stands still, and a driver ahead through the mirrors. From
// the lamps' tables in double. A crest of the road between lamp and eye hides the lamp; nothing else does.
// Glare through the mirrors of a car ahead in the own lane, at fixed gaps: what this car's driver has from a follower with the same lamps.
// Glare from other road users in the own driver's eyes, folded over the drive.
#pragma once

#include "metrics/folds/adaptation.h"
#include "metrics/folds/glare_followed.h"

namespace fernlicht {

/// Where an oncoming driver's eye is and along which unit vector it looks; nullopt where there is no oncoming lane.
struct OncomingEye {
    glm::dvec3 place_m{0.0}, gaze{0.0};
};
std::optional<OncomingEye> oncoming_eye(const Route& route, const GlareObserver& observer);

/// What he is adapted to: as the drive says, else his own lane in the light of the moment and of a car like this one with that lamp set.
Value oncoming_adaptation_cdm2(const Drive& drive, const Route& route, const LampSet& lamp_set, const Driver& driver, double at_m,
                               const Moment& moment, const Nudge& nudge = {});

class OncomingFold {
  public:
    /// The drive must ask for glare. Drive and route must outlive the fold.
    /// `nudge`: of the lamps of his own car, where they are the lamp set's.
    OncomingFold(const Drive& drive, const Route& route, const Nudge& nudge = {});
    /// `lamp_set`: what the dazzled driver's own car has, too.
    void add(const Moment& moment, const LampSet& lamp_set);
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    struct Eye {
        std::optional<glm::dvec3> place_m; ///< nullopt: there is no oncoming lane
        glm::dvec3 gaze{0.0};
        GlareFollowed followed;
        bool passed = false; ///< some moment is beyond it
        Driver driver = {};
        /// Last found, and in which light: a standing driver's changes with sky and weather alone.
        struct Adapted {
            Daylight daylight;
            Weather weather;
            Value cdm2;
        };
        std::optional<Adapted> adapted = {};
    };
    Value adaptation_cdm2(const Moment& moment, const LampSet& lamp_set, double at_m, Eye& eye) const;

    const Drive& drive_;
    const Route& route_;
    Nudge nudge_;
    std::vector<Eye> eyes_;
    std::vector<std::string> lamps_;
};

class MirrorFold {
  public:
    /// The drive must ask for glare in mirrors. Drive and route must outlive the fold.
    MirrorFold(const Drive& drive, const Route& route, const Nudge& nudge = {}); ///< as OncomingFold
    void add(const Moment& moment, const LampSet& lamp_set);
    /// Per gap of 15 m: mirror_NAME_at_15m_lx, _p95_lx and _max_lx, median, 95th percentile and largest illuminance on the mirror facing
    /// the lamps; and of the eye, through all mirrors together, glare_mirrors_at_15m_... as of an oncoming driver.
    Readings readings() const;
    /// Over the distance along the route.
    std::vector<SeeingSeries> series() const;

  private:
    struct Gap {
        std::vector<std::vector<double>> mirror_lx; ///< by mirror
        GlareFollowed eye;
        std::string unknown; ///< why the light on the mirrors is not known in some moment
    };
    const Drive& drive_;
    const Route& route_;
    Nudge nudge_;
    std::vector<Gap> gaps_;
    std::vector<std::string> sources_; ///< "left_in_inside": each lamp in each mirror
};

class TrafficFold {
  public:
    /// The drive must ask for glare and have traffic. Drive and route must outlive the fold.
    TrafficFold(const Drive& drive, const Route& route);
    void add(const Moment& moment);
    /// glare_own_...: of the driver's eye, where the first view that is no map has it, looking along the car; as of an oncoming driver. It
    /// is adapted to the own lane as the moment's lamps light it, whatever shines.
    Readings readings() const;

  private:
    const Drive& drive_;
    const Route& route_;
    std::vector<BodyBox> boxes_;
    GlareFollowed eye_;
};

} // namespace fernlicht
