#include "runner/experiments/run/run_json.h"

#include "runner/files/value_json.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

/// Extents per moment are stored to a tenth of a millimetre: far below the grid's own error, a third of the bytes.
double rounded(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

/// Values by name, then the reasons of those that are null.
Json with_reasons(Json entry, const std::vector<std::pair<const char*, Value>>& values) {
    Json reasons;
    for (const auto& [name, value] : values) {
        entry[name] = value_json(value);
        if (!value.measured())
            reasons[name] = value.reason();
    }
    if (!reasons.is_null())
        entry["not_measured"] = std::move(reasons);
    return entry;
}

/// nullptr where no moment gave anything.
Json spread_json(const ManyMoments& moments) {
    if (moments.count() == 0)
        return nullptr;
    return with_reasons(Json::object({{"count", moments.count()}}), {{"median", moments.quantile(0.5)},
                                                                     {"p05", moments.quantile(0.05)},
                                                                     {"p95", moments.quantile(0.95)},
                                                                     {"minimum", moments.quantile(0.0)},
                                                                     {"maximum", moments.quantile(1.0)},
                                                                     {"mean", moments.mean()},
                                                                     {"standard_deviation", moments.standard_deviation()}});
}

Json key_json(const ExtentKey& key) { return {{"plane", plane_name(key.plane)}, {"lane", key.lane}, {"limit_lx", key.limit_lx}}; }

using ExtentsOfRow = std::vector<LaneExtent> ExtentRow::*;

/// An entry per moment.
template <class Entry> Json column(const PlayedVariant& played, const Entry& entry) {
    Json out = Json::array();
    for (const ExtentRow& row : played.extents)
        out.push_back(entry(row));
    return out;
}

/// One column per quantity, one entry per moment; null where the lane is not there.
Json series_json(const PlayedVariant& played, ExtentsOfRow source, const ExtentKey& key) {
    const auto of_extent = [&](const auto& entry) {
        return column(played, [&](const ExtentRow& row) {
            const LaneExtent* const extent = find_extent(row.*source, key);
            return extent ? Json(entry(*extent)) : Json(nullptr);
        });
    };
    const auto metres = [&](double LaneExtent::*quantity) {
        return of_extent([&](const LaneExtent& extent) { return rounded(extent.*quantity); });
    };
    bool same_direction = true;
    std::set<double> distances_m;
    for (const ExtentRow& row : played.extents)
        if (const LaneExtent* const extent = find_extent(row.*source, key)) {
            same_direction = extent->same_direction;
            for (const LaneExtent::Width& width : extent->widths)
                distances_m.insert(width.at_m);
        }
    Json out = key_json(key);
    out["same_direction"] = same_direction;
    out["reach_centre_m"] = metres(&LaneExtent::reach_centre_m);
    out["reach_left_edge_m"] = metres(&LaneExtent::reach_left_edge_m);
    out["reach_right_edge_m"] = metres(&LaneExtent::reach_right_edge_m);
    out["unlit_before_reach_m"] = metres(&LaneExtent::unlit_before_reach_m);
    out["reach_is_cut_off"] = of_extent([](const LaneExtent& extent) { return extent.reach_is_cut_off; });
    out["area_m2"] = metres(&LaneExtent::area_m2);
    out["widths"] = Json::array();
    for (const double at_m : distances_m) {
        const auto width = [&](double LaneExtent::Width::*quantity) {
            return of_extent([&](const LaneExtent& extent) {
                const auto found = std::ranges::find(extent.widths, at_m, &LaneExtent::Width::at_m);
                return found == extent.widths.end() ? Json(nullptr) : Json(rounded((*found).*quantity));
            });
        };
        out["widths"].push_back({{"at_m", at_m},
                                 {"left_m", width(&LaneExtent::Width::left_m)},
                                 {"right_m", width(&LaneExtent::Width::right_m)},
                                 {"width_m", width(&LaneExtent::Width::width_m)}});
    }
    return out;
}

/// Sensitivities or grid errors of the own lane: one column per quantity of each (plane, limit).
template <class Entry> Json columns_json(const PlayedVariant& played, std::vector<Entry> ExtentRow::*entries,
                                         const std::vector<std::pair<const char*, std::optional<double> (*)(const Entry&)>>& quantities) {
    std::vector<std::pair<ExtentPlane, double>> keys;
    for (const ExtentRow& row : played.extents)
        for (const Entry& entry : row.*entries)
            if (std::ranges::find(keys, std::pair(entry.plane, entry.limit_lx)) == keys.end())
                keys.emplace_back(entry.plane, entry.limit_lx);
    Json out = Json::array();
    for (const auto& [plane, limit_lx] : keys) {
        Json columns{{"plane", plane_name(plane)}, {"limit_lx", limit_lx}};
        for (const auto& [name, quantity] : quantities)
            columns[name] = column(played, [&, on = plane, limit = limit_lx, of = quantity](const ExtentRow& row) {
                for (const Entry& entry : row.*entries)
                    if (entry.plane == on && entry.limit_lx == limit)
                        if (const std::optional<double> value = of(entry))
                            return Json(rounded(*value));
                return Json(nullptr);
            });
        out.push_back(std::move(columns));
    }
    return out;
}

Json short_value_json(const Value& value) {
    switch (value.kind()) {
    case Value::Kind::at_least:
        return value_json(Value::at_least(seven_digits(value.low())));
    case Value::Kind::at_most:
        return value_json(Value::at_most(seven_digits(value.high())));
    case Value::Kind::number:
        return seven_digits(value.low());
    case Value::Kind::not_measured:
        break;
    }
    return nullptr;
}

constexpr const char* state_names[] = {"fresh", "stale", "missing", "out_of_range", "contradictory"};

/// Seven digits, as other columns have; times six places, as candump has.
Json shortened(const std::optional<double>& value) { return value ? Json(seven_digits(*value)) : Json(nullptr); }
Json microseconds(const std::optional<double>& value) { return value ? Json(std::stod(fmt::format("{:.6f}", *value))) : Json(nullptr); }

Json counts_by_state(const std::array<std::uint64_t, 5>& counts) {
    Json json;
    for (std::size_t state = 0; state < counts.size(); ++state)
        json[state_names[state]] = counts[state];
    return json;
}

Json input_json(const BusSignalReport& signal) {
    Json policies = Json::object();
    for (std::size_t state = 0; state < signal.policies.size(); ++state)
        if (!signal.policies[state].empty())
            policies[state_names[state]] = signal.policies[state];
    const auto state_json = [](const auto& state) {
        return Json{{"from_s", microseconds(state.first)}, {"state", state_names[state.second]}};
    };
    return {{"name", signal.name},
            {"source", signal.source},
            {"also", signal.also.empty() ? Json(nullptr) : Json(signal.also)},
            {"tolerance", shortened(signal.tolerance)},
            {"unit", signal.unit},
            {"frames", signal.frames},
            {"changes", signal.changes},
            {"age_max_s", microseconds(signal.frames > 0 ? std::optional(signal.oldest_s) : std::nullopt)},
            {"stale_after_s", microseconds(signal.stale_after_s)},
            {"last_change_s", microseconds(signal.changed_s)},
            {"ticks", counts_by_state(signal.ticks)},
            {"policy_acted", counts_by_state(signal.acted)},
            {"unchecked", signal.unchecked},
            {"policies", std::move(policies)},
            {"states", list_of(signal.states, state_json)},
            {"value", list_of(signal.value, shortened)},
            {"received", list_of(signal.received, shortened)}};
}

} // namespace

