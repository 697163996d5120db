// Techniques timed in turns: in each round all draw the same moments, in a new random order, so that what else the machine does hits all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// One that takes part; how it draws is its own affair. Moments are counted from 0.
struct TimedTechnique {
    std::function<void(std::size_t moment)> draw; ///< hands a frame to the device, flushed as for a display, and does not wait for it
    std::function<void()> finish;                 ///< waits until all that was handed over is drawn
};

/// What time is read from; tests bring their own.
struct TimingClocks {
    std::function<double()> wall_s;           ///< steady
    std::function<double()> cpu_s;            ///< all threads of the process, user and system
    std::function<void()> gpu_begin, gpu_end; ///< round each frame; empty where the GPU's clock cannot be believed
    std::function<double()> gpu_s;            ///< of the frames since it was last asked
};
/// The process's own clocks, none of the GPU.
TimingClocks real_clocks();

struct TimingOptions {
    std::size_t moments = 8, rounds = 21;
    std::size_t warm_up_plays = 2; ///< before the first round each technique draws all moments so often, untimed: programs are compiled
    bool frame_by_frame = true;    ///< else a round is drawn back to back only, and there are no latencies
    std::uint64_t seed = 1;        ///< of the orders
    std::function<bool(std::size_t rounds_done)> go_on = [](std::size_t) { return true; }; ///< asked before each round
    std::function<bool()> stop = [] { return false; }; ///< asked before each technique's warm-up; true: no rounds are held
};

/// Seconds of one technique. All per frame; a round is drawn twice, once back to back and once frame by frame.
struct TimingSamples {
    std::vector<double> frame_s;   ///< by round: moments back to back, one finish at the end, divided by their number
    std::vector<double> cpu_s;     ///< by round: CPU time in that, of all threads
    std::vector<double> gpu_s;     ///< by round: of the GPU's clock in that; empty: not measured
    std::vector<double> latency_s; ///< by round and moment: one frame from submit to finished
    bool operator==(const TimingSamples&) const = default;
};

struct InterleavedTimes {
    std::vector<TimingSamples> samples;           ///< of each technique, in the order given
    std::vector<std::vector<std::size_t>> orders; ///< of each round done
};
InterleavedTimes time_interleaved(const std::vector<TimedTechnique>& timed_techniques, const TimingOptions& options,
                                  const TimingClocks& clocks);

/// CPU seconds used so far.
struct CpuUse {
    double wall_s = 0.0;                                     ///< of a steady clock
    double own_s = 0.0;                                      ///< this process, all threads, user and system
    std::optional<double> machine_s;                         ///< all cores, time stolen by the hypervisor too; nullopt: /proc does not tell
    std::map<int, std::pair<std::string, double>> processes; ///< name and seconds by process id, as far as they can be seen
    std::optional<std::array<double, 3>> load_average;       ///< over 1, 5 and 15 minutes
};
CpuUse cpu_use();

/// Own CPU seconds, all threads, user and system.
double own_cpu_s();

/// What others used between two looks, in cores: 1.0 is one core all the time.
struct OtherLoad {
    std::optional<double> cores; ///< nullopt: /proc does not tell
    std::string busiest;         ///< the process that used most; "" where none used a hundredth of a core
    double busiest_cores = 0.0;
};
OtherLoad other_load(const CpuUse& before, const CpuUse& after, int own_process);

/// A sentence where others used more than a fifth of a core, or where that cannot be told; "" for a quiet machine.
std::string disturbance_text(const OtherLoad& others, std::size_t cores);

/// Ticks of work in the line `cpu` of /proc/stat: user, nice, system, irq, softirq and steal. nullopt when it is not that.
std::optional<double> machine_ticks(const std::string& stat);
/// Name and ticks (user and system) of /proc/PID/stat. The name may hold spaces and parentheses.
std::optional<std::pair<std::string, double>> process_ticks(const std::string& stat);

} // namespace fernlicht
