#include "metrics/display/night_vision.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/experiments/bench/bench_result.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"
#include "runner/findings/context_json.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/lamp_checks_json.h"
#include "runner/findings/moment_columns.h"
#include "runner/findings/series.h"
#include "runner/findings/summary.h"
#include "runner/judge/verdict_json.h"
#include "runner/play/display_pipeline.h"
#include "runner/play/live/live_figures.h"
#include "runner/play/shadows/choose_shadows.h"
#include "scenarios/drives/keys/shadow_keys.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <tuple>

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

template <class T> T value_of(const std::shared_ptr<const T>& found) { return found ? *found : T{}; }

/// Far below what any of the lamp tables knows; of times six places, as candump has.
double seven_digits(double value) { return std::stod(fmt::format("{:.7g}", value)); }
std::optional<double> microseconds(const std::optional<double>& value) {
    return value ? std::optional(std::stod(fmt::format("{:.6f}", *value))) : std::nullopt;
}

using NamedValues = std::vector<std::pair<std::string, Value>>;

/// Values by name, others where they are there, then the reasons of those that are null.
JsonMembers with_reasons(const NamedValues& values, const NamedValues& others = {}, bool has_others = false) {
    JsonMembers members, more;
    JsonTexts reasons;
    for (const auto& [named, to, is_there] : {std::tuple(&values, &members, true), std::tuple(&others, &more, has_others)})
        for (const auto& [name, value] : *named) {
            to->emplace_back(name, value);
            if (is_there && !value.measured())
                reasons.emplace_back(name, value.reason());
        }
    return joined(std::move(members), when(has_others, std::move(more)), when(!reasons.empty(), {{"not_measured", JsonTexts(reasons)}}));
}

/// null where no moment gave anything.
JsonPart moments_part(const CensoredSamples& moments) {
    return null_unless(moments.count() > 0,
                       joined({{"count", moments.count()}}, with_reasons({{"median", moments.quantile(0.5)},
                                                                          {"p05", moments.quantile(0.05)},
                                                                          {"p95", moments.quantile(0.95)},
                                                                          {"minimum", moments.quantile(0.0)},
                                                                          {"maximum", moments.quantile(1.0)},
                                                                          {"mean", moments.mean()},
                                                                          {"standard_deviation", moments.standard_deviation()}})));
}

/// Trust in the reach is told of the own lane alone.
JsonMembers summary_members(ExtentSummary& summary) {
    const auto width_members = [](std::pair<double, CensoredSamples>& width) -> JsonMembers {
        return {{"at_m", width.first}, {"width_m", moments_part(width.second)}};
    };
    std::vector<std::pair<double, CensoredSamples>> widths;
    for (const auto& [key, moments] : summary.moments)
        if (key.distance_m)
            widths.emplace_back(*key.distance_m, moments);
    const CensoredSamples& reach = moments_of(summary, Quantity::reach);
    const auto of_reach = [&](Aspect aspect, double share) { return moments_of(summary, Quantity::reach, aspect).quantile(share); };
    return joined({{"surface", one_of(summary.key.surface, names_of<Surface>(surface_name, 2))},
                   {"lane", summary.key.lane},
                   {"same_direction", summary.same_direction},
                   {"threshold_lx", summary.key.threshold_lx},
                   {"moments", reach.count()},
                   {"moments_cut_off", summary.cut_off},
                   {"reach_m", moments_part(reach)},
                   {"widths_m", std::move(widths), width_members},
                   {"area_m2", moments_part(moments_of(summary, Quantity::area))}},
                  with_reasons({{"largest_twin_difference_m", of_reach(Aspect::twin_difference, 1.0)}},
                               {{"by_tenth_degree_m", reach_moved_m(summary, by_aim)},
                                {"by_tenth_flux_m", reach_moved_m(summary, by_flux)},
                                {"grid_error_m", of_reach(Aspect::grid_error, 0.5)}},
                               summary.key.lane == "own"));
}

JsonMembers frame_members(StoredFrame& frame) {
    return {
        {"frame", frame.tick}, {"time_s", frame.time_s}, {"view", frame.view}, {"png", or_null(frame.png)}, {"exr", or_null(frame.exr)}};
}

JsonMembers sheet_members(StoredFrame& sheet) { return {{"frame", sheet.tick}, {"time_s", sheet.time_s}, {"png", sheet.png}}; }

