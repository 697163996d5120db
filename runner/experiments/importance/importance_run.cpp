#include "runner/experiments/importance/importance_run.h"

#include "runner/experiments/rating/rating_run.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace fernlicht {
namespace {

constexpr double tried_sizes[] = {0.001, 0.01, 0.03, 0.1};

ReadingKey reading_named(const std::string& name) {
    const std::optional<ReadingKey> key = key_of(name);
    if (!key)
        throw InputError({{}, 0, 0, "--reading"}, "found '" + printable(name) + "'", "a reading's name; `fernlicht readings` lists them");
    return *key;
}

struct Window {
    double left_deg = 180.0, right_deg = -180.0, bottom_deg = 90.0, top_deg = -90.0;
};

/// Where any of the gradients is not 0, with room round it that shows where in the beam that is.
Window window_of(const BeamGradient& gradient, const BeamGradient& mean) {
    constexpr double beside_deg = 5.0, above_deg = 2.0;
    Window window;
    for (const BeamGradient* const one : {&gradient, &mean})
        for (const LampGradient& lamp : *one)
            for (std::size_t i = 0; i < lamp.per_cd.size(); ++i)
                if (lamp.per_cd[i] != 0.0) {
                    const double h = lamp.file->table.h_deg[i % lamp.file->table.h_deg.size()];
                    const double v = lamp.file->table.v_deg[i / lamp.file->table.h_deg.size()];
                    window = {std::min(window.left_deg, h), std::max(window.right_deg, h), std::min(window.bottom_deg, v),
                              std::max(window.top_deg, v)};
                }
    return {std::floor(window.left_deg - beside_deg), std::ceil(window.right_deg + beside_deg), std::floor(window.bottom_deg - above_deg),
            std::ceil(window.top_deg + above_deg)};
}

std::vector<double> even_axis(double from, double to, double step) {
    const int count = static_cast<int>(std::round((to - from) / step));
    std::vector<double> axis;
    for (int i = 0; i <= count; ++i)
        axis.push_back(std::lerp(from, to, static_cast<double>(i) / count));
    return axis;
}

ImportanceLamp lamp_of(const LampGradient& gradient) {
    const CandelaTable& table = gradient.file->table;
    ImportanceLamp lamp{gradient.lamp, gradient.file->name};
    for (std::size_t i = 0; i < gradient.per_cd.size(); ++i) {
        const double per_cd = gradient.per_cd[i];
        lamp.per_percent += 0.01 * per_cd * table.cd[i];
        lamp.samples += per_cd != 0.0 ? 1U : 0U;
        if (std::abs(per_cd) > std::abs(lamp.per_cd)) {
            lamp.per_cd = per_cd;
            lamp.h_deg = table.h_deg[i % table.h_deg.size()];
            lamp.v_deg = table.v_deg[i / table.h_deg.size()];
        }
    }
    return lamp;
}

class SpotSearch {
  public:
    SpotSearch(const ReadingOfLight& reading, const std::vector<Moment>& moments, ImportanceResult& result)
        : reading_(reading), moments_(moments), result_(result) {}

    void find() {
        const Window window = window_of(result_.gradient, result_.mean_gradient);
        const double step_deg = std::max(0.05, (window.right_deg - window.left_deg) / 800.0);
        const std::vector<double> h_deg = even_axis(window.left_deg, window.right_deg, step_deg),
                                  v_deg = even_axis(window.bottom_deg, window.top_deg, step_deg);
        for (const BeamGradient* const gradient : {&result_.gradient, &result_.mean_gradient})
            for (const LampGradient& one : *gradient) {
                auto map = std::ranges::find(result_.maps, one.file, &ImportanceMap::file);
                if (map == result_.maps.end()) {
                    result_.maps.push_back({{},
                                            one.file,
                                            spot_map(result_.gradient, *one.file, h_deg, v_deg, result_.spot_deg),
                                            spot_map(result_.mean_gradient, *one.file, h_deg, v_deg, result_.spot_deg)});
                    map = result_.maps.end() - 1;
                }
                if (std::ranges::find(map->lamps, one.lamp) == map->lamps.end())
                    map->lamps.push_back(one.lamp);
            }
        for (const ImportanceMap& map : result_.maps)
            try_best(map);
    }

  private:
    /// Where it matters most, clear of one another, and what the drive reads with a spot there.
    void try_best(const ImportanceMap& map) {
        constexpr std::size_t most_spots = 4;  // two ends of a width, by two lamps
        constexpr double worth_telling = 0.25; // of the best
        const std::size_t first = result_.spots.size();
        std::vector<double> left = map.of_reading.per_cd;
        double best = 0.0;
        while (result_.spots.size() < first + most_spots) {
            const auto most = std::ranges::max_element(left, {}, [](double value) { return std::abs(value); });
            best = std::max(best, std::abs(*most));
            if (!(std::abs(*most) > worth_telling * best))
                return;
            const auto at = static_cast<std::size_t>(most - left.begin());
            const std::vector<double>&h_deg = map.of_reading.h_deg, &v_deg = map.of_reading.v_deg;
            const BeamSpot spot{h_deg[at % h_deg.size()], v_deg[at / h_deg.size()], result_.spot_deg};
            try_spot(map, spot);
            for (std::size_t i = 0; i < left.size(); ++i)
                if (spot.at(h_deg[i % h_deg.size()], v_deg[i / h_deg.size()]) > 0.0)
                    left[i] = 0.0;
        }
    }

