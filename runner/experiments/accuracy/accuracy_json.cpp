#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

JsonMembers configuration_members(ConfigurationResult& found, DriveAccuracy& drive) {
    Configuration& c = found.configuration;
    const auto errors = [frames = ticks_of(drive.moments)](std::optional<PixelErrors>& of, std::string& why_not) {
        return errors_part(of, why_not, &why_not, frames);
    };
    return {{"label", name_of(c)},
            {"technique", c.technique},
            {"width_px", c.width_px},
            {"height_px", c.height_px},
            {"shadows", shadow_method_part(c.shadows.method)},
            {"shadow_map", {{"width", c.shadows.width}, {"height", c.shadows.height}}},
            {"beams", beams_part(c.beams)},
            {"varied", or_null(c.varied)},
            {"moments", found.moments},
            {"road", errors(found.road, found.no_illuminance)},
            {"road_p95_by_moment", found.road_p95},
            {"whole_view", errors(found.whole, found.no_illuminance)},
            {"target", errors(found.target, found.no_target)},
            {"luminance", errors(found.luminance, found.no_luminance)},
            {"reach", found.reach, reach_members},
            {"frame_s", found.samples.frame_s},
            {"cpu_s", found.samples.cpu_s},
            {"texture_bytes", typical_work_part(found.work, [](Work& work) { return json_leaf(work.texture_bytes); })}};
}

JsonMembers reference_members(ReferenceCost& cost) {
    return {{"seconds", cost.seconds}, {"rays", cost.rays}, {"median_samples", cost.median_samples}, {"max_samples", cost.max_samples}};
}

JsonMembers edge_members(LightAtEdges& e) {
    return {{"pixels", e.pixels},
            {"mean", e.mean},
            {"mean_standard_error", e.mean_standard_error},
            {"absolute", e.absolute},
            {"mean_of_shares", e.mean_of_shares},
            {"beyond_ray", e.beyond_ray},
            {"beyond_ray_standard_error", e.beyond_ray_standard_error}};
}

JsonMembers edge_row_members(EdgeRow& row) {
    return {{"way", row.way},
            {"shadow_edges", row.shadow, edge_members},
            {"several_surfaces", row.surfaces, edge_members},
            {"beside", row.beside, edge_members},
            {"all", row.all, edge_members}};
}

JsonMembers drive_members(DriveAccuracy& drive) {
    const auto frames = ticks_of(drive.moments);
    const auto configuration = [&drive](ConfigurationResult& found) { return configuration_members(found, drive); };
    const auto simplification = [frames](Simplification& price) -> JsonMembers {
        return {{"name", price.name}, {"road", errors_part(price.errors, "no lamp shines on the road", nullptr, frames)}};
    };
    const auto agreement = [frames](TwinAgreement& twin) -> JsonMembers {
        return {{"flat", errors_part(twin.flat, "no light", nullptr, frames)},
                {"steep_of_bound", errors_part(twin.steep_of_bound, "no steep light", nullptr, frames)},
                {"steep_within", twin.steep_within},
                {"pixels_of_several_surfaces", twin.several_surfaces},
                {"pixels_of_shadow_edges", twin.shadow_edges}};
    };
    return {{"drive", drive.drive},
            {"title", drive.title},
            {"lamp_set", drive.lamp_set},
            {"shadow_choice", or_null(drive.shadow_choice)},
            {"moments", drive.moments, moment_members},
            {"reference", drive.reference, reference_members},
            {"configurations", drive.configurations, configuration},
            {"simplifications", drive.simplifications, simplification},
            {"twin", drive.twin, agreement},
            {"edges", drive.edges, edge_row_members}};
}

JsonMembers interval_members(Interval& i) { return {{"value", i.value}, {"low", i.low}, {"high", i.high}}; }

