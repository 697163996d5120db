// Techniques timed in turns: in each round every one draws the same moments, in an order drawn anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace fernlicht {

/// One that takes part; how it draws is its own affair. Moments are counted from 0.
struct Contestant {
    std::function<void(std::size_t moment)> draw; ///< hands a frame to the device, flushed as for a display, and does not wait for it
    std::function<void()> finish;                 ///< waits until all that was handed over is drawn
};

/// What time is read from; tests bring their own.
struct ContestClocks {
    std::function<double()> wall_s;           ///< steady
    std::function<double()> cpu_s;            ///< all threads of the process, user and system
    std::function<void()> gpu_begin, gpu_end; ///< round each frame; empty where the GPU's clock cannot be believed
    std::function<double()> gpu_s;            ///< of the frames since it was last asked
};
/// The process's own clocks, none of the GPU.
ContestClocks real_clocks();

struct ContestOptions {
    std::size_t moments = 8, rounds = 21;
    std::size_t warm_up_plays = 2; ///< before the first round each contestant draws all moments so often, untimed: programs are compiled
    bool frame_by_frame = true;    ///< else a round is drawn back to back only, and there are no latencies
    std::uint64_t seed = 1;        ///< of the orders
    std::function<bool(std::size_t rounds_done)> go_on = [](std::size_t) { return true; }; ///< asked before each round
    std::function<bool()> stop = [] { return false; }; ///< asked before each contestant's warm-up; true: no rounds are held
};

/// Seconds of one contestant. All per frame; a round is drawn twice, once back to back and once frame by frame.
struct ContestSamples {
    std::vector<double> frame_s;   ///< by round: moments back to back, one finish at the end, divided by their number
    std::vector<double> cpu_s;     ///< by round: CPU time in that, of all threads
    std::vector<double> gpu_s;     ///< by round: of the GPU's clock in that; empty: not measured
    std::vector<double> latency_s; ///< by round and moment: one frame from submit to finished
    bool operator==(const ContestSamples&) const = default;
};

struct Contest {
    std::vector<ContestSamples> samples;          ///< of each contestant, in the order given
    std::vector<std::vector<std::size_t>> orders; ///< of each round done
};
Contest hold_contest(const std::vector<Contestant>& contestants, const ContestOptions& options, const ContestClocks& clocks);

} // namespace fernlicht
