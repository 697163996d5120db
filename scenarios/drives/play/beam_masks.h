// Files of lamps that are cut into windows, for each state of the windows that comes.
#pragma once

#include "scenarios/control/control_run.h"
#include "scenarios/drives/drive.h"

#include <map>

namespace fernlicht {

class BeamMasks {
  public:
    /// Drive and variant must outlive it; without a glare-free beam there is nothing to do.
    BeamMasks(const Drive& drive, const Variant& variant);

    /// Gives `run` the masks of its segments; the same state is the same file, from call to call. Throws InputError for more than can be
    /// kept.
    void add(ControlRun& run);
    std::vector<std::string> notes() const;

  private:
    const Drive& drive_;
    const Variant& variant_;
    double bytes_ = 0.0;
    std::size_t states_ = 0;
    std::map<std::pair<std::size_t, std::vector<double>>, std::shared_ptr<const LampFile>> known_;
};

} // namespace fernlicht