JsonMembers titled_sheet_members(StoredSheet& sheet) { return joined({{"what", sheet.what}}, sheet_members(sheet.picture)); }

JsonMembers tried_members(TriedShadows& tried) {
    return joined({{"method", shadow_method_part(tried.method)}},
                  when(tried.error.has_value(), {{"error", tried.error.value_or(0.0)},
                                                 {"worst_s", tried.worst_s},
                                                 {"worst_lamp_set", tried.worst_set},
                                                 {"worst_view", tried.worst_view},
                                                 {"pictures", tried.pictures}}),
                  when(!tried.error, {{"refused", tried.refused}}));
}

JsonMembers choice_members(ShadowChoice& choice) {
    return {{"chosen", shadow_method_part(choice.chosen)},
            {"why", choice.why},
            {"error_bound", choice.bound},
            {"moments", choice.ticks},
            {"moments_shadowed", choice.ticks_shadowed},
            {"moments_compared", choice.compared},
            {"tried", choice.tried, tried_members}};
}

/// Settings are numbers and lists of them, which JSON writes as YAML does.
JsonMembers drawn_shadows_members(RenderingSettings& drawn) {
    const JsonPart settings(
        [&drawn] {
            Json used = Json::object();
            for (const auto& [key, text] : used_shadow_keys(drawn.shadows))
                used[std::string(key)] = Json::parse(text);
            return used;
        },
        nullptr,
        [] {
            return Json{{"type", "object"}};
        });
    return {{"method", shadow_method_part(drawn.shadows.method)},
            {"objects_cast", drawn.shadows.objects_cast},
            {"settings", settings},
            {"not_used", or_null(drawn.substitute_shadows)}};
}

JsonMembers shown_by_members(RenderingSettings& drawn) {
    const DisplayProfile display = display_of(drawn);
    const ToneMapperKind kind = drawn.tone_mapper.kind;
    const bool has_s = kind == ToneMapperKind::rational || kind == ToneMapperKind::logarithmic;
    std::vector<std::pair<double, double>> luminances;
    for (const double seen : {0.1, 1.0, 10.0})
        luminances.emplace_back(seen, seven_digits(shown_cdm2(drawn, seen)));
    const auto luminance_members = [](std::pair<double, double>& seen) -> JsonMembers {
        return {{"seen_cdm2", seen.first}, {"shown_cdm2", seen.second}};
    };
    const auto& camera = drawn.display.camera;
    return {{"text", shown_by(drawn.display, drawn.tone_mapper)},
            {"tone_mapper", camera ? "camera" : name(kind)},
            {"s", has_s && !camera ? std::optional(drawn.tone_mapper.s) : std::nullopt},
            {"white_cdm2", camera ? seven_digits(camera->saturation_cdm2()) : drawn.tone_mapper.l_max_cdm2},
            {"display", display.name},
            {"gamut", display.gamut == GamutRule::clip ? "clip" : "keep-luminance"},
            {"peak_cdm2", seven_digits(display.peak_cdm2())},
            {"black_cdm2", display.black_cdm2},
            {"stages", display_stages(drawn)},
            {"luminances", std::move(luminances), luminance_members}};
}

JsonMembers seen_view_members(SeenView& view) {
    const std::optional<double> resolved = view.resolved();
    return joined({{"view", view.view},
                   {"scene_pixel_arcmin", view.size.scene_pixel_arcmin},
                   {"display_pixel_arcmin", view.size.display_pixel_arcmin},
                   {"magnification", view.size.magnification()},
                   {"life_size_m", view.size.life_size_m},
                   {"finer_than_eye_by_day", view.finer_by_day()},
                   {"pictures", view.pictures},
                   {"mean_cdm2", view.mean_cdm2},
                   {"resolved_arcmin", resolved},
                   {"finer_than_eye", resolved ? std::optional(view.size.display_pixel_arcmin <= *resolved) : std::nullopt}},
                  when(!view.mean_cdm2, {{"not_measured", "no picture of this view was shown by the profile"}}));
}

JsonMembers seen_display_members(SeenDisplay& seen) {
    return {{"profile", seen.profile},
            {"viewing_distance_m", seen.viewing_distance_m},
            {"pixel_pitch_mm", seen.pixel_pitch_mm},
            {"views", seen.views, seen_view_members}};
}

