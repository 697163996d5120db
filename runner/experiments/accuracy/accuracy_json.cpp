#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/files/json_text.h"
#include "runner/findings/context_json.h"
#include "runner/findings/figures.h"

#include <cmath>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

std::vector<int> frames_of(const DriveAccuracy& drive) {
    std::vector<int> frames;
    for (const auto& [tick, time_s] : drive.moments)
        frames.push_back(tick);
    return frames;
}

Json configuration_json(const ConfigurationResult& found, const DriveAccuracy& drive) {
    const std::vector<int> frames = frames_of(drive);
    const Configuration& c = found.configuration;
    const auto work = typical_work(found.work);
    return {{"label", name_of(c)},
            {"technique", c.technique},
            {"width_px", c.width_px},
            {"height_px", c.height_px},
            {"shadows", name(c.shadows.method)},
            {"shadow_map", {{"width", c.shadows.width}, {"height", c.shadows.height}}},
            {"beams", beams_text(c.beams)},
            {"varied", text_or_null(c.varied)},
            {"moments", found.moments},
            {"road", errors_json(found.road, found.no_illuminance, frames)},
            {"road_p95_by_moment", found.road_p95},
            {"whole_view", errors_json(found.whole, found.no_illuminance, frames)},
            {"target", errors_json(found.target, found.no_target, frames)},
            {"luminance", errors_json(found.luminance, found.no_luminance, frames)},
            {"reach", reach_json(found.reach)},
            {"frame_s", found.samples.frame_s},
            {"cpu_s", found.samples.cpu_s},
            {"texture_bytes", work ? Json(work->texture_bytes) : Json(nullptr)}};
}

Json twin_json(const DriveAccuracy& drive) {
    if (!drive.twin)
        return nullptr;
    const TwinAgreement& twin = *drive.twin;
    return {{"flat", errors_json(twin.flat, "no light", frames_of(drive))},
            {"steep_of_bound", errors_json(twin.steep_of_bound, "no steep light", frames_of(drive))},
            {"steep_within", twin.steep_within},
            {"pixels_of_several_surfaces", twin.several_surfaces},
            {"pixels_of_shadow_edges", twin.shadow_edges}};
}

Json drive_json(const DriveAccuracy& drive) {
    Json moments = Json::array(), configurations = Json::array();
    for (const auto& [tick, time_s] : drive.moments)
        moments.push_back({{"frame", tick}, {"time_s", time_s}});
    for (const ConfigurationResult& found : drive.configurations)
        configurations.push_back(configuration_json(found, drive));
    Json simplifications = Json::array();
    for (const Simplification& price : drive.simplifications)
        simplifications.push_back(
            {{"name", price.name}, {"road", errors_json(price.errors, "no lamp shines on the road", frames_of(drive))}});
    const ReferenceCost& cost = drive.reference;
    return {
        {"drive", drive.drive},
        {"title", drive.title},
        {"variant", drive.variant},
        {"shadow_choice", text_or_null(drive.shadow_choice)},
        {"moments", moments},
        {"reference",
         {{"seconds", cost.seconds}, {"rays", cost.rays}, {"median_samples", cost.median_samples}, {"most_samples", cost.most_samples}}},
        {"configurations", configurations},
        {"simplifications", simplifications},
        {"twin", twin_json(drive)}};
}

Json interval_json(const std::optional<Interval>& interval) {
    return interval ? Json{{"value", interval->value}, {"low", interval->low}, {"high", interval->high}} : Json(nullptr);
}

/// A time: what its interval is depends on how often it was taken.
Json time_json(const std::optional<Interval>& time) {
    Json out = interval_json(time);
    if (time)
        out.update({{"timings", time->samples}, {"interval", text_or_null(interval_name(*time))}});
    return out;
}

Json diagram_json(const WorkPrecision& diagram) {
    const std::vector<Standing> standing = standings(diagram.rows);
    Json rows = Json::array();
    for (std::size_t i = 0; i < diagram.rows.size(); ++i) {
        const WorkPrecisionRow& row = diagram.rows[i];
        Json parameters = Json::object();
        for (const auto& [name, value] : row.parameters)
            parameters[name] = value;
        rows.push_back({{"label", row.label},
                        {"parameters", parameters},
                        {"error", interval_json(row.error)},
                        {"seconds", time_json(row.seconds)},
                        {"floor", row.floor},
                        {"below_floor", row.below_floor()},
                        {"bytes", row.bytes ? Json(*row.bytes) : Json(nullptr)},
                        {"on_front", standing[i].on_front},
                        {"beaten_by", standing[i].dominated_by ? Json(diagram.rows[*standing[i].dominated_by].label) : Json(nullptr)},
                        {"beaten_surely", standing[i].surely},
                        {"not_measured", text_or_null(row.why_not)},
                        {"note", text_or_null(row.note)}});
    }
    return {{"name", diagram.name},        {"title", diagram.title},
            {"error", diagram.error_name}, {"error_unit", diagram.error_unit},
            {"time", diagram.time_name},   {"floor", text_or_null(diagram.floor_name)},
            {"notes", diagram.notes},      {"rows", rows}};
}

Json machine_json(const AccuracyResult& result) {
    Json context = context_json(result.context);
    context["cores"] = result.cores;
    context["other_cores"] = result.others.cores ? Json(*result.others.cores) : Json(nullptr);
    return context;
}

} // namespace

std::string accuracy_json(const AccuracyResult& result) {
    Json drives = Json::array(), diagrams = Json::array();
    for (const DriveAccuracy& drive : result.drives)
        drives.push_back(drive_json(drive));
    for (const WorkPrecision& diagram : result.diagrams)
        diagrams.push_back(diagram_json(diagram));
    return json_text(
        Json{{"schema", "fernlicht accuracy"},
             {"schema_version", 1},
             {"context", machine_json(result)},
             {"interrupted", text_or_null(result.interrupted)},
             {"missing", result.missing},
             {"settings", {{"rounds", result.rounds}, {"target_error", result.target_error}, {"most_samples", result.most_samples}}},
             {"drives", drives},
             {"diagrams", diagrams}});
}

} // namespace fernlicht
