#include "runner/experiments/history/night_of_study.h"

#include "runner/experiments/study/study_document.h"
#include "runner/files/output_folder.h"
#include "scenarios/studies/study_axes.h"
#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Whole, with what is usual: nights that other versions kept are known by it.
std::string condition_of(const StudyResult& result, const StudyCell& cell) {
    const StudyConditions& all = result.study.conditions;
    std::string condition;
    const auto add = [&](bool is_there, const std::string& part) {
        if (is_there && !part.empty())
            condition += (condition.empty() ? "" : ", ") + part;
    };
    if (cell.time_of_day < all.times_of_day.size())
        add(true, all.times_of_day[cell.time_of_day].name);
    if (cell.aim < all.aim_percent.size())
        add(true, fmt::format("aim {:g} %", all.aim_percent[cell.aim]));
    if (cell.voltage < all.voltage_v.size())
        add(true, fmt::format("{:g} V", all.voltage_v[cell.voltage]));
    add(cell.mirror < all.mirror.size() && all.mirror[cell.mirror], "mirrored");
    if (cell.point < result.study.points.size() && !result.study.axes.empty())
        add(true, point_text(result.study.axes, result.study.points[cell.point]));
    else // of a study read back
        for (const AxisValue& axis : cell.axes)
            add(true, axis.axis + " " + axis.value);
    return condition;
}

CellInputs machine_of(const RunContext& context) {
    const std::size_t open = context.cpu.rfind('(');
    const bool has_class = open != std::string::npos && context.cpu.ends_with(')');
    CellInputs machine{{InputKind::device, "backend", context.backend},
                       {InputKind::device, "renderer", context.gl_renderer},
                       {InputKind::device, "driver", context.gl_version},
                       {InputKind::device, "CPU class", has_class ? context.cpu.substr(open + 1, context.cpu.size() - open - 2) : ""},
                       {InputKind::device, "CPU", context.cpu},
                       {InputKind::device, "system", context.os}};
    for (const auto& [name, version] : context.versions)
        machine.push_back({name == "fernlicht" ? InputKind::program : InputKind::library, name, version});
    std::erase_if(machine, [](const CellInput& input) { return input.hash.empty(); });
    return machine;
}

} // namespace

NightReadings night_readings(const ReadingsOfCell& cell) {
    NightReadings readings;
    for (const auto& [key, reading] : cell.readings)
        if (!is_time(key))
            readings.emplace(name_of(key), reading.value);
    return readings;
}

Night night_of_study(const StudyResult& result, const std::filesystem::path& folder) {
    Night night;
    night.study = result.study.name;
    night.played_utc = result.context.started_utc;
    night.folder = std::filesystem::absolute(folder).lexically_normal().string();
    night.machine = machine_of(result.context);
    night.decide = result.study.decide;
    for (const CellResult& cell : result.cells) {
        const std::string technique =
            cell.cell.technique < result.study.techniques.size() ? result.study.techniques[cell.cell.technique] : "";
        night.cells.push_back({cell.cell.name, cell.drive, result.study.lamps[cell.cell.lamp].name, technique,
                               condition_of(result, cell.cell), cell.failed, std::make_shared<CellInputs>(cell.inputs),
                               std::make_shared<NightReadings>(night_readings(all_readings(result, cell))), nullptr, cell.frame_s});
    }
    return night;
}

void take_replays(Night& tonight, const std::map<std::string, NightReadings>& replays) {
    for (NightCell& cell : tonight.cells)
        if (const auto replay = replays.find(cell.name); replay != replays.end())
            cell.with_earlier_inputs = std::make_shared<NightReadings>(replay->second);
}

Night read_night(const std::filesystem::path& folder, std::string* played_in_part) {
    std::error_code ignored;
    if (is_marked_incomplete(folder))
        throw InputError({folder, 0, 0, {}}, "holds a study that did not end", "a complete one; `fernlicht study --resume` goes on");
    if (!std::filesystem::exists(folder / "study.json", ignored))
        throw InputError({folder, 0, 0, {}}, "is no folder of a study", "one that `fernlicht study` wrote");
    const StudyResult result = from_json<StudyResult>(CheckedJson::read(folder / "study.json"), study_members);
    if (played_in_part)
        *played_in_part = result.played_in_part;
    return night_of_study(result, folder);
}

} // namespace fernlicht