/// Null where the run was told to leave it out.
JsonPart accuracy_part(DriveError& error) {
    const Ticks ticks = [&error] { return error.ticks; };
    return null_unless(
        error.measured() || !error.not_measured.empty(),
        joined(when(error.measured(), {{"frames", error.ticks},
                                       {"width_px", error.width_px},
                                       {"height_px", error.height_px},
                                       {"tiles", error.tiles},
                                       {"tiles_of", error.tiles_of},
                                       {"rays", error.rays},
                                       {"road", errors_part(error.road, "", nullptr, ticks)},
                                       {"road_p95_by_moment", error.road_p95},
                                       {"whole_view", errors_part(error.whole, "", nullptr, ticks)},
                                       {"target", errors_part(error.target, error.no_target, &error.no_target, ticks)},
                                       {"luminance", errors_part(error.luminance, error.no_luminance, &error.no_luminance, ticks)},
                                       {"reach", error.reach, reach_members}}),
               when(error.measured() && error.lamp_radius_m > 0.0, {{"lamp_radius_m", error.lamp_radius_m}}),
               when(!error.measured(), {{"not_measured", error.not_measured}})));
}

/// What the columns of each subject are, whose figures lie in the moments' CSV.
JsonMembers seeing_members(SeeingSeries& series) {
    const auto column_members = [](SeeingSeries::Column& column) -> JsonMembers {
        return {{"name", column.name}, {"what", column.label}, {"unit", column.unit}};
    };
    return {{"subject", series.subject}, {"over", series.over}, {"columns", series.columns, column_members}};
}

constexpr const char* state_names[] = {"fresh", "stale", "missing", "out_of_range", "contradictory"};

JsonMembers by_state(std::array<std::uint64_t, 5>& counts) {
    JsonMembers members;
    for (std::size_t state = 0; state < counts.size(); ++state)
        members.emplace_back(state_names[state], counts[state]);
    return members;
}

JsonMembers state_members(std::pair<double, std::size_t>& state) {
    const auto names = [] { return std::vector<std::string>(std::begin(state_names), std::end(state_names)); };
    return {{"from_s", microseconds(state.first).value()}, {"state", one_of(state.second, names)}};
}

JsonMembers input_members(BusSignalReport& signal) {
    JsonTexts policies;
    for (std::size_t state = 0; state < signal.policies.size(); ++state)
        if (!signal.policies[state].empty())
            policies.emplace_back(state_names[state], signal.policies[state]);
    return {{"name", signal.name},
            {"source", signal.source},
            {"also", or_null(signal.also)},
            {"tolerance", seven_digits(signal.tolerance)},
            {"unit", signal.unit},
            {"frames", signal.frames},
            {"changes", signal.changes},
            {"age_max_s", signal.frames > 0 ? microseconds(signal.oldest_s) : std::nullopt},
            {"stale_after_s", microseconds(signal.stale_after_s)},
            {"last_change_s", microseconds(signal.changed_s)},
            {"ticks", by_state(signal.ticks)},
            {"policy_acted", by_state(signal.acted)},
            {"unchecked", signal.unchecked},
            {"policies", JsonTexts(policies)},
            {"states", signal.states, state_members}};
}

JsonMembers stamp_members(SignalStamp& signal) {
    return {{"name", signal.name},
            {"unit", signal.unit},
            {"last_change_s", microseconds(signal.changed_s).value()},
            {"age_s", microseconds(signal.age_s)}};
}

JsonMembers bus_members(BusReport& bus) {
    return {{"log", or_null(bus.log)},      {"start_s", microseconds(bus.start_s).value()},
            {"frames", bus.frames},         {"frames_read", bus.read},
            {"frames_sent", bus.sent},      {"inputs", bus.signals, input_members},
            {"all", bus.all, stamp_members}};
}

