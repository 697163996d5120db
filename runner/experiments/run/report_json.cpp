#include "metrics/display/seen_display.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/experiments/bench/bench_result.h"
#include "runner/experiments/run/report_writers.h"
#include "runner/experiments/run/signals_json.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"
#include "runner/files/value_json.h"
#include "runner/findings/context_json.h"
#include "runner/findings/extent_keys.h"
#include "runner/judge/verdict_json.h"
#include "runner/play/drawn_by.h"
#include "runner/play/live/live_figures.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/shown_picture.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/keys/shadow_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <stdexcept>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

double finite(double value, const char* what) {
    if (!std::isfinite(value))
        throw std::logic_error(fmt::format("report: {} is {}; a measurement that cannot be made is not_measured", what, value));
    return value;
}

/// Extents per moment are stored to a tenth of a millimetre: far below the grid's own error, a third of the bytes.
double rounded(double value, const char* what) { return std::round(finite(value, what) * 1e4) / 1e4 + 0.0; }

Json pairs(const std::vector<std::pair<std::string, std::string>>& texts) {
    Json out = Json::object();
    for (const auto& [name, text] : texts)
        out[name] = text;
    return out;
}

Json optional_number(const std::optional<double>& value, const char* what) { return value ? Json(finite(*value, what)) : Json(nullptr); }

Json spread_json(const std::optional<Spread>& spread) {
    if (!spread)
        return nullptr;
    return {{"count", spread->count},
            {"median", finite(spread->median, "median")},
            {"p05", finite(spread->p05, "p05")},
            {"p95", finite(spread->p95, "p95")},
            {"minimum", finite(spread->minimum, "minimum")},
            {"maximum", finite(spread->maximum, "maximum")},
            {"mean", finite(spread->mean, "mean")},
            {"standard_deviation", finite(spread->standard_deviation, "standard deviation")}};
}

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

Json rows_json(const Report& report) {
    Json rows = Json::array();
    for (const PlayedVariant& played : report.played)
        for (const Reading& reading : played.readings) {
            Json row{{"name", reading.name()},
                     {"value", value_json(reading.value)},
                     {"unit", reading.unit()},
                     {"where", reading.where},
                     {"frame", reading.tick < 0 ? Json(nullptr) : Json(reading.tick)},
                     {"drive", played.drive},
                     {"variant", played.variant}};
            if (!reading.value.measured())
                row["not_measured"] = reading.value.reason();
            rows.push_back(std::move(row));
        }
    return rows;
}

Json key_json(const ExtentKey& key) {
    return {{"plane", plane_name(key.plane)}, {"lane", key.lane}, {"limit_lx", finite(key.limit_lx, "limit")}};
}