    void try_spot(const ImportanceMap& map, const BeamSpot& spot) {
        ChangedTables tables;
        for (const LampGradient& one : result_.gradient)
            tables.push_back(one.file == map.file ? with_spot(one.file->table, spot, result_.spot_cd) : one.file->table);
        result_.spots.push_back({map.lamps, map.file->name, spot.h_deg, spot.v_deg, intensity_cd(map.file->table, spot.h_deg, spot.v_deg),
                                 foretold_change(result_.gradient, tables),
                                 difference(reading_.value(with_tables(moments_, result_.gradient, tables)), result_.value, result_.unit)});
    }

    const ReadingOfLight& reading_;
    const std::vector<Moment>& moments_;
    ImportanceResult& result_;
};

ImportanceCheck checked(double size, const std::vector<ForetoldChange>& changes) {
    ImportanceCheck check{size, static_cast<int>(changes.size())};
    double found = 0.0, error = 0.0;
    for (const ForetoldChange& change : changes) {
        if (!change.found.number()) {
            ++check.bounds;
            continue;
        }
        const double off = change.foretold - *change.found.number();
        found += *change.found.number() * *change.found.number();
        error += off * off;
        check.worst_error = std::max(check.worst_error, std::abs(off));
    }
    if (const double told = check.count - check.bounds; told > 0.0) {
        check.found_rms = std::sqrt(found / told);
        check.error_rms = std::sqrt(error / told);
    }
    return check;
}

} // namespace

std::optional<double> linear_to(const ImportanceResult& result) {
    std::optional<double> size;
    for (const ImportanceCheck& check : result.checks) {
        if (check.error_share() > linear_share || check.bounds > 0)
            break;
        size = check.size;
    }
    return size;
}

namespace {

/// What is played, and the reading of it.
struct PlayedReading {
    std::unique_ptr<Stage> stage;
    std::vector<Moment> moments;
    std::unique_ptr<ReadingOfLight> reading;
};

void name_reading(ImportanceResult& result, const ReadingKey& key) {
    result.reading = name_of(key);
    result.unit = unit_of(key);
    result.figure_unit = key.quantity == Quantity::sensor_reach ? "lx" : result.unit;
}

PlayedReading played_drive(const ImportanceRequest& request, ImportanceResult& result) {
    const ReadingKey key = reading_named(request.reading);
    name_reading(result, key);
    PlayedReading played{std::make_unique<Stage>(request.drive), {}, {}};
    const Stage& stage = *played.stage;
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.lamp_set);
    result.lamp_set = lamp_set.name;
    result.first_tick = std::max(0, request.ticks.first);
    const int count = ticks_to_play(stage.drive, request.ticks);
    if (count < 1)
        throw InputError({{}, 0, 0, "--frames"}, "found no moment of the drive",
                         fmt::format("some of 0 to {}", tick_count(stage.drive) - 1));
    std::vector<int> ticks(static_cast<std::size_t>(count));
    std::iota(ticks.begin(), ticks.end(), result.first_tick);
    played.moments = moments_at(ticks, stage, lamp_set);
    played.reading = std::make_unique<ReadingOfLight>(key, stage.drive, stage.route, played.moments, "--reading", &lamp_set);
    return played;
}

PlayedReading played_row(const ImportanceRequest::Row& asked, const std::string& lamp_set, ImportanceResult& result) {
    RatedRow row = rated_row(asked.rating, asked.name, asked.photometer, asked.lamps, lamp_set);
    result.lamp_set = row.lamp_set;
    PlayedReading played{std::move(row.stage), std::move(row.moments), {}};
    if (row.key) {
        name_reading(result, *row.key);
        played.reading = std::make_unique<ReadingOfLight>(*row.key, played.stage->drive, played.stage->route, played.moments, "--row");
    } else {
        result.reading =
            fmt::format("margin of {}, row {}{}", asked.rating.name, asked.name, asked.photometer.empty() ? "" : ", " + asked.photometer);
        result.unit = result.figure_unit = "%";
        played.reading = std::make_unique<ReadingOfLight>(row.lights);
    }
    return played;
}

} // namespace

ImportanceResult run_importance(const ImportanceRequest& request) {
    ImportanceResult result;
    const PlayedReading played = request.row ? played_row(*request.row, request.lamp_set, result) : played_drive(request, result);
    const Stage& stage = *played.stage;
    const std::vector<Moment>& moments = played.moments;
    const ReadingOfLight& reading = *played.reading;
    result.moments = static_cast<int>(moments.size());
    OutputFolder folder(request.folder);
    result.context = make_context({}, request.command, request.seed);
    if (request.row)
        add_inputs(result.context.inputs, request.row->rating.opened);
    for (const FilesRead* files : {&stage.drive.opened, &stage.network.opened})
        add_inputs(result.context.inputs, *files);
    result.drive = stage.drive.name;
    result.title = stage.drive.title;
    ReadingOfLight::Found found = reading.gradient(moments);
    result.value = found.value;
    result.why_not = found.value.reason();
    for (const ReadingOfLight::Decider& one : found.deciders) {
        const Moment& moment = moments[one.moment];
        result.deciders.push_back({moment.tick, moment.time_s, moment.distance_m, one.share, one.figure});
    }
    result.gradient = found.gradient;
    result.mean_gradient = reading.mean_gradient(moments);
    for (const LampGradient& lamp : result.gradient)
        result.lamps.push_back(lamp_of(lamp));
    if (result.decided()) {
        SpotSearch(reading, moments, result).find();
        if (request.check > 0) {
            const std::vector<double> sizes(std::begin(tried_sizes), std::end(tried_sizes));
            const auto tried = try_changes(reading, moments, found, sizes, request.check, request.seed);
            for (std::size_t i = 0; i < sizes.size(); ++i)
                result.checks.push_back(checked(sizes[i], tried[i]));
        }
    }
    request.write(result);
    folder.finish();
    return result;
}

} // namespace fernlicht