JsonMembers played_members(PlayedCell& played) {
    return joined(
        {{"drive", played.drive},
         {"lamp_set", played.lamp_set},
         {"technique", played.technique},
         {"lamps", played.lamps},
         {"inputs", played.input_hashes},
         {"ticks_planned", played.ticks_planned},
         {"ticks_done", played.ticks_done},
         {"readings", std::uint64_t{played.readings.size()}},
         {"moments", through([&played] { return std::max<std::uint64_t>(played.moments_told, moment_count(played)); },
                             [&played](std::uint64_t told) { played.moments_told = told; })},
         {"repeats", repeats_members(played.repeats)},
         {"verdicts", played.verdicts, verdict_members},
         {"left_out", played.left_out},
         {"notes", played.notes},
         {"summary", std::as_const(played.extent_summaries), summary_members},
         {"frames", played.frames, frame_members},
         {"contact_sheet", null_unless(!played.contact_sheet.png.empty(), sheet_members(played.contact_sheet))},
         {"accuracy", accuracy_part(played.error)}},
        when(played.rendering_settings != nullptr, {{"shadows", value_of(played.rendering_settings), drawn_shadows_members},
                                                    {"shown_by", value_of(played.rendering_settings), shown_by_members}}),
        when(played.shadows != nullptr, {{"shadow_choice", value_of(played.shadows), choice_members}}),
        when(played.display != nullptr, {{"display", value_of(played.display), seen_display_members}}),
        when(played.series != nullptr,
             {{"cars", through([&played] { return value_of(played.series); },
                               [&played](const SeriesFindings& found) { played.series = std::make_shared<SeriesFindings>(found); },
                               series_members)}}),
        when(!played.aims.empty(), {{"aims", played.aims, lamp_aim_members}}),
        when(!played.more_sheets.empty(), {{"more_sheets", played.more_sheets, titled_sheet_members}}),
        when(!played.seeing.empty(), {{"seeing", played.seeing, seeing_members}}),
        when(!played.bus.empty(), {{"signals", bus_members(played.bus)}}));
}

JsonMembers pass_time_members(PassTime& pass) {
    return {{"pass", pass.name}, {"spread_s", spread_of(pass.seconds), spread_members}, {"samples_s", pass.seconds}};
}

JsonMembers throughput_members(Throughput& t) {
    return {{"moments", t.moments},
            {"wall_s", t.wall_s},
            {"driver_view_s", t.view_s},
            {"all_drawing_s", t.drawing_s},
            {"peak_memory_mib", t.peak_memory_mib}};
}

JsonMembers counted_work_members(Work& work) {
    return {
        {"passes", work.passes},     {"draws", work.draws},         {"calls", work.calls},         {"samplers", work.samplers},
        {"features", work.features}, {"triangles", work.triangles}, {"fragments", work.fragments}, {"texture_bytes", work.texture_bytes}};
}

JsonPart drawn_part(std::vector<double>& seconds, Work& work) {
    return null_unless(
        !seconds.empty(),
        JsonMembers{{"spread_s", spread_of(seconds), spread_members}, {"samples_s", seconds}, {"work", counted_work_members(work)}});
}

/// Where nothing was measured, times and counts are null.
JsonMembers savings_members(PruningSavings& savings) {
    return joined({{"frames", savings.ticks},
                   {"pruned", drawn_part(savings.pruned_s, savings.pruned)},
                   {"unpruned", drawn_part(savings.unpruned_s, savings.unpruned)},
                   {"ratio", savings.ratio(), ratio_members}},
                  when(!savings.ratio(), {{"not_measured", savings.not_measured}}));
}

/// What no two runs agree on.
JsonMembers times_members(PlayedCell& played) {
    return joined({{"drive", played.drive},
                   {"lamp_set", played.lamp_set},
                   {"warm_up_dropped", played.warm_up_dropped},
                   {"passes", played.passes, pass_time_members},
                   {"throughput", throughput_members(played.throughput)},
                   {"comparing_s", or_null(played.error.seconds)},
                   {"savings", savings_members(played.savings)}},
                  when(!played.no_times.empty(), {{"not_measured", played.no_times}}));
}

JsonMembers report_members(Report& report) {
    return joined({{"schema", json_constant("fernlicht report")},
                   {"schema_version", json_constant(2)},
                   {"verdict", overall(report), verdict_kind_part},
                   {"verdict_counts", count_verdicts(report), count_members},
                   {"known_failures", report.listed, verdict_members},
                   {"warnings", report.warnings},
                   {"complete", report.complete},
                   {"interrupted", or_null(report.interrupted)},
                   {"drives", report.played, played_members},
                   {"context", context_members(report.context)},
                   {"times", one_for_each(report.played, times_members, "drives")}},
                  when(!report.lamp_files.empty(), {{"lamp_files", report.lamp_files, lamp_file_members}}),
                  when(report.live != nullptr, {{"live", value_of(report.live), live_members}}));
}

