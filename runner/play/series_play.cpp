#include "runner/play/series_play.h"

#include "metrics/folds/seeing_fold.h"
#include "metrics/folds/sensitivity_fold.h"
#include "runner/findings/summary.h"
#include "runner/play/extent_fold.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <iterator>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace fernlicht {
namespace {

constexpr std::size_t batch = 16;      // cars between two looks at whether to go on
constexpr int moments_of_medians = 10; // as few as tell what a median moves by: 200 cars take their time

struct SampledMoment {
    const Moment* moment;
    ExtentGrid grid; ///< of no points where the drive asks for no extent
};

/// Few moments tell what a median moves by, and nothing of what is smallest or largest of all.
Readings without_extremes(Readings readings) {
    std::erase_if(readings, [](const Reading& reading) {
        return reading.key.statistic != Statistic::none && reading.key.statistic != Statistic::median &&
               reading.key.statistic != Statistic::mean;
    });
    return readings;
}

class Cars {
  public:
    Cars(const Drive& drive, const Route& route, const LampSet& lamp_set, const TickRange& ticks)
        : drive_(drive), route_(route), lamp_set_(lamp_set), extent_(drive, route) {
        const int first = std::max(0, ticks.first), planned = ticks_to_play(drive, ticks);
        State state = start(drive);
        while (state.tick < first && state.tick + 1 < tick_count(drive))
            state = advance(state, drive);
        moments_.reserve(static_cast<std::size_t>(planned));
        for (int k = 0; k < planned; ++k, state = advance(state, drive)) {
            moments_.push_back(moment_at(state, drive, route, lamp_set));
            const Moment& moment = moments_.back();
            if (tells_sensitivity(k, planned, moments_of_medians))
                sampled_.push_back({&moment, drive.extent ? make_extent_grid(route, moment, drive.bumper_m, *drive.extent) : ExtentGrid{}});
        }
    }

    /// Lamps that shine at some moment.
    std::vector<std::string> lit() const {
        std::vector<std::string> names;
        for (const MountedLamp& lamp : lamp_set_.lamps)
            if (std::ranges::any_of(moments_, [&](const Moment& moment) {
                    return std::ranges::any_of(
                        moment.lamps, [&](const LitLamp& shining) { return shining.name == lamp.name && shining.intensity_factor > 0.0; });
                }))
                names.push_back(lamp.name);
        return names;
    }

    /// `draw`: of reach and width; nullptr: by the twin.
    Readings evaluate(const Nudge& nudge, const Draw* draw) const {
        Readings readings = seen(nudge);
        if (drive_.extent)
            std::ranges::move(extents(nudge, draw), std::back_inserter(readings));
        ProbeFold probes(drive_, route_);
        const Draw nothing = [](const Moment&, const View&, const FrameOutputs&) -> Pending { return [] { return Frame{}; }; };
        for (const SampledMoment& sampled : sampled_)
            probes.add(nudged(*sampled.moment, nudge), nothing);
        for (Reading& reading : probes.finish())
            if (reading.key.aspect == Aspect::twin) {
                reading.key.aspect = Aspect::value;
                readings.push_back(std::move(reading));
            }
        return readings;
    }

  private:
    Readings seen(const Nudge& nudge) const {
        SeeingFold every_moment(drive_, route_, nudge, SeeingPart::of_every_moment), medians(drive_, route_, nudge, SeeingPart::medians);
        for (const Moment& moment : moments_)
            every_moment.add(moment, lamp_set_);
        for (const SampledMoment& sampled : sampled_)
            medians.add(*sampled.moment, lamp_set_);
        Readings readings = every_moment.readings();
        std::ranges::move(without_extremes(medians.readings()), std::back_inserter(readings));
        return readings;
    }

    Readings extents(const Nudge& nudge, const Draw* draw) const {
        const ExtentParameters& p = *drive_.extent;
        PlayedCell played;
        played.extents.resize(sampled_.size());
        const auto measure = [&](std::size_t i) {
            const auto& [moment, grid] = sampled_[i];
            const Moment lit = nudged(*moment, nudge);
            ExtentRow& row = played.extents[i];
            if (draw) {
                row.rendered = extent_.rendered(extent_.draw(lit, *draw));
                return;
            }
            for (const Surface surface : {Surface::road, Surface::target})
                std::ranges::copy(measure_extent(grid, twin_lux_near_thresholds(grid, lit, surface, p.thresholds_lx), surface,
                                                 p.thresholds_lx, p.width_at_m),
                                  std::back_inserter(row.rendered));
        };
        if (draw)
            for (std::size_t i = 0; i < sampled_.size(); ++i)
                measure(i);
        else
            oneapi::tbb::parallel_for(std::size_t{0}, sampled_.size(), measure);
        played.extent_summaries = summarise_extents(played, p);
        return without_extremes(extent_readings(played));
    }

    const Drive& drive_;
    const Route& route_;
    const LampSet& lamp_set_;
    ExtentFold extent_;
    std::vector<Moment> moments_;
    std::vector<SampledMoment> sampled_;
};

} // namespace

SeriesFindings play_series(const Drive& drive, const Route& route, const LampSet& lamp_set, const TickRange& ticks, const Readings& played,
                           const Draw& draw, const std::function<bool(std::size_t done, std::size_t all)>& go_on) {
    const ToleranceParameters& tolerances = *drive.seeing.tolerances;
    const Cars cars(drive, route, lamp_set, ticks);
    const std::vector<CarPart> parts = varying_parts(tolerances, cars.lit(), drive.vehicle.has_value());
    std::size_t done = 0;
    const std::size_t all = 2 + 2 * parts.size() + static_cast<std::size_t>(tolerances.cars);
    const auto evaluate = [&](const std::vector<CarValues>& values, const Draw* drawn) {
        std::vector<Readings> readings;
        while (readings.size() < values.size() && go_on(done, all)) {
            const std::size_t from = readings.size(), count = std::min(batch, values.size() - from);
            readings.resize(from + count);
            const auto one = [&](std::size_t i) {
                readings[from + i] = cars.evaluate(nudge_of(parts, values[from + i], drive, lamp_set), drawn);
            };
            if (drawn)
                for (std::size_t i = 0; i < count; ++i)
                    one(i);
            else
                oneapi::tbb::parallel_for(std::size_t{0}, count, one);
            done += count;
        }
        return readings;
    };
    return measure_cars(
        tolerances, parts, played, [&](const std::vector<CarValues>& values) { return evaluate(values, nullptr); },
        [&](const std::vector<CarValues>& values) { return evaluate(values, tolerances.rendered ? &draw : nullptr); });
}

} // namespace fernlicht
