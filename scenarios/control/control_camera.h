// What the own car's camera tells lamp control of other road users: those in its field and reach, at its frames, late, and not without
// error.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/laws.h"

#include <deque>

namespace fernlicht {

/// How far the camera of a grade finds a road user's lamps. legal: as an adaptive beam's must by UN R48 6.22.9.3.1.1 to .2 as we remember
/// it (400 m oncoming, 100 m ahead, 75 m a bicycle; [assumed]); good: what makers say of theirs (800 and 400 m; a bicycle 150, [assumed]).
double camera_reach_m(const ControlCameraParameters& camera, const OtherUser& other);

class ControlCamera {
  public:
    explicit ControlCamera(const ControlCameraParameters& parameters) : parameters_(parameters) {}

    /// What laws are told at `time_s`, which ascends from 0: the last frame that has come through, of which nothing is known before the
    /// first has. A frame is taken at the first tick that is due; chance is that of seed, frame and name alone.
    const std::vector<OtherUser>& step(double time_s, const std::vector<OtherUser>& there);

  private:
    struct Taken {
        double arrives_s = 0.0;
        std::vector<OtherUser> seen;
    };
    std::vector<OtherUser> seen(const std::vector<OtherUser>& there) const;

    ControlCameraParameters parameters_;
    std::deque<Taken> on_their_way_;
    std::vector<OtherUser> told_;
    std::uint64_t frames_ = 0;
};

} // namespace fernlicht
