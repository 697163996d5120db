// A bench on a real device: what takes part, what it draws, and its result.
#pragma once

#include "runner/experiments/bench/bench_result.h"

namespace fernlicht {

inline constexpr int default_bench_moments = 8;

struct BenchRequest : ExperimentRequest<BenchResult> {
    Drive drive;
    std::string lamp_set;                ///< "": the drive's first
    std::vector<std::string> techniques; ///< empty: all. The reference takes part in any case
    LightPass light_pass = LightPass::automatic;
    std::optional<int> moments; ///< nullopt: default_bench_moments, or all of a drive that has fewer
    int rounds = 21;
    std::uint64_t seed = 1;
    TakePlot write_plot; ///< takes the contact sheet, after what was found
};

/// Holds the contest and writes its files. Ends after a round when interrupted. Throws InputError and DeviceError.
BenchResult run_bench(const BenchRequest& request);

/// The rows that take part, in the table's order. Throws InputError for a name that is unknown or comes twice.
std::vector<Technique> chosen_techniques(const std::vector<std::string>& names);

/// Compiled for all moments in colour, a frame's work of each added to `work`; renderer, moments and view must outlive what is timed.
TimedTechnique timed_frames(Renderer& renderer, const std::vector<Moment>& moments, const View& view, std::vector<Work>& work);

/// The middle of each of `n` equal parts of ticks 0 .. count - 1. Throws InputError naming --count when there are not as many.
std::vector<int> ticks_over(int count, int n);

} // namespace fernlicht
