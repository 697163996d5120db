// How a drive's readings of seeing and glare respond to usual tolerances of its lamps: the same folds again, with the lamps nudged.
#pragma once

#include "metrics/folds/seeing_fold.h"

namespace fernlicht {

/// Of what is a median over the drive, so many moments tell how it moves; evenly over all that are played.
inline constexpr int sensitivity_moments = 40;
/// Whether the `k`th of `planned` moments is one of `moments`.
bool tells_sensitivity(int k, int planned, int moments = sensitivity_moments);

class SensitivityFold {
  public:
    /// As SeeingFold; nothing is folded where the drive asks for nothing.
    SensitivityFold(const Drive& drive, const Route& route, const LampSet& lamp_set);
    /// Every moment; `sampled`: that tells_sensitivity().
    void add(const Moment& moment, bool sampled);
    /// Adds what each reading moves by. `readings`: of the SeeingFold that was given the same moments.
    void tell(Readings& readings) const;

  private:
    struct Nudged {
        SeeingFold every_moment, medians;
    };
    const LampSet& lamp_set_;
    std::vector<std::optional<Nudged>> nudged_; ///< in the order of NudgeKind
    SeeingFold medians_;                        ///< as the lamps are
};

} // namespace fernlicht
