// Glare from other road users in the own driver's eyes, folded over the drive.
#pragma once

#include "metrics/folds/glare_fold.h"
#include "metrics/glare/traffic_glare.h"

namespace fernlicht {

class TrafficFold {
  public:
    /// The drive must ask for glare and have traffic. It must outlive the fold.
    explicit TrafficFold(const Drive& drive);
    void add(const Moment& moment);
    /// glare_own_...: of the driver's eye, where the first view that is no map has it, looking along the car; as of an oncoming driver.
    Readings readings() const;

  private:
    const Drive& drive_;
    glm::dvec3 eye_m_{1.3, 0.35, 1.2}; ///< in the car's frame
    std::vector<BodyBox> boxes_;
    GlareFollowed eye_;
};

} // namespace fernlicht
