#include "runner/experiments/fit/fit_run.h"

#include "metrics/beam/cut_off.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/stage.h"
#include "scenarios/drives/keys/lamp_sets.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

FitOptions options_of(const FitRequest& request, const LampSet& lamp_set) {
    FitOptions options;
    std::vector<std::string> known;
    const auto quantities = {FitQuantity::pitch, FitQuantity::yaw, FitQuantity::flux, FitQuantity::height};
    for (const FitQuantity quantity : quantities)
        known.emplace_back(name_of(quantity));
    for (const MountedLamp& lamp : lamp_set.lamps)
        for (const FitQuantity quantity : quantities)
            known.push_back(lamp.name + "." + name_of(quantity));
    for (const std::string& text : request.hold) {
        if (std::ranges::find(known, text) == known.end())
            throw InputError({{}, 0, 0, "--hold"}, "found '" + printable(text) + "'", fmt::format("some of {}", fmt::join(known, ", ")));
        const std::size_t dot = text.rfind('.');
        const std::string word = text.substr(dot == std::string::npos ? 0 : dot + 1);
        for (const FitQuantity quantity : quantities)
            if (word == name_of(quantity))
                options.hold.emplace_back(dot == std::string::npos ? "" : text.substr(0, dot), quantity);
    }
    return options;
}

/// Readings placed in the world, and the car at their times.
struct PlacedReadings {
    std::vector<CarAtReading> cars;
    std::vector<LuxPoint> points;
    std::vector<bool> near_field; ///< by point
};

class Placing {
  public:
    Placing(const FitRequest& request, const Stage& stage, const LampSet& lamp_set)
        : request_(request), stage_(stage), lamp_set_(lamp_set) {}

    PlacedReadings place(const std::vector<LuxReading>& readings) {
        std::map<int, std::vector<std::size_t>> by_tick;
        for (std::size_t i = 0; i < readings.size(); ++i)
            by_tick[tick_of(readings[i])].push_back(i);
        placed_.points.resize(readings.size());
        placed_.near_field.resize(readings.size(), false);
        State state = start(stage_.drive);
        for (const auto& [tick, here] : by_tick) {
            while (state.tick < tick)
                state = advance(state, stage_.drive);
            const Moment moment = moment_at(state, stage_.drive, stage_.route, lamp_set_);
            placed_.cars.push_back({moment.ego, lamps_at(state, stage_.drive, lamp_set_), moment.weather});
            for (const std::size_t i : here)
                place_one(readings[i], moment, i);
        }
        return std::move(placed_);
    }

  private:
    [[noreturn]] void refuse(const LuxReading& reading, const char* column, const std::string& found, const std::string& expected) const {
        throw InputError({request_.points, reading.line, 0, column}, found, expected);
    }

    int tick_of(const LuxReading& reading) const {
        const int count = tick_count(stage_.drive);
        const double tick = std::round(reading.time_s / stage_.drive.step_s);
        if (!(tick < count))
            refuse(reading, "time_s", fmt::format("found {} s", reading.time_s),
                   fmt::format("0 to {:.3f} s, the drive's moments", (count - 1) * stage_.drive.step_s));
        return static_cast<int>(tick);
    }

    std::vector<std::size_t> lamps_of(const LuxReading& reading, const std::vector<MountedLamp>& lamps) const {
        std::vector<std::size_t> shone;
        for (const std::string& name : lamps_named(reading)) {
            const auto found = std::ranges::find(lamps, name, &MountedLamp::name);
            if (found == lamps.end())
                refuse(reading, "lamps", "found '" + printable(name) + "'",
                       fmt::format("lamps of the lamp set: {}", fmt::join(lamp_names(lamp_set_), ", ")));
            if (!(found->intensity_factor() > 0.0))
                refuse(reading, "lamps", "found '" + printable(name) + "'",
                       fmt::format("a lamp that is on: its level is 0 at {:g} s of the drive", reading.time_s));
            shone.push_back(static_cast<std::size_t>(found - lamps.begin()));
        }
        for (std::size_t lamp = 0; reading.lamps.empty() && lamp < lamps.size(); ++lamp)
            if (lamps[lamp].intensity_factor() > 0.0)
                shone.push_back(lamp);
        std::ranges::sort(shone);
        if (std::ranges::adjacent_find(shone) != shone.end())
            refuse(reading, "lamps", "found '" + printable(reading.lamps) + "'", "each lamp once");
        if (shone.empty())
            refuse(reading, "lamps", fmt::format("no lamp is on at {:g} s of the drive", reading.time_s), "a time at which one is");
        return shone;
    }

