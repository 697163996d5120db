// Glare through the mirrors of a car ahead in the own lane, at fixed gaps: what this car's driver has from a follower with the same lamps.
#pragma once

#include "metrics/folds/glare_fold.h"

namespace fernlicht {

class MirrorFold {
  public:
    /// The drive must ask for glare in mirrors. Drive and route must outlive the fold.
    MirrorFold(const Drive& drive, const Route& route);
    void add(const Moment& moment);
    /// Per gap of 15 m: mirror_NAME_at_15m_lx and _max_lx, median and largest illuminance on the mirror facing the lamps; and of the eye,
    /// through all mirrors together, glare_mirrors_15m_... as of an oncoming driver.
    Readings readings() const;
    /// Over the distance along the route.
    std::vector<SeeingSeries> series() const;

  private:
    struct Gap {
        std::vector<std::vector<double>> mirror_lx; ///< by mirror
        GlareFollowed eye;
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Gap> gaps_;
    std::vector<std::string> sources_; ///< "left_in_inside": each lamp in each mirror
};

} // namespace fernlicht
