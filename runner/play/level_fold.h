// What the pixels of a lamp set's lamps do over a drive.
#pragma once

#include "runner/findings/pixel_levels.h"
#include "scenarios/drives/play/moment.h"

namespace fernlicht {

class LevelFold {
  public:
    /// Drive and lamp set must outlive it.
    LevelFold(const Drive& drive, const LampSet& lamp_set);
    void add(const Moment& moment);
    /// Of each lamp whose pixels follow a file or lamp control. The fold is used up.
    std::vector<PixelLevels> finish() { return std::move(lamps_); }

  private:
    struct Followed {
        std::size_t lamp; ///< of the lamp set
        const LevelTrack* track;
        double later_s; ///< asked for so much after the moment
        PixelStates states;
    };
    const Drive& drive_;
    const LampSet& lamp_set_;
    std::vector<Followed> followed_;
    std::vector<PixelLevels> lamps_;
};

} // namespace fernlicht
