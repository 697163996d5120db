#include "runner/experiments/run/savings.h"

#include "runner/experiments/bench/bench_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr int max_moments = 4, rounds = 7;
constexpr double max_s = 2.0, max_share = 0.2; // of the time played
/// What a moment costs, in pruned frames: the rounds, a warm-up and a count by both; unpruned frames take about a third longer.
constexpr double frames_a_moment = 2.3 * (rounds + 2);

/// Draws the moments as the bench does. `work` takes their counts.
TimedTechnique timed(Renderer& renderer, const std::vector<Moment>& moments, const View& view, Work& work) {
    static constexpr FrameOutputs outputs{.colour = true};
    renderer.keep_programs_of(moments);
    renderer.prepare(moments, view, outputs, true);
    std::vector<Work> counts;
    for (const Moment& moment : moments)
        counts.push_back(renderer.count(moment, view, outputs));
    work = typical_work(counts).value_or(Work{});
    return {[&](std::size_t moment) { renderer.render(moments[moment], view, outputs); }, [&] { renderer.finish(); }};
}

} // namespace

int affordable_moments(double frame_s, double run_s) {
    const double affordable = std::min(max_s, max_share * run_s) / (frames_a_moment * frame_s);
    return affordable >= max_moments ? max_moments : static_cast<int>(affordable);
}

std::string no_savings(const Drive& drive, const PlayedCell& played) {
    if (!played.no_times.empty())
        return played.no_times;
    if (drive.technique != pruned_technique)
        return fmt::format("it is measured for the technique photometric only, this is {}", drive.technique);
    if (!driver_view(drive))
        return "the drive has only maps";
    if (!played.throughput.view_s)
        return "too few moments were played";
    const double frame_s = *played.throughput.view_s, run_s = played.throughput.wall_s;
    if (affordable_moments(frame_s, run_s) == 0 && affordable_moments(frame_s, std::numeric_limits<double>::infinity()) > 0)
        return "too few moments were played: it would take more than a fifth of their time";
    if (affordable_moments(frame_s, run_s) == 0)
        return fmt::format("a frame takes {:.0f} ms, and seven rounds more than two seconds", 1e3 * *played.throughput.view_s);
    return "";
}

PruningSavings measure_savings(const Stage& stage, const LampSet& lamp_set, const PlayedCell& played, int first_tick, Renderer& pruned,
                               Renderer& unpruned) {
    PruningSavings savings;
    const int count = std::min(played.ticks_done, affordable_moments(played.throughput.view_s.value(), played.throughput.wall_s));
    for (const int tick : ticks_over(played.ticks_done, count))
        savings.ticks.push_back(first_tick + tick);
    const std::vector<Moment> moments = moments_at(savings.ticks, stage, lamp_set);
    const View& view = *driver_view(stage.drive);
    const std::vector<TimedTechnique> both{timed(pruned, moments, view, savings.pruned), timed(unpruned, moments, view, savings.unpruned)};
    TimingOptions options;
    options.moments = moments.size();
    options.rounds = rounds;
    options.warm_up_plays = 1;
    options.frame_by_frame = false;
    options.seed = stage.drive.seed;
    const InterleavedTimes timing = time_interleaved(both, options, real_clocks());
    savings.pruned_s = timing.samples[0].frame_s;
    savings.unpruned_s = timing.samples[1].frame_s;
    return savings;
}

} // namespace fernlicht