/// Rows tell drive and lamp set by name.
void take_readings(const CsvFile& csv, Report& report) {
    const std::size_t drive = csv.column("drive"), set = csv.column("lamp_set"), frame = csv.column("frame"), name = csv.column("name"),
                      unit = csv.column("unit"), bound = csv.column("bound"), value = csv.column("value"), reason = csv.column("reason"),
                      where = csv.column("where"), between = csv.column("between_moments");
    for (std::size_t i = 0; i < csv.rows.size(); ++i) {
        const std::vector<std::string>& row = csv.rows[i];
        const auto key = key_of(row[name]);
        if (!key)
            csv.refuse(i, name, "the name of a reading");
        if (row[unit] != unit_of(*key))
            csv.refuse(i, unit, std::string("the unit ") + unit_of(*key));
        Reading reading{*key, Value::not_measured(row[reason]), row[where], row[frame].empty() ? -1 : csv.count(i, frame)};
        if (!row[value].empty()) {
            const double number = csv.number(i, value);
            reading.value = row[bound].empty()         ? Value(number)
                            : row[bound] == "at_least" ? Value::at_least(number)
                            : row[bound] == "at_most"  ? Value::at_most(number)
                                                       : (csv.refuse(i, bound, "at_least or at_most"), Value());
        }
        for (const SensitivityRow& moves : sensitivity_rows)
            if (const std::size_t column = csv.column(moves.name); !row[column].empty())
                reading.sensitivity.*moves.member = csv.number(i, column);
        if (!row[between].empty())
            reading.between_moments = csv.number(i, between);
        for (PlayedCell& played : report.played)
            if (clean_text(played.drive) == row[drive] && clean_text(played.lamp_set) == row[set])
                played.readings.push_back(reading);
    }
}

/// A file that lost its end must not pass for a whole one.
void check_count(const std::filesystem::path& file, std::size_t found, const std::string& of, std::uint64_t told) {
    if (found != told)
        throw InputError({file, 0, 0, {}}, fmt::format("found {} {}", found, of), fmt::format("{}, as report.json says", told));
}

} // namespace

nlohmann::ordered_json played_json(const PlayedCell& played) { return as_json(played, played_members); }

std::string report_json(const Report& report) {
    const Json whole = as_json(report, report_members);
    refuse_no_numbers(whole, "");
    return json_text(whole);
}

std::string rejudged_json(const std::string& kept, const Report& report) {
    Json whole = Json::parse(kept);
    const Json judged = as_json(report, report_members);
    for (const char* const key : {"verdict", "verdict_counts", "known_failures", "warnings"})
        whole.at(key) = judged.at(key);
    for (const char* const key : {"command", "inputs"})
        whole.at("context").at(key) = judged.at("context").at(key);
    for (std::size_t i = 0; i < report.played.size(); ++i)
        whole.at("drives").at(i).at("verdicts") = judged.at("drives").at(i).at("verdicts");
    return json_text(whole);
}

std::string report_json_schema() { return json_schema(report_members); }

Report read_report(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "report.json";
    const CheckedJson json = CheckedJson::read(file);
    if (const CheckedJson schema = json.at("schema"); schema.text() != "fernlicht report")
        schema.refuse("fernlicht report");
    if (json.at("schema_version").whole() != 2)
        throw InputError({file, 0, 0, {}}, "was written by another version of this program", "a run of this version: play it again");
    if (const CheckedJson complete = json.at("complete"); !complete.truth())
        complete.refuse("a complete run");
    Report report = from_json<Report>(json, report_members);
    take_readings(read_csv(folder / "readings.csv"), report);
    const std::vector<CheckedJson> drives = json.at("drives").items();
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const PlayedCell& played = report.played[i];
        check_count(folder / "readings.csv", played.readings.size(),
                    fmt::format("readings of {} with {}", printable(played.drive), printable(played.lamp_set)),
                    drives[i].at("readings").count());
    }
    return report;
}

CsvFile read_moments(const std::filesystem::path& folder, const Report& report, std::size_t cell) {
    CsvFile moments = read_csv(folder / moments_files(report.played)[cell]);
    check_count(moments.file, moments.rows.size(), "moments", report.played[cell].moments_told);
    return moments;
}

} // namespace fernlicht