Json summary_json(const PlayedVariant& played) {
    Json out = Json::array();
    for (const ExtentSummary& summary : played.extent_summaries) {
        Json entry = key_json(summary.key);
        entry["moments"] = summary.reach.count();
        entry["moments_cut_off"] = summary.cut_off;
        entry["reach_m"] = spread_json(summary.reach);
        entry["widths_m"] = Json::array();
        for (const auto& [at_m, moments] : summary.widths)
            entry["widths_m"].push_back({{"at_m", finite(at_m, "width's distance")}, {"width_m", spread_json(moments)}});
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

using ExtentsOfRow = std::vector<LaneExtent> ExtentRow::*;

/// One column per quantity, one entry per moment; null where the lane is not there.
Json series_json(const PlayedVariant& played, ExtentsOfRow source, const ExtentKey& key) {
    Json reach = Json::array(), left_edge = Json::array(), right_edge = Json::array(), unlit = Json::array(), cut_off = Json::array(),
         area = Json::array();
    std::map<double, std::array<Json, 3>> widths; // left, right, width by distance ahead
    std::size_t moment = 0;
    bool same_direction = true;
    for (const ExtentRow& row : played.extents) {
        const LaneExtent* const extent = find_extent(row.*source, key);
        const auto metres = [&](double value, const char* what) { return extent ? Json(rounded(value, what)) : Json(nullptr); };
        static const LaneExtent nothing;
        const LaneExtent& shown = extent ? *extent : nothing;
        same_direction = extent ? extent->same_direction : same_direction;
        reach.push_back(metres(shown.reach_centre_m, "reach"));
        left_edge.push_back(metres(shown.reach_left_edge_m, "reach at the left edge"));
        right_edge.push_back(metres(shown.reach_right_edge_m, "reach at the right edge"));
        unlit.push_back(metres(shown.unlit_before_reach_m, "unlit length"));
        cut_off.push_back(extent ? Json(extent->reach_is_cut_off) : Json(nullptr));
        area.push_back(metres(shown.area_m2, "area"));
        for (const LaneExtent::Width& width : shown.widths) {
            auto& columns = widths[finite(width.at_m, "width's distance")];
            const std::array<double, 3> values{width.left_m, width.right_m, width.width_m};
            for (std::size_t i = 0; i < columns.size(); ++i) {
                if (columns[i].is_null())
                    columns[i] = Json::array();
                while (columns[i].size() < moment)
                    columns[i].push_back(nullptr);
                columns[i].push_back(rounded(values[i], "width"));
            }
        }
        ++moment;
    }
    Json out = key_json(key);
    out["same_direction"] = same_direction;
    out["reach_centre_m"] = reach;
    out["reach_left_edge_m"] = left_edge;
    out["reach_right_edge_m"] = right_edge;
    out["unlit_before_reach_m"] = unlit;
    out["reach_is_cut_off"] = cut_off;
    out["area_m2"] = area;
    out["widths"] = Json::array();
    for (auto& [at_m, columns] : widths) {
        for (Json& column : columns)
            while (column.size() < moment)
                column.push_back(nullptr);
        out["widths"].push_back({{"at_m", at_m}, {"left_m", columns[0]}, {"right_m", columns[1]}, {"width_m", columns[2]}});
    }
    return out;
}

/// Sensitivities or grid errors of the own lane: one column per quantity of each (plane, limit).
template <class Entry> Json columns_json(const PlayedVariant& played, std::vector<Entry> ExtentRow::*entries,
                                         const std::vector<std::pair<const char*, std::optional<double> (*)(const Entry&)>>& quantities) {
    std::vector<std::pair<ExtentPlane, double>> keys;
    for (const ExtentRow& row : played.extents)
        for (const Entry& entry : row.*entries)
            if (std::find(keys.begin(), keys.end(), std::pair(entry.plane, entry.limit_lx)) == keys.end())
                keys.emplace_back(entry.plane, entry.limit_lx);
    Json out = Json::array();
    for (const auto& [plane, limit_lx] : keys) {
        Json columns{{"plane", plane_name(plane)}, {"limit_lx", finite(limit_lx, "limit")}};
        for (const auto& [name, quantity] : quantities) {
            Json column = Json::array();
            for (const ExtentRow& row : played.extents) {
                const auto found = std::find_if((row.*entries).begin(), (row.*entries).end(),
                                                [&](const Entry& entry) { return entry.plane == plane && entry.limit_lx == limit_lx; });
                const std::optional<double> value = found == (row.*entries).end() ? std::nullopt : quantity(*found);
                column.push_back(value ? Json(rounded(*value, name)) : Json(nullptr));
            }
            columns[name] = std::move(column);
        }
        out.push_back(std::move(columns));
    }
    return out;
}

Json extents_json(const PlayedVariant& played) {
    Json frames = Json::array(), time = Json::array(), distance = Json::array();
    for (const ExtentRow& row : played.extents) {
        frames.push_back(row.tick);
        time.push_back(rounded(row.time_s, "time"));
        distance.push_back(rounded(row.distance_m, "distance"));
    }
    Json out{{"frame", frames}, {"time_s", time}, {"distance_m", distance}, {"rendered", Json::array()}, {"twin", Json::array()}};
    for (const ExtentKey& key : extent_keys(played)) {
        const auto occurs = [&](ExtentsOfRow source) {
            return std::any_of(played.extents.begin(), played.extents.end(),
                               [&](const ExtentRow& row) { return find_extent(row.*source, key) != nullptr; });
        };
        if (occurs(&ExtentRow::rendered))
            out["rendered"].push_back(series_json(played, &ExtentRow::rendered, key));
        if (occurs(&ExtentRow::twin))
            out["twin"].push_back(series_json(played, &ExtentRow::twin, key));
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

/// Seven digits: far below what any of the lamp tables knows.
double seven_digits(double value) { return std::stod(fmt::format("{:.7g}", value)); }

Json seven_digits(double value, const std::string& what) { return seven_digits(finite(value, what.c_str())); }

Json seven_digits(const Value& value) {
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

/// Columns with one entry per moment; null where it was not measured, with the reasons that there are.
Json seeing_json(const std::vector<SeeingSeries>& all) {
    Json out = Json::array();
    for (const SeeingSeries& series : all) {
        Json at = Json::array(), columns = Json::array();
        for (const double at_m : series.at_m)
            at.push_back(rounded(at_m, series.over.c_str()));
        for (const SeeingSeries::Column& column : series.columns) {
            Json values = Json::array();
            std::set<std::string> reasons;
            for (const Value& value : column.values) {
                values.push_back(seven_digits(value));
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

Json contact_sheet_json(const StoredFrame& sheet) {
    if (sheet.png.empty())
        return nullptr;
    return {{"frame", sheet.tick}, {"time_s", finite(sheet.time_s, "time")}, {"png", sheet.png}};
}

Json more_sheets_json(const std::vector<StoredSheet>& sheets) {
    Json out = Json::array();
    for (const StoredSheet& sheet : sheets)
        out.push_back({{"what", sheet.what},
                       {"frame", sheet.picture.tick},
                       {"time_s", finite(sheet.picture.time_s, "time")},
                       {"png", sheet.picture.png}});
    return out;
}

Json shadow_choice_json(const ShadowChoice& choice) {
    Json tried = Json::array();
    for (const TriedShadows& one : choice.tried) {
        Json row{{"method", name(one.method)}};
        if (one.error) {
            row["error"] = finite(*one.error, "shadow error");
            row["worst_s"] = finite(one.worst_s, "time");
            row["worst_variant"] = one.worst_set;
            row["worst_view"] = one.worst_view;
            row["pictures"] = one.pictures;
        } else {
            row["refused"] = one.refused;
        }
        tried.push_back(std::move(row));
    }
    return {{"chosen", name(choice.chosen)},
            {"why", choice.why},
            {"error_bound", choice.bound},
            {"moments", choice.ticks},
            {"moments_shadowed", choice.ticks_shadowed},
            {"moments_compared", choice.compared},
            {"tried", tried}};
}

Json drawn_shadows_json(const DrawnBy& drawn) {
    Json settings = Json::object();
    for (const auto& [key, text] : used_shadow_keys(drawn.shadows)) // numbers and lists of them, which JSON writes as YAML does
        settings[std::string(key)] = Json::parse(text);
    return {{"method", name(drawn.shadows.method)},
            {"things_cast", drawn.shadows.things_cast},
            {"settings", settings},
            {"not_used", drawn.shadows_instead.empty() ? Json(nullptr) : Json(drawn.shadows_instead)}};
}

Json shown_by_json(const DrawnBy& drawn) {
    const DisplayProfile display = display_of(drawn);
    const bool has_s = drawn.tone_mapper.kind == ToneMapperKind::rational || drawn.tone_mapper.kind == ToneMapperKind::logarithmic;
    Json shown = Json::array();
    for (const double seen : {0.1, 1.0, 10.0})
        shown.push_back({{"seen_cdm2", seen}, {"shown_cdm2", seven_digits(shown_cdm2(drawn, seen), "luminance of the display")}});
    return {{"text", shown_by(drawn.display, drawn.tone_mapper)},
            {"tone_mapper", name(drawn.tone_mapper.kind)},
            {"s", has_s ? Json(finite(drawn.tone_mapper.s, "s")) : Json(nullptr)},
            {"white_cdm2", finite(drawn.tone_mapper.l_max_cdm2, "white")},
            {"display", display.name},
            {"gamut", display.gamut == GamutRule::clip ? "clip" : "keep-luminance"},
            {"peak_cdm2", seven_digits(display.peak_cdm2(), "peak")},
            {"black_cdm2", finite(display.black_cdm2, "black")},
            {"stages", display_stages(drawn)},
            {"luminances", shown}};
}

Json seen_display_json(const SeenDisplay& seen) {
    Json views = Json::array();
    for (const SeenView& view : seen.views) {
        const std::optional<double> resolved = view.resolved();
        Json row{{"view", view.view},
                 {"scene_pixel_arcmin", finite(view.size.scene_pixel_arcmin, "angle of a pixel")},
                 {"display_pixel_arcmin", finite(view.size.display_pixel_arcmin, "angle of a pixel")},
                 {"magnification", finite(view.size.magnification(), "magnification")},
                 {"life_size_m", finite(view.size.life_size_m, "viewing distance")},
                 {"finer_than_eye_by_day", view.finer_by_day()},
                 {"pictures", view.pictures},
                 {"mean_cdm2", optional_number(view.mean_cdm2, "luminance of the display")},
                 {"resolved_arcmin", optional_number(resolved, "what the eye resolves")},
                 {"finer_than_eye", resolved ? Json(view.size.display_pixel_arcmin <= *resolved) : Json(nullptr)}};
        if (!view.mean_cdm2)
            row["not_measured"] = "no picture of this view was shown by the profile";
        views.push_back(std::move(row));
    }
    return {{"profile", seen.profile},
            {"viewing_distance_m", finite(seen.viewing_distance_m, "viewing distance")},
            {"pixel_pitch_mm", finite(seen.pixel_pitch_mm, "pixel pitch")},
            {"views", views}};
}

/// Null where the run was told to leave it out.
Json accuracy_json(const DriveError& error) {
    if (!error.measured())
        return error.not_measured.empty() ? Json(nullptr) : Json{{"not_measured", error.not_measured}};
    Json out = {{"frames", error.ticks},
                {"width_px", error.width_px},
                {"height_px", error.height_px},
                {"rays", error.rays},
                {"road", errors_json(error.road, "", error.ticks)},
                {"road_p95_by_moment", error.road_p95},
                {"whole_view", errors_json(error.whole, "", error.ticks)},
                {"target", errors_json(error.target, error.no_target, error.ticks)},
                {"luminance", errors_json(error.luminance, error.no_luminance, error.ticks)},
                {"reach", reach_json(error.reach)}};
    if (error.lamp_radius_m > 0.0)
        out["lamp_radius_m"] = finite(error.lamp_radius_m, "radius of lamps");
    return out;
}

/// Columns with an entry per moment; only the actuators that the lamp set has.
Json car_json(const std::vector<CarRow>& rows) {
    Json columns;
    for (const CarRow& row : rows) {
        columns["time_s"].push_back(finite(row.time_s, "time"));
        columns["pitch_deg"].push_back(finite(row.pitch_deg, "pitch"));
        columns["rear_lift_mm"].push_back(finite(row.rear_lift_mm, "lift"));
        if (row.levelling_deg)
            columns["levelling_deg"].push_back(finite(*row.levelling_deg, "levelling"));
        if (row.swivel_deg)
            columns["swivel_deg"].push_back(finite(*row.swivel_deg, "swivel"));
    }
    return columns;
}

/// What comparing took, and what a frame takes.
Json accuracy_times_json(const Report& report) {
    Json out = Json::array();
    for (const PlayedVariant& played : report.played)
        if (played.error.measured())
            out.push_back({{"drive", played.drive},
                           {"variant", played.variant},
                           {"frame_s", optional_number(played.throughput.view_s, "time a frame")},
                           {"comparing_s", finite(played.error.seconds, "time of comparing")}});
    return out;
}

Json timing_json(const Report& report) {
    Json out = Json::array();
    for (const PlayedVariant& played : report.played)
        for (const PassTime& pass : played.passes) {
            Json samples = Json::array();
            for (const double seconds : pass.seconds)
                samples.push_back(finite(seconds, "a time"));
            out.push_back({{"drive", played.drive},
                           {"variant", played.variant},
                           {"pass", pass.name},
                           {"warm_up_dropped", played.warm_up_dropped},
                           {"spread_s", spread_json(spread_of(pass.seconds))},
                           {"samples_s", samples}});
        }
    return out;
}

/// Rates per second, shares of what drawing alone would reach.
Json throughput_json(const Report& report) {
    Json out = Json::array();
    for (const PlayedVariant& played : report.played) {
        const Throughput& t = played.throughput;
        const auto per_s = [](const std::optional<double>& seconds) { return seconds ? std::optional(1.0 / *seconds) : std::nullopt; };
        out.push_back({{"drive", played.drive},
                       {"variant", played.variant},
                       {"moments", t.moments},
                       {"wall_s", finite(t.wall_s, "wall time")},
                       {"moments_per_s", optional_number(t.moments_per_s(), "moments per second")},
                       {"driver_view_alone_per_s", optional_number(per_s(t.view_s), "driver's views per second")},
                       {"all_drawing_alone_per_s", optional_number(per_s(t.drawing_s), "drawn moments per second")},
                       {"share_of_driver_view_alone", optional_number(t.share_of(t.view_s), "share of the driver's view")},
                       {"share_of_all_drawing_alone", optional_number(t.share_of(t.drawing_s), "share of all drawing")},
                       {"peak_memory_mib", finite(t.peak_memory_mib, "peak memory")}});
    }
    return out;
}

Json work_json(const Work& work) {
    return {
        {"passes", work.passes},     {"draws", work.draws},         {"calls", work.calls},         {"samplers", work.samplers},
        {"features", work.features}, {"triangles", work.triangles}, {"fragments", work.fragments}, {"texture_bytes", work.texture_bytes}};
}

/// Where nothing was measured, times and counts are null.
Json savings_json(const Report& report) {
    Json out = Json::array();
    for (const PlayedVariant& played : report.played) {
        const Savings& s = played.savings;
        const std::optional<PairedRatio> ratio = s.ratio();
        Json entry{{"drive", played.drive}, {"variant", played.variant}, {"frames", s.ticks}};
        for (const auto& [name, samples, work] :
             {std::tuple("pruned", &s.pruned_s, &s.pruned), std::tuple("unpruned", &s.unpruned_s, &s.unpruned)})
            entry[name] = ratio ? Json{{"spread_s", spread_json(spread_of(*samples))}, {"samples_s", *samples}, {"work", work_json(*work)}}
                                : Json(nullptr);
        entry["ratio"] = ratio ? Json{{"rounds", ratio->rounds},
                                      {"median", ratio->median},
                                      {"p05", ratio->p05},
                                      {"p95", ratio->p95},
                                      {"verdict", difference_name(ratio->difference)}}
                               : Json(nullptr);
        if (!ratio)
            entry["not_measured"] = s.not_measured;
        out.push_back(std::move(entry));
    }
    return out;
}

} // namespace

nlohmann::ordered_json played_json(const PlayedVariant& played) {
    Json frames = Json::array(), speed = Json::array();
    for (const StoredFrame& frame : played.frames)
        frames.push_back({{"frame", frame.tick},
                          {"time_s", finite(frame.time_s, "time")},
                          {"view", frame.view},
                          {"png", frame.png.empty() ? Json(nullptr) : Json(frame.png)},
                          {"exr", frame.exr.empty() ? Json(nullptr) : Json(frame.exr)}});
    for (const auto& [time_s, mps] : played.speed_mps)
        speed.push_back({finite(time_s, "time"), finite(mps, "speed")});
    Json json{{"drive", played.drive},
              {"variant", played.variant},
              {"technique", played.technique},
              {"lamps", pairs(played.lamps)},
              {"inputs", pairs(played.inputs)},
              {"ticks_planned", played.ticks_planned},
              {"ticks_done", played.ticks_done},
              {"repeats", repeats_json(played.repeats)},
              {"verdicts", verdicts_json(played.verdicts)},
              {"left_out", played.left_out},
              {"notes", played.notes},
              {"summary", summary_json(played)},
              {"frames", frames},
              {"contact_sheet", contact_sheet_json(played.contact_sheet)},
              {"speed_mps", speed},
              {"accuracy", accuracy_json(played.error)},
              {"extents", extents_json(played)}};
    if (played.drawn_by) {
        json["shadows"] = drawn_shadows_json(*played.drawn_by);
        json["shown_by"] = shown_by_json(*played.drawn_by);
    }
    if (played.shadows)
        json["shadow_choice"] = shadow_choice_json(*played.shadows);
    if (played.display)
        json["display"] = seen_display_json(*played.display);
    if (!played.more_sheets.empty())
        json["more_sheets"] = more_sheets_json(played.more_sheets);
    if (!played.seeing.empty())
        json["seeing"] = seeing_json(played.seeing);
    if (!played.car.empty())
        json["car"] = car_json(played.car);
    if (!played.bus.empty())
        json["signals"] = signals_json(played.bus);
    return json;
}

std::string report_json(const Report& report) {
    Json drives = Json::array();
    for (const PlayedVariant& played : report.played)
        drives.push_back(played_json(played));
    Json whole{{"schema", "fernlicht report"},
               {"schema_version", 1},
               {"verdict", verdict_name(overall(report))},
               {"verdict_counts", counts_json(count_verdicts(report))},
               {"known_failures", verdicts_json(report.listed)},
               {"warnings", report.warnings},
               {"complete", report.complete},
               {"interrupted", report.complete ? Json(nullptr) : Json(report.interrupted)},
               {"rows", rows_json(report)},
               {"drives", drives},
               {"context", context_json(report.context)},
               {"timing", timing_json(report)},
               {"throughput", throughput_json(report)},
               {"accuracy_times", accuracy_times_json(report)},
               {"savings", savings_json(report)}};
    if (report.live)
        whole["live"] = live_json(*report.live);
    return json_text(whole);
}

} // namespace fernlicht
