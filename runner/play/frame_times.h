// What drawing costs, without what is done beside it.
#pragma once

#include "runner/findings/report.h"

#include <chrono>
#include <map>

namespace fernlicht {

/// Measuring and writing go on beside the drawing and slow it down where all share the same cores. Every tenth moment of a kind, and the
/// first after the warm-up, is therefore drawn with nothing beside it, and only such moments give times.
class FrameTimes {
  public:
    /// Kinds of moment ("frame", "frame, stored") draw different things. `always_alone`: every moment is drawn with nothing beside it.
    /// `no_times`: why none are taken; then nothing is drawn alone.
    FrameTimes(int warm_up, bool always_alone, std::string no_times = "")
        : warm_up_(warm_up), always_alone_(always_alone), no_times_(std::move(no_times)) {}

    /// Before each moment: whether it is to be drawn alone.
    bool begin_moment(const std::string& kind);
    /// A frame of this moment, whose samples are kept under `name` when it is drawn alone.
    void add(const std::string& name, const Frame& frame);
    /// A frame of this moment whose time counts only as part of all drawing.
    void add(const Frame& frame) { moment_s_ += frame.cpu_s; }
    void end_moment();

    /// Samples and throughput; after the last measurement and the last file.
    void finish(PlayedCell& played) const;

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr int alone_every = 10;
    struct Kind {
        int moments = 0; ///< after the warm-up
        int last_alone = -1;
        std::vector<double> drawing_s; ///< of all frames of moments drawn alone
    };
    void add_sample(const std::string& pass, double seconds);

    int warm_up_;
    bool always_alone_;
    std::string no_times_;
    int moment_ = -1; ///< from 0
    bool alone_ = false;
    double moment_s_ = 0.0;
    Kind* kind_ = nullptr;
    std::map<std::string, Kind> kinds_;
    std::vector<PassTime> passes_;
    Clock::time_point warm_ = Clock::now();
};

} // namespace fernlicht
