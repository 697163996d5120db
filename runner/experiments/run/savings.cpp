#include "runner/experiments/run/savings.h"

#include "runner/experiments/bench/bench_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int most_moments = 4, rounds = 7;
constexpr double most_s = 2.0;
/// What a moment costs, in pruned frames: the rounds, a warm-up and a count by both; unpruned frames take about a third longer.
constexpr double frames_a_moment = 2.3 * (rounds + 2);

/// Draws the moments as the bench does. `work` takes their counts.
Contestant contestant(Renderer& renderer, const std::vector<Moment>& moments, const View& view, Work& work) {
    static constexpr Wanted wanted{.colour = true};
    renderer.prepare(moments, view, wanted);
    std::vector<Work> counts;
    for (const Moment& moment : moments)
        counts.push_back(renderer.count(moment, view, wanted));
    work = typical_work(counts).value_or(Work{});
    return {[&](std::size_t moment) { renderer.render(moments[moment], view, wanted); }, [&] { renderer.finish(); }};
}

} // namespace

int affordable_moments(double frame_s) {
    const double affordable = most_s / (frames_a_moment * frame_s);
    return affordable >= most_moments ? most_moments : static_cast<int>(affordable);
}

std::string no_savings(const Drive& drive, const PlayedVariant& played) {
    if (drive.technique != pruned_technique)
        return fmt::format("it is measured for the technique photometric only, this is {}", drive.technique);
    if (!driver_view(drive))
        return "the drive has only maps";
    if (!played.throughput.view_s)
        return "too few moments were played";
    if (affordable_moments(*played.throughput.view_s) == 0)
        return fmt::format("a frame takes {:.0f} ms, and seven rounds more than two seconds", 1e3 * *played.throughput.view_s);
    return "";
}

Savings measure_savings(const Stage& stage, const Variant& variant, const PlayedVariant& played, int first_tick, Renderer& pruned,
                        Renderer& unpruned) {
    Savings savings;
    const int count = std::min(played.ticks_done, affordable_moments(played.throughput.view_s.value()));
    for (const int tick : ticks_over(played.ticks_done, count))
        savings.ticks.push_back(first_tick + tick);
    const std::vector<Moment> moments = moments_at(savings.ticks, stage, variant);
    const View& view = *driver_view(stage.drive);
    const std::vector<Contestant> both{contestant(pruned, moments, view, savings.pruned),
                                       contestant(unpruned, moments, view, savings.unpruned)};
    ContestOptions options;
    options.moments = moments.size();
    options.rounds = rounds;
    options.warm_up_plays = 1;
    options.frame_by_frame = false;
    options.seed = stage.drive.seed;
    const Contest contest = hold_contest(both, options, real_clocks());
    savings.pruned_s = contest.samples[0].frame_s;
    savings.unpruned_s = contest.samples[1].frame_s;
    return savings;
}

} // namespace fernlicht
