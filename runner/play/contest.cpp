#include "runner/play/contest.h"

#include "metrics/statistics/statistics.h"
#include "runner/play/machine_load.h"

#include <chrono>

namespace fernlicht {
namespace {

/// All moments without a pause, as a simulator draws them that waits for nothing.
void play_back_to_back(const Contestant& contestant, const ContestOptions& options, const ContestClocks& clocks, ContestSamples& samples) {
    const bool gpu = static_cast<bool>(clocks.gpu_s);
    const auto frames = static_cast<double>(options.moments);
    const double cpu_s = clocks.cpu_s(), wall_s = clocks.wall_s();
    for (std::size_t moment = 0; moment < options.moments; ++moment) {
        if (gpu)
            clocks.gpu_begin();
        contestant.draw(moment);
        if (gpu)
            clocks.gpu_end();
    }
    contestant.finish();
    samples.frame_s.push_back((clocks.wall_s() - wall_s) / frames);
    samples.cpu_s.push_back((clocks.cpu_s() - cpu_s) / frames);
    if (gpu)
        samples.gpu_s.push_back(clocks.gpu_s() / frames);
}

void play_frame_by_frame(const Contestant& contestant, const ContestOptions& options, const ContestClocks& clocks,
                         ContestSamples& samples) {
    for (std::size_t moment = 0; moment < options.moments; ++moment) {
        const double wall_s = clocks.wall_s();
        contestant.draw(moment);
        contestant.finish();
        samples.latency_s.push_back(clocks.wall_s() - wall_s);
    }
}

} // namespace

ContestClocks real_clocks() {
    ContestClocks clocks;
    clocks.wall_s = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
    clocks.cpu_s = own_cpu_s;
    return clocks;
}

Contest hold_contest(const std::vector<Contestant>& contestants, const ContestOptions& options, const ContestClocks& clocks) {
    Contest contest;
    contest.samples.resize(contestants.size());
    for (const Contestant& contestant : contestants) {
        if (options.stop())
            return contest;
        for (std::size_t play = 0; play < options.warm_up_plays; ++play)
            for (std::size_t moment = 0; moment < options.moments; ++moment)
                contestant.draw(moment);
        contestant.finish();
    }
    std::mt19937_64 chance(options.seed);
    for (std::size_t round = 0; round < options.rounds && options.go_on(round); ++round) {
        contest.orders.push_back(random_order(contestants.size(), chance));
        for (const std::size_t i : contest.orders.back()) {
            play_back_to_back(contestants[i], options, clocks, contest.samples[i]);
            if (options.frame_by_frame)
                play_frame_by_frame(contestants[i], options, clocks, contest.samples[i]);
        }
    }
    return contest;
}

} // namespace fernlicht