double seven_digits(double value) { return std::stod(fmt::format("{:.7g}", value)); }

Json summary_json(const PlayedVariant& played) {
    Json out = Json::array();
    for (const ExtentSummary& summary : played.extent_summaries) {
        Json entry = key_json(summary.key);
        entry["moments"] = summary.reach.count();
        entry["moments_cut_off"] = summary.cut_off;
        entry["reach_m"] = spread_json(summary.reach);
        entry["widths_m"] = Json::array();
        for (const auto& [at_m, moments] : summary.widths)
            entry["widths_m"].push_back({{"at_m", at_m}, {"width_m", spread_json(moments)}});
        entry["area_m2"] = spread_json(summary.area);
        std::vector<std::pair<const char*, Value>> trust{{"largest_twin_difference_m", summary.twin_difference.quantile(1.0)}};
        if (summary.key.lane == "own")
            trust.insert(trust.end(), {{"metres_per_tenth_degree", summary.per_tenth_degree.quantile(0.5)},
                                       {"metres_per_tenth_flux", summary.per_tenth_flux.quantile(0.5)},
                                       {"grid_error_m", summary.grid_error.quantile(0.5)}});
        entry = with_reasons(std::move(entry), trust);
        out.push_back(std::move(entry));
    }
    return out;
}