    void place_one(const LuxReading& reading, const Moment& moment, std::size_t i) {
        const CarAtReading& car = placed_.cars.back();
        LuxPoint& point = placed_.points[i];
        point.car = placed_.cars.size() - 1;
        point.place_m = to_parent(moment.wheels, {stage_.drive.bumper_m + reading.ahead_m, reading.left_m, reading.above_m});
        if (const std::optional<glm::dvec3> normal = normal_of(reading))
            point.normal = moment.wheels.axes * *normal;
        point.lamps = lamps_of(reading, car.lamps);
        point.lux = reading.lux;
        point.relative = 0.01 * reading.uncertainty_percent;
        point.absolute_lx = reading.uncertainty_lx;
        point.place_uncertainty_m = reading.place_uncertainty_m;
        for (const std::size_t lamp : point.lamps)
            if (glm::length(moment.lamps[lamp].pose.position_m - point.place_m) < moment.lamps[lamp].photometric_distance_m)
                placed_.near_field[i] = true;
    }

    const FitRequest& request_;
    const Stage& stage_;
    const LampSet& lamp_set_;
    PlacedReadings placed_;
};

double of_drive(const MountedLamp& lamp, FitQuantity quantity) {
    switch (quantity) {
    case FitQuantity::pitch:
        return degrees(lamp.pitch_rad);
    case FitQuantity::yaw:
        return degrees(lamp.yaw_rad);
    case FitQuantity::flux:
        return lamp.flux_factor;
    case FitQuantity::height:
        return lamp.position_m.z;
    }
    return 0.0;
}

void take(FitResult& result, const LampFit& fit, const std::vector<LuxReading>& readings, const LampSet& lamp_set) {
    const auto lamp_named = [&](const std::string& name) { return *std::ranges::find(lamp_set.lamps, name, &MountedLamp::name); };
    for (const FittedValue& value : fit.values)
        result.values.push_back({value, of_drive(lamp_named(value.lamp), value.quantity)});
    for (std::size_t row = 0; row < fit.covariance.rows; ++row) {
        const auto from = fit.covariance.values.begin() + static_cast<std::ptrdiff_t>(row * fit.covariance.columns);
        result.covariance.emplace_back(from, from + static_cast<std::ptrdiff_t>(fit.covariance.columns));
    }
    for (std::size_t i = 0; i < readings.size(); ++i)
        result.points.push_back({readings[i], fit.points[i], lamp_set.lamps[fit.points[i].lamp].name});
    for (const MountedLamp& lamp : lamp_set.lamps)
        if (std::ranges::find(fit.values, lamp.name, &FittedValue::lamp) == fit.values.end())
            result.not_lit.push_back(lamp.name);
    result.unknowns = fit.unknowns;
    result.used = fit.used;
    result.freedom = fit.freedom();
    result.iterations = fit.iterations;
    result.chi_squared = fit.chi_squared;
    result.chi_squared_limit = fit.chi_squared_limit;
    result.outlier_from = fit.outlier_from;
    result.error_scale = fit.error_scale;
    result.condition = fit.condition;
    result.consistent = fit.consistent();
    result.failed = fit.failed;
}

} // namespace

Drive as_fitted(Drive drive, const std::string& lamp_set, const Shifts& shifts) {
    for (LampSet& set : drive.lamp_sets) {
        if (set.name != lamp_set)
            continue;
        for (std::size_t i = 0; i < set.lamps.size(); ++i) {
            set.lamps[i] = shifted(set.lamps[i], shifts[i]);
            for (LampChange& change : set.changes)
                if (change.lamp == set.lamps[i].name) {
                    if (change.pitch_rad)
                        *change.pitch_rad += shifts[i][0];
                    if (change.yaw_rad)
                        *change.yaw_rad += shifts[i][1];
                }
        }
    }
    return drive;
}

FitResult run_fit(const FitRequest& request) {
    FilesRead opened;
    const std::vector<LuxReading> readings = read_lux_points(request.points, opened);
    const Stage stage(request.drive);
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.lamp_set);
    const FitOptions options = options_of(request, lamp_set);
    const PlacedReadings placed = Placing(request, stage, lamp_set).place(readings);
    OutputFolder folder(request.folder);
    FitResult result;
    result.context = make_context({}, request.command, request.drive.seed);
    for (const FilesRead* files : {&stage.drive.opened, &stage.network.opened, static_cast<const FilesRead*>(&opened)})
        add_inputs(result.context.inputs, *files);
    result.drive = stage.drive.name;
    result.title = stage.drive.title;
    result.lamp_set = lamp_set.name;
    result.points_file = request.points;
    const LampFit fit = fit_lamps(placed.cars, placed.points, options);
    take(result, fit, readings, lamp_set);
    if (const auto near = static_cast<std::size_t>(std::ranges::count(placed.near_field, true)); near > 0)
        result.notes.push_back(fmt::format("{} of {} points lie nearer than a lamp's photometric distance, where it is no point source",
                                           near, readings.size()));
    if (!fit.values.empty()) {
        const auto first = std::ranges::find(lamp_set.lamps, fit.values[0].lamp, &MountedLamp::name);
        result.cut_off_v_deg = measure_cut_off({&first->file->table, 0.0, 0.0}).level.inflection_deg;
    }
    result.fitted_drive = as_fitted(stage.drive, lamp_set.name, fit.shifts);
    request.write(result);
    folder.finish();
    return result;
}

} // namespace fernlicht
