#include "runner/experiments/compare/runs/run_folder.h"

#include "runner/experiments/compare/runs/yaml_difference.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/output_folder.h"
#include "runner/play/capture.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"

#include <algorithm>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_bytes = std::size_t{16} << 20; // of a resolved drive

/// The part of a resolved drive that has these keys: what reads them need not know the others.
YamlValue only(const YamlValue& document, std::initializer_list<std::string_view> keys) {
    YamlValue part = document;
    std::erase_if(part.members, [&](const YamlMember& member) { return std::ranges::find(keys, member.key) == keys.end(); });
    return part;
}

/// Runs of older versions wrote an s, 1 or 20, that `linear` and `histogram` did not use either.
void drop_unused_s(YamlValue& part) {
    for (YamlMember& member : part.members)
        if (const YamlValue* kind = member.key == "tone_mapper" ? member_of(member.value, "kind") : nullptr;
            kind && (kind->text == "linear" || kind->text == "histogram"))
            std::erase_if(member.value.members, [](const YamlMember& key) { return key.key == "s"; });
}

double grid_cell_m(const YamlValue& document, const fs::path& file, double otherwise) {
    const YamlValue* cell = member_of(member_of(member_of(document, "measure"), "extent"), "cell_m");
    return cell ? YamlEntry(*cell, file, "measure.extent.cell_m").number_above(0.0, 1e6) : otherwise;
}

/// Of targets on the road; 0 where the drive has none.
double look_step_m(const YamlValue& document, const fs::path& file) {
    const YamlValue* visibility = member_of(member_of(document, "measure"), "visibility");
    if (!visibility || visibility->text == "false")
        return 0.0;
    const YamlValue* step = member_of(*visibility, "step_m");
    return step ? YamlEntry(*step, file, "measure.visibility.step_m").number_above(0.0, 1e6) : VisibilityParameters{}.step_m;
}

void read_resolved(const fs::path& folder, RunDrive& drive) {
    const fs::path file = folder / (file_name_of(drive.drive) + ".yaml");
    FilesRead ignored;
    drive.resolved = parse_yaml(read_file(file, ignored, max_bytes), file);
    YamlValue part = only(drive.resolved, {"views", "tone_mapper", "display", "speed", "step_s"});
    drop_unused_s(part);
    const YamlMap keys(YamlEntry(part, file, ""), {"views", "tone_mapper", "display", "speed", "step_s"});
    drive.views = read_views(keys, ignored);
    if (const auto tone_mapper = keys.find("tone_mapper"))
        read_tone_mapper(*tone_mapper, drive.tone_mapper);
    if (member_of(drive.resolved, "step_s"))
        drive.step_s = read_step_s(keys);
    if (member_of(drive.resolved, "speed"))
        for (const SpeedPoint& point : read_speed(keys))
            drive.step_m = std::max(drive.step_m, point.speed_mps * drive.step_s);
    drive.grid_cell_m = grid_cell_m(drive.resolved, file, drive.grid_cell_m);
    drive.look_step_m = look_step_m(drive.resolved, file);
    if (const YamlValue* road = member_of(drive.resolved, "road"))
        if (const auto hash = drive.hashes.find(road->text); hash != drive.hashes.end())
            drive.road_hash = hash->second;
}

RunDrive read_drive_of(const fs::path& folder, const PlayedCell& played, const CsvFile& moments,
                       const std::map<std::string, std::string>& hashes) {
    RunDrive drive;
    static_cast<PlayedResult&>(drive) = played_result(played, moments, "", decides_by_default());
    drive.folder = folder;
    drive.technique = played.technique;
    drive.hashes = hashes;
    const std::size_t time = moments.column("time_s"), speed = moments.column("car.speed_mps");
    for (std::size_t i = 0; i < moments.rows.size(); ++i)
        drive.time_s.push_back(moments.number(i, time));
    for (const PassTime& pass : played.passes)
        drive.pass_s[pass.name] = pass.seconds;
    read_resolved(folder, drive);
    if (drive.step_m == 0.0 && drive.step_s > 0.0) // a storyboard says the speed: the fastest that was played
        for (std::size_t i = 0; i < moments.rows.size(); ++i)
            drive.step_m = std::max(drive.step_m, moments.number(i, speed) * drive.step_s);
    const YamlValue* title = member_of(drive.resolved, "title");
    drive.title = title ? title->text : drive.drive;
    return drive;
}

} // namespace

RunFolder read_run_folder(const fs::path& folder) {
    std::error_code ignored;
    if (fs::is_directory(folder / "cells", ignored))
        throw InputError({folder, 0, 0, {}}, "is a study's folder",
                         "one of its cells, " + (folder / "cells" / "NAME").string() + ", or a run's folder");
    if (is_marked_incomplete(folder))
        throw InputError({folder, 0, 0, {}}, "holds a run that did not end", "the folder of a run that was played to its end");
    if (!fs::is_regular_file(folder / "report.json", ignored))
        throw InputError({folder, 0, 0, {}}, "has no report.json", "a folder as fernlicht run leaves it");
    const Report report = read_report(folder);
    const RunContext& context = report.context;
    RunFolder run{folder, context.command, context.started_utc, "", context.backend, context.gl_renderer, context.cpu, {}};
    for (const auto& [name, version] : context.versions)
        if (name == "fernlicht")
            run.version = version;
    std::map<std::string, std::string> hashes;
    for (const FileRead& input : context.inputs)
        hashes[input.path.string()] = input.xxh128;
    for (std::size_t i = 0; i < report.played.size(); ++i)
        run.drives.push_back(read_drive_of(folder, report.played[i], read_moments(folder, report, i), hashes));
    return run;
}

} // namespace fernlicht
