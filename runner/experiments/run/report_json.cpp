#include "metrics/display/seen_display.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/experiments/bench/bench_result.h"
#include "runner/experiments/run/report_writers.h"
#include "runner/experiments/run/run_json.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"
#include "runner/files/value_json.h"
#include "runner/findings/context_json.h"
#include "runner/findings/extent_keys.h"
#include "runner/judge/verdict_json.h"
#include "runner/play/live/live_figures.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/shown_picture.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/keys/shadow_keys.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

/// Whoever measured what is no number owed a not_measured.
void refuse_no_numbers(const Json& json, const std::string& place) {
    if (json.is_number_float() && !std::isfinite(json.get<double>()))
        throw std::logic_error(
            fmt::format("report: {} is {}; a measurement that cannot be made is not_measured", place, json.get<double>()));
    if (json.is_object())
        for (const auto& [key, value] : json.items())
            refuse_no_numbers(value, place + "/" + key);
    else if (json.is_array())
        for (const Json& value : json)
            refuse_no_numbers(value, place);
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json pairs(const std::vector<std::pair<std::string, std::string>>& texts) {
    Json out = Json::object();
    for (const auto& [name, text] : texts)
        out[name] = text;
    return out;
}

Json spread_json(const std::optional<Spread>& spread) {
    if (!spread)
        return nullptr;
    return {{"count", spread->count},     {"median", spread->median},
            {"p05", spread->p05},         {"p95", spread->p95},
            {"minimum", spread->minimum}, {"maximum", spread->maximum},
            {"mean", spread->mean},       {"standard_deviation", spread->standard_deviation}};
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

Json contact_sheet_json(const StoredFrame& sheet) {
    if (sheet.png.empty())
        return nullptr;
    return {{"frame", sheet.tick}, {"time_s", sheet.time_s}, {"png", sheet.png}};
}

Json more_sheets_json(const std::vector<StoredSheet>& sheets) {
    return list_of(sheets, [](const StoredSheet& sheet) {
        return Json{{"what", sheet.what}, {"frame", sheet.picture.tick}, {"time_s", sheet.picture.time_s}, {"png", sheet.picture.png}};
    });
}

Json shadow_choice_json(const ShadowChoice& choice) {
    const auto tried = [](const TriedShadows& one) {
        if (!one.error)
            return Json{{"method", name(one.method)}, {"refused", one.refused}};
        return Json{{"method", name(one.method)},     {"error", *one.error},          {"worst_s", one.worst_s},
                    {"worst_variant", one.worst_set}, {"worst_view", one.worst_view}, {"pictures", one.pictures}};
    };
    return {{"chosen", name(choice.chosen)},
            {"why", choice.why},
            {"error_bound", choice.bound},
            {"moments", choice.ticks},
            {"moments_shadowed", choice.ticks_shadowed},
            {"moments_compared", choice.compared},
            {"tried", list_of(choice.tried, tried)}};
}

Json drawn_shadows_json(const DrawnBy& drawn) {
    Json settings = Json::object();
    for (const auto& [key, text] : used_shadow_keys(drawn.shadows)) // numbers and lists of them, which JSON writes as YAML does
        settings[std::string(key)] = Json::parse(text);
    return {{"method", name(drawn.shadows.method)},
            {"things_cast", drawn.shadows.things_cast},
            {"settings", settings},
            {"not_used", text_or_null(drawn.shadows_instead)}};
}

Json shown_by_json(const DrawnBy& drawn) {
    const DisplayProfile display = display_of(drawn);
    const bool has_s = drawn.tone_mapper.kind == ToneMapperKind::rational || drawn.tone_mapper.kind == ToneMapperKind::logarithmic;
    const auto shown = [&](double seen) { return Json{{"seen_cdm2", seen}, {"shown_cdm2", seven_digits(shown_cdm2(drawn, seen))}}; };
    return {{"text", shown_by(drawn.display, drawn.tone_mapper)},
            {"tone_mapper", name(drawn.tone_mapper.kind)},
            {"s", has_s ? Json(drawn.tone_mapper.s) : Json(nullptr)},
            {"white_cdm2", drawn.tone_mapper.l_max_cdm2},
            {"display", display.name},
            {"gamut", display.gamut == GamutRule::clip ? "clip" : "keep-luminance"},
            {"peak_cdm2", seven_digits(display.peak_cdm2())},
            {"black_cdm2", display.black_cdm2},
            {"stages", display_stages(drawn)},
            {"luminances", list_of(std::array{0.1, 1.0, 10.0}, shown)}};
}

Json seen_display_json(const SeenDisplay& seen) {
    Json views = Json::array();
    for (const SeenView& view : seen.views) {
        const std::optional<double> resolved = view.resolved();
        Json row{{"view", view.view},
                 {"scene_pixel_arcmin", view.size.scene_pixel_arcmin},
                 {"display_pixel_arcmin", view.size.display_pixel_arcmin},
                 {"magnification", view.size.magnification()},
                 {"life_size_m", view.size.life_size_m},
                 {"finer_than_eye_by_day", view.finer_by_day()},
                 {"pictures", view.pictures},
                 {"mean_cdm2", or_null(view.mean_cdm2)},
                 {"resolved_arcmin", or_null(resolved)},
                 {"finer_than_eye", resolved ? Json(view.size.display_pixel_arcmin <= *resolved) : Json(nullptr)}};
        if (!view.mean_cdm2)
            row["not_measured"] = "no picture of this view was shown by the profile";
        views.push_back(std::move(row));
    }
    return {{"profile", seen.profile},
            {"viewing_distance_m", seen.viewing_distance_m},
            {"pixel_pitch_mm", seen.pixel_pitch_mm},
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
        out["lamp_radius_m"] = error.lamp_radius_m;
    return out;
}

/// Columns with an entry per moment; only the actuators that the lamp set has.
Json car_json(const std::vector<CarRow>& rows) {
    Json columns;
    for (const CarRow& row : rows) {
        columns["time_s"].push_back(row.time_s);
        columns["pitch_deg"].push_back(row.pitch_deg);
        columns["rear_lift_mm"].push_back(row.rear_lift_mm);
        if (row.levelling_deg)
            columns["levelling_deg"].push_back(*row.levelling_deg);
        if (row.swivel_deg)
            columns["swivel_deg"].push_back(*row.swivel_deg);
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
                           {"frame_s", or_null(played.throughput.view_s)},
                           {"comparing_s", played.error.seconds}});
    return out;
}

Json timing_json(const Report& report) {
    Json out = Json::array();
    for (const PlayedVariant& played : report.played)
        for (const PassTime& pass : played.passes)
            out.push_back({{"drive", played.drive},
                           {"variant", played.variant},
                           {"pass", pass.name},
                           {"warm_up_dropped", played.warm_up_dropped},
                           {"spread_s", spread_json(spread_of(pass.seconds))},
                           {"samples_s", pass.seconds}});
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
                       {"wall_s", t.wall_s},
                       {"moments_per_s", or_null(t.moments_per_s())},
                       {"driver_view_alone_per_s", or_null(per_s(t.view_s))},
                       {"all_drawing_alone_per_s", or_null(per_s(t.drawing_s))},
                       {"share_of_driver_view_alone", or_null(t.share_of(t.view_s))},
                       {"share_of_all_drawing_alone", or_null(t.share_of(t.drawing_s))},
                       {"peak_memory_mib", t.peak_memory_mib}});
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
    const auto frame_json = [](const StoredFrame& frame) {
        return Json{{"frame", frame.tick},
                    {"time_s", frame.time_s},
                    {"view", frame.view},
                    {"png", text_or_null(frame.png)},
                    {"exr", text_or_null(frame.exr)}};
    };
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
              {"frames", list_of(played.frames, frame_json)},
              {"contact_sheet", contact_sheet_json(played.contact_sheet)},
              {"speed_mps", played.speed_mps},
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
    Json whole{{"schema", "fernlicht report"},
               {"schema_version", 1},
               {"verdict", verdict_name(overall(report))},
               {"verdict_counts", counts_json(count_verdicts(report))},
               {"known_failures", verdicts_json(report.listed)},
               {"warnings", report.warnings},
               {"complete", report.complete},
               {"interrupted", report.complete ? Json(nullptr) : Json(report.interrupted)},
               {"rows", rows_json(report)},
               {"drives", list_of(report.played, played_json)},
               {"context", context_json(report.context)},
               {"timing", timing_json(report)},
               {"throughput", throughput_json(report)},
               {"accuracy_times", accuracy_times_json(report)},
               {"savings", savings_json(report)}};
    if (report.live)
        whole["live"] = live_json(*report.live);
    refuse_no_numbers(whole, "");
    return json_text(whole);
}

} // namespace fernlicht