/// A time: what its interval is depends on how often it was taken.
JsonMembers time_members(Interval& time) {
    JsonPart interval = through([&] { return interval_name(time).empty() ? std::nullopt : std::optional(interval_name(time)); },
                                [&](const std::optional<std::string>& name) { time.of_median = name && name->starts_with("95"); });
    interval.schema = [] { return nlohmann::ordered_json{{"enum", {"95 % interval of the median", "min to max", "one timing", nullptr}}}; };
    return joined(interval_members(time), JsonMembers{{"timings", time.samples}, {"interval", interval}});
}

JsonMembers diagram_members(WorkPrecision& diagram) {
    const auto row_members = [&diagram, all = standings(diagram.rows)](WorkPrecisionRow& row) -> JsonMembers {
        std::size_t i = 0; // a row to be read into stands elsewhere
        while (i < all.size() && &diagram.rows[i] != &row)
            ++i;
        const Standing standing = i < all.size() ? all[i] : Standing{};
        return {{"label", row.label},
                {"parameters", row.parameters},
                {"error", row.error, interval_members},
                {"seconds", row.seconds, time_members},
                {"floor", row.floor},
                {"below_floor", row.below_floor()},
                {"bytes", row.bytes},
                {"on_front", standing.on_front},
                {"beaten_by", standing.dominated_by ? std::optional(diagram.rows[*standing.dominated_by].label) : std::nullopt},
                {"beaten_surely", standing.surely},
                {"not_measured", or_null(row.why_not)},
                {"note", or_null(row.note)}};
    };
    return {{"name", diagram.name},        {"title", diagram.title},
            {"error", diagram.error_name}, {"error_unit", diagram.error_unit},
            {"time", diagram.time_name},   {"floor", or_null(diagram.floor_name)},
            {"notes", diagram.notes},      {"rows", diagram.rows, row_members}};
}

} // namespace

JsonMembers accuracy_members(AccuracyResult& result) {
    return {
        {"schema", json_constant("fernlicht accuracy")},
        {"schema_version", json_constant(2)},
        {"context", joined(context_members(result.context), JsonMembers{{"cores", result.cores}, {"other_cores", result.others.cores}})},
        {"interrupted", or_null(result.interrupted)},
        {"missing", result.missing},
        {"settings", {{"rounds", result.rounds}, {"target_error", result.target_error}, {"max_samples", result.max_samples}}},
        {"drives", result.drives, drive_members},
        {"diagrams", result.diagrams, diagram_members}};
}

std::string accuracy_csv(const AccuracyResult& result) {
    std::string out = "diagram,row,parameters,error,error_low,error_high,error_unit,floor,seconds,seconds_low,seconds_high,timings,seconds_"
                      "interval,bytes,on_front,"
                      "beaten_by,beaten_surely,not_measured\r\n";
    const auto interval = [](const std::optional<Interval>& i) { return i ? fmt::format("{},{},{}", i->value, i->low, i->high) : ",,"; };
    for (const WorkPrecision& diagram : result.diagrams) {
        const std::vector<Standing> standing = standings(diagram.rows);
        for (std::size_t i = 0; i < diagram.rows.size(); ++i) {
            const WorkPrecisionRow& row = diagram.rows[i];
            std::string parameters;
            for (const auto& [name, value] : row.parameters)
                parameters += (parameters.empty() ? "" : "; ") + name + " " + value;
            const auto by = standing[i].dominated_by;
            out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_text(diagram.name), csv_text(row.label),
                               csv_text(parameters), interval(row.error), csv_text(diagram.error_unit), row.floor, interval(row.seconds),
                               row.seconds ? fmt::format("{}", row.seconds->samples) : "", row.seconds ? interval_name(*row.seconds) : "",
                               row.bytes ? fmt::format("{}", *row.bytes) : "", standing[i].on_front ? "true" : "false",
                               by ? csv_text(diagram.rows[*by].label) : "", standing[i].surely ? "true" : "false", csv_text(row.why_not));
        }
    }
    return out;
}

} // namespace fernlicht