Json extents_json(const PlayedVariant& played) {
    Json out{{"frame", column(played, [](const ExtentRow& row) { return row.tick; })},
             {"time_s", column(played, [](const ExtentRow& row) { return rounded(row.time_s); })},
             {"distance_m", column(played, [](const ExtentRow& row) { return rounded(row.distance_m); })}};
    for (const auto& [name, source] : {std::pair("rendered", &ExtentRow::rendered), std::pair("twin", &ExtentRow::twin)}) {
        out[name] = Json::array();
        for (const ExtentKey& key : extent_keys(played))
            if (std::ranges::any_of(played.extents,
                                    [&, of = source](const ExtentRow& row) { return find_extent(row.*of, key) != nullptr; }))
                out[name].push_back(series_json(played, source, key));
    }
    out["sensitivity"] = columns_json<ReachSensitivity>(
        played, &ExtentRow::sensitivity,
        {{"metres_per_tenth_degree", [](const ReachSensitivity& of) -> std::optional<double> { return of.metres_per_tenth_degree; }},
         {"metres_per_tenth_flux", [](const ReachSensitivity& of) -> std::optional<double> { return of.metres_per_tenth_flux; }}});
    out["grid_error"] = columns_json<GridError>(played, &ExtentRow::grid_errors,
                                                {{"reach_m", [](const GridError& of) { return of.reach_m; }},
                                                 {"area_m2", [](const GridError& of) -> std::optional<double> { return of.area_m2; }}});
    return out;
}

Json seeing_json(const std::vector<SeeingSeries>& all) {
    Json out = Json::array();
    for (const SeeingSeries& series : all) {
        Json at = Json::array(), columns = Json::array();
        for (const double at_m : series.at_m)
            at.push_back(rounded(at_m));
        for (const SeeingSeries::Column& column : series.columns) {
            Json values = Json::array();
            std::set<std::string> reasons;
            for (const Value& value : column.values) {
                values.push_back(short_value_json(value));
                if (!value.measured())
                    reasons.insert(value.reason());
            }
            columns.push_back({{"name", column.name}, {"what", column.label}, {"unit", column.unit}, {"values", std::move(values)}});
            if (!reasons.empty())
                columns.back()["not_measured"] = reasons;
        }
        out.push_back({{"subject", series.subject}, {"over", series.over}, {"frame", series.ticks}, {"at_m", at}, {"columns", columns}});
    }
    return out;
}

nlohmann::ordered_json signals_json(const BusReport& bus) {
    const auto stamp_json = [](const SignalStamp& signal) {
        return Json{{"name", signal.name},
                    {"unit", signal.unit},
                    {"last_change_s", microseconds(signal.changed_s)},
                    {"age_s", microseconds(signal.age_s)}};
    };
    return {{"log", bus.log.empty() ? Json(nullptr) : Json(bus.log)},
            {"start_s", microseconds(bus.start_s)},
            {"frames", bus.frames},
            {"frames_read", bus.read},
            {"frames_sent", bus.sent},
            {"frame", bus.frame},
            {"inputs", list_of(bus.signals, input_json)},
            {"all", list_of(bus.all, stamp_json)}};
}

} // namespace fernlicht
