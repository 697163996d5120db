#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/compare/runs/run_comparison.h"
#include "runner/files/clean_text.h"

#include <cstdio>
#include <fmt/format.h>

namespace fernlicht {
namespace {

JsonMembers reading_change_members(ReadingChange& c) {
    return {{"reading", c.reading},
            {"unit", c.unit()},
            {"old_value", c.old_value},
            {"new_value", c.new_value},
            {"change", c.change()},
            {"relative_change", c.relative()},
            {"uncertainty", c.uncertainty},
            {"by_tenth_degree", c.aim_effect},
            {"by_tenth_flux", c.flux_effect},
            {"by_10mm", c.height_effect},
            {"by_75kg", c.load_effect},
            {"by_noise", c.noise_effect},
            {"kind", one_of(c.kind, names_of<ChangeKind>(change_name, 4))},
            {"why_not", null_unless(c.kind == ChangeKind::unknown, json_leaf(c.reason_unknown))}};
}

JsonMembers time_change_members(TimeChange& time) {
    return joined(reading_change_members(time), JsonMembers{{"old_samples", time.old_samples}, {"new_samples", time.new_samples}});
}

JsonMembers yaml_change_members(YamlChange& setting) {
    return {{"key", setting.key}, {"old", setting.old_value}, {"new", setting.new_value}};
}

JsonMembers lamp_files_members(LampFilesDifference& files) {
    return {{"lamps", files.lamps}, {"old_file", files.before}, {"new_file", files.now}, {"difference", files.difference, difference_part}};
}

JsonMembers frame_pair_members(FramePair& frame) {
    const auto file = [&frame](StoredFrame& of) {
        return through([&frame, &of] { return frame.file(of); },
                       [&frame, &of](const std::string& path) {
                           frame.is_display = path.ends_with(".png");
                           (frame.is_display ? of.png : of.exr) = path;
                       });
    };
    return {{"view", frame.new_frame.view},
            {"frame", frame.new_frame.tick},
            {"time_s", frame.new_frame.time_s},
            {"old_file", file(frame.old_frame)},
            {"new_file", file(frame.new_frame)},
            {"width_px", frame.view.width_px},
            {"height_px", frame.view.height_px},
            {"pixels_per_degree", or_null(frame.comparison.pixels_per_degree)},
            {"equal", frame.is_equal()},
            {"layers", layers_part(frame.comparison, "#/properties/drives/items/properties/frames/items/properties/layers")},
            {"pictures", frame.pictures}};
}

JsonMembers drive_comparison_members(DriveComparison& drive, std::size_t index) {
    const auto change = [&drive, index](RunChange& c) {
        const auto place = static_cast<std::size_t>(&c - drive.changes.data()); // one to be described stands elsewhere
        return joined({{"id", row_id(index, place)}, {"decides", c.decides}}, reading_change_members(c));
    };
    return {{"drive", drive.now.drive},
            {"old_lamp_set", drive.before.lamp_set},
            {"new_lamp_set", drive.now.lamp_set},
            {"old_technique", drive.before.technique},
            {"new_technique", drive.now.technique},
            {"settings", drive.settings, yaml_change_members},
            {"files_of_other_content", drive.new_bytes},
            {"left_out", drive.left_out},
            {"lamp_files", drive.lamp_files, lamp_files_members},
            {"changes", drive.changes, change},
            {"times", drive.times, time_change_members},
            {"frames", drive.frames, frame_pair_members},
            {"figures", drive.figures, compared_figure_members}};
}

JsonMembers run_folder_members(RunFolder& run) {
    return {{"folder", run.folder},   {"command", run.command}, {"started_utc", run.started_utc},
            {"version", run.version}, {"backend", run.backend}, {"gl_renderer", run.gl_renderer},
            {"cpu", run.cpu}};
}

JsonPart row_id_part(std::pair<std::size_t, std::size_t>& row) {
    return through([&row] { return row_id(row.first, row.second); },
                   [&row](const std::string& id) { std::sscanf(id.c_str(), "c%zu-%zu", &row.first, &row.second); });
}

std::string change_line(const std::string& id, const DriveComparison& drive, const ReadingChange& c, bool decides) {
    return csv_line(id, csv_text(drive.now.drive), csv_text(drive.before.lamp_set), csv_text(drive.now.lamp_set),
                    csv_text(drive.before.technique), csv_text(drive.now.technique), csv_text(name_of(c.reading)), csv_text(c.unit()),
                    csv_number(c.old_value.figure()), csv_number(c.new_value.figure()), csv_number(c.change().figure()),
                    csv_number(c.relative()), csv_number(c.uncertainty), csv_number(c.aim_effect), csv_number(c.flux_effect),
                    csv_number(c.height_effect), csv_number(c.load_effect), csv_number(c.noise_effect), change_name(c.kind),
                    decides ? "yes" : "no", csv_text(c.reason_unknown), bound_name(c.old_value), bound_name(c.new_value),
                    bound_name(c.change()));
}

} // namespace

std::string row_id(std::size_t drive, std::size_t change) { return fmt::format("c{}-{}", drive, change); }

JsonMembers runs_members(RunComparison& runs) {
    const auto drive = [&runs](DriveComparison& one) {
        return drive_comparison_members(one, static_cast<std::size_t>(&one - runs.drives.data()));
    };
    return {{"schema", json_constant("fernlicht comparison")},
            {"schema_version", json_constant(2)},
            {"kind", json_constant("runs")},
            {"reference", runs.before.folder},
            {"tested", runs.now.folder},
            {"strictness", or_null(runs.strictness_name)},
            {"passed", runs.strictness_name.empty() ? std::nullopt : std::optional(runs.passed())},
            {"not_judged", runs.not_judged},
            {"largest_changes", runs.largest, row_id_part},
            {"left_out", runs.left_out},
            {"drives", runs.drives, drive},
            {"runs", both(runs.before, runs.now, run_folder_members)}};
}

std::string runs_csv(const RunComparison& runs) {
    std::string csv =
        "id,drive,old_lamp_set,new_lamp_set,old_technique,new_technique,reading,unit,old_value,new_value,change,relative_change,"
        "uncertainty,by_tenth_degree,by_tenth_flux,by_10mm,by_75kg,by_noise,kind,decides,why_not,old_bound,new_bound,change_bound\r\n";
    for (std::size_t d = 0; d < runs.drives.size(); ++d) {
        const DriveComparison& drive = runs.drives[d];
        for (std::size_t i = 0; i < drive.changes.size(); ++i)
            csv += change_line(row_id(d, i), drive, drive.changes[i], drive.changes[i].decides);
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
                                    csv_text(v.name), csv_text(v.unit), csv_number(v.value), csv_number(v.x), csv_number(v.y),
                                    csv_text(v.value ? "" : v.why_not));
    return csv;
}

} // namespace fernlicht
