#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/compare/runs/run_comparison.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"
#include "runner/files/value_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json value_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json change_json(const ReadingChange& c) {
    return {{"reading", name_of(c.reading)},
            {"unit", c.unit()},
            {"old_value", value_json(c.old_value)},
            {"new_value", value_json(c.new_value)},
            {"change", value_json(c.change())},
            {"relative_change", value_or_null(c.relative())},
            {"uncertainty", value_or_null(c.uncertainty)},
            {"by_tenth_degree", value_or_null(c.aim_effect)},
            {"by_noise", value_or_null(c.noise_effect)},
            {"kind", change_name(c.kind)},
            {"why_not", c.kind == ChangeKind::unknown ? Json(c.reason_unknown) : Json(nullptr)}};
}

Json frame_json(const FramePair& frame) {
    Json pictures = Json::array();
    for (const std::string& file : frame.files)
        pictures.push_back(frame.folder + "/" + file);
    return {{"view", frame.new_frame.view},
            {"frame", frame.new_frame.tick},
            {"time_s", frame.new_frame.time_s},
            {"old_file", frame.file(frame.old_frame)},
            {"new_file", frame.file(frame.new_frame)},
            {"width_px", frame.view.width_px},
            {"height_px", frame.view.height_px},
            {"pixels_per_degree", frame.comparison.pixels_per_degree > 0.0 ? Json(frame.comparison.pixels_per_degree) : Json(nullptr)},
            {"equal", frame.is_equal()},
            {"layers", layers_json(frame.comparison)},
            {"pictures", pictures}};
}

Json drive_json(const DriveComparison& drive, std::size_t index) {
    Json settings = Json::array(), changes = Json::array(), times = Json::array(), frames = Json::array();
    for (const YamlChange& setting : drive.settings)
        settings.push_back({{"key", setting.key}, {"old", setting.old_value}, {"new", setting.new_value}});
    for (std::size_t i = 0; i < drive.changes.size(); ++i) {
        Json row{{"id", row_id(index, i)}, {"decides", drive.decides(drive.changes[i].reading)}};
        row.update(change_json(drive.changes[i]));
        changes.push_back(std::move(row));
    }
    for (const TimeChange& time : drive.times) {
        Json row = change_json(time);
        row["old_samples"] = time.old_samples;
        row["new_samples"] = time.new_samples;
        times.push_back(std::move(row));
    }
    Json lamps = Json::array();
    for (const LampFilesDifference& files : drive.lamp_files)
        lamps.push_back({{"lamps", files.lamps},
                         {"old_file", files.before.string()},
                         {"new_file", files.now.string()},
                         {"difference", difference_json(files.difference)}});
    for (const FramePair& frame : drive.frames)
        frames.push_back(frame_json(frame));
    return {{"drive", drive.now.drive},
            {"old_lamp_set", drive.before.lamp_set},
            {"new_lamp_set", drive.now.lamp_set},
            {"old_technique", drive.before.technique},
            {"new_technique", drive.now.technique},
            {"settings", settings},
            {"files_of_other_content", drive.new_bytes},
            {"left_out", drive.left_out},
            {"lamp_files", lamps},
            {"changes", changes},
            {"times", times},
            {"frames", frames},
            {"figures", figures_json(drive.figures)}};
}

Json run_json(const RunFolder& run) {
    return {{"folder", run.folder.string()},
            {"command", run.command},
            {"started_utc", run.started_utc},
            {"version", run.version},
            {"backend", run.backend},
            {"gl_renderer", run.gl_renderer},
            {"cpu", run.cpu}};
}

std::string change_line(const std::string& id, const DriveComparison& drive, const ReadingChange& c, bool decides) {
    return csv_line(id, csv_text(drive.now.drive), csv_text(drive.before.lamp_set), csv_text(drive.now.lamp_set),
                    csv_text(drive.before.technique), csv_text(drive.now.technique), csv_text(name_of(c.reading)), csv_text(c.unit()),
                    csv_number(c.old_value.figure()), csv_number(c.new_value.figure()), csv_number(c.change().figure()),
                    csv_number(c.relative()), csv_number(c.uncertainty), csv_number(c.aim_effect), csv_number(c.noise_effect),
                    change_name(c.kind), decides ? "yes" : "no", csv_text(c.reason_unknown), bound_name(c.old_value),
                    bound_name(c.new_value), bound_name(c.change()));
}

} // namespace

std::string row_id(std::size_t drive, std::size_t change) { return fmt::format("c{}-{}", drive, change); }

std::string runs_json(const RunComparison& runs) {
    Json drives = Json::array(), largest = Json::array();
    for (std::size_t d = 0; d < runs.drives.size(); ++d)
        drives.push_back(drive_json(runs.drives[d], d));
    for (const auto& [drive, change] : runs.largest)
        largest.push_back(row_id(drive, change));
    const bool judged = !runs.strictness_name.empty();
    return json_text({{"schema", "fernlicht comparison"},
                      {"schema_version", 2},
                      {"kind", "runs"},
                      {"reference", runs.before.folder.string()},
                      {"tested", runs.now.folder.string()},
                      {"strictness", judged ? Json(runs.strictness_name) : Json(nullptr)},
                      {"passed", judged ? Json(runs.passed()) : Json(nullptr)},
                      {"not_judged", runs.not_judged},
                      {"largest_changes", largest},
                      {"left_out", runs.left_out},
                      {"drives", drives},
                      {"runs", Json::array({run_json(runs.before), run_json(runs.now)})}});
}

std::string runs_csv(const RunComparison& runs) {
    std::string csv =
        "id,drive,old_lamp_set,new_lamp_set,old_technique,new_technique,reading,unit,old_value,new_value,change,relative_change,"
        "uncertainty,by_tenth_degree,by_noise,kind,decides,why_not,old_bound,new_bound,change_bound\r\n";
    for (std::size_t d = 0; d < runs.drives.size(); ++d) {
        const DriveComparison& drive = runs.drives[d];
        for (std::size_t i = 0; i < drive.changes.size(); ++i)
            csv += change_line(row_id(d, i), drive, drive.changes[i], drive.decides(drive.changes[i].reading));
    }
    for (const DriveComparison& drive : runs.drives) // last: they differ from run to run
        for (const TimeChange& time : drive.times)
            csv += change_line("", drive, time, false);
    return csv;
}

std::string frames_csv(const RunComparison& runs) {
    std::string csv = "drive,old_lamp_set,new_lamp_set,view,frame,time_s,file,channel,figure,unit,value,x,y,not_measured\r\n";
    for (const DriveComparison& drive : runs.drives)
        for (const FramePair& frame : drive.frames)
            for (const LayerComparison& layer : frame.comparison.layers)
                for (const ComparedValue& v : layer.values)
                    csv += csv_line(csv_text(drive.now.drive), csv_text(drive.before.lamp_set), csv_text(drive.now.lamp_set),
                                    csv_text(frame.new_frame.view), std::to_string(frame.new_frame.tick),
                                    fmt::format("{}", frame.new_frame.time_s), csv_text(frame.file(frame.new_frame)), csv_text(layer.name),
                                    csv_text(v.name), csv_text(v.unit), csv_number(v.value), v.place ? std::to_string(v.place->first) : "",
                                    v.place ? std::to_string(v.place->second) : "", csv_text(v.value ? "" : v.why_not));
    return csv;
}

} // namespace fernlicht
