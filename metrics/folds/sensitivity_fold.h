// How what a drive measures of seeing and glare answers to usual tolerances of its lamps: the same folds again, with the lamps nudged.
#pragma once

#include "metrics/folds/seeing_fold.h"

namespace fernlicht {

class SensitivityFold {
  public:
    /// As SeeingFold; nothing is folded where the drive asks for nothing.
    SensitivityFold(const Drive& drive, const Route& route, const LampSet& lamp_set);
    void add(const Moment& moment);
    /// Adds what each reading moves by. `readings`: of the SeeingFold that was given the same moments.
    void tell(Readings& readings) const;

  private:
    const LampSet& lamp_set_;
    std::vector<std::optional<SeeingFold>> nudged_; ///< in the order of NudgeKind
};

} // namespace fernlicht
