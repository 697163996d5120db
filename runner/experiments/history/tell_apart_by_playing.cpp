#include "runner/experiments/history/tell_apart_by_playing.h"

#include "runner/experiments/history/night_of_study.h"
#include "runner/experiments/study/cell_collecting.h"
#include "runner/experiments/study/cell_playing.h"
#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

CellInputs of_kind(const CellInputs& inputs, InputKind kind) {
    CellInputs some;
    std::ranges::copy_if(inputs, std::back_inserter(some), [&](const CellInput& input) { return input.kind == kind && !is_key(input); });
    return some;
}

std::vector<std::string> hashes_of(const CellInputs& inputs, InputKind kind) {
    std::vector<std::string> hashes;
    for (const CellInput& input : of_kind(inputs, kind))
        hashes.push_back(input.hash);
    return hashes;
}

/// In the study's lamp, where its file's content is that of `today`.
bool put_back(StudyLamp& lamp, const CellInput& today, const fs::path& earlier) {
    bool found = false;
    for (fs::path* const file : {&lamp.left, &lamp.right, &lamp.high}) {
        FilesRead opened;
        if (file->empty() || read_file(*file, opened).empty() || opened.front().xxh128 != today.hash)
            continue;
        *file = earlier;
        found = true;
    }
    return found;
}

Replayed with_earlier_lamps(const Study& study, const StudyOptions& options, const CellRequest& request) {
    const CellStore store(options.store);
    const Workplace place = store.new_workplace("before");
    StudyOptions one = options;
    one.only = {request.cell};
    one.expected.clear();
    one.timed = false;
    one.folder = place.folder() / "out";
    const StudyPlan today = plan_study(study, one);
    const CellInputs now = today.inputs(today.cells.front());
    for (const InputKind kind : {InputKind::drive, InputKind::road, InputKind::model, InputKind::setting})
        if (hashes_of(now, kind) != hashes_of(request.inputs, kind))
            return {{}, fmt::format("its {} was another, too, and only lamps can be put back", input_kind_name(kind))};
    const CellInputs lamps = of_kind(now, InputKind::lamp), earlier = of_kind(request.inputs, InputKind::lamp);
    if (lamps.size() != earlier.size())
        return {{}, "it had another number of lamps"};
    Study before = study;
    StudyLamp& lamp = before.lamps[today.cells.front().cell.lamp];
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        if (lamps[i].hash == earlier[i].hash)
            continue;
        const fs::path file = place.folder() / fmt::format("{}", i) / fs::path(earlier[i].name).filename();
        make_folder(file.parent_path());
        write_file(file, get_object(store.folder(), earlier[i].hash, "lamp that was kept"));
        if (!put_back(lamp, lamps[i], file))
            return {{}, fmt::format("lamp {} is not the study's own", lamps[i].name)};
    }
    const StudyPlan plan = plan_study(before, one);
    const PlannedCell& planned = plan.cells.front();
    if (!store.find(planned.key) && !play_into(store, before, plan, planned, one))
        return {{}, "it was interrupted"};
    CellResult result = unplayed_cell(before, plan, planned);
    one.judge_cell = [](const Report&, const fs::path&) {};
    collect_cell(store, before, planned, one, result);
    return {night_readings(result), {}};
}

} // namespace

TellApart tell_apart_by_playing(const Study& study, const StudyOptions& options) {
    return [&study, &options](const CellRequest& request) -> Replayed {
        if (request.study != study.name)
            return {{}, "its study is another"};
        try {
            return with_earlier_lamps(study, options, request);
        } catch (const std::exception& error) {
            return {{}, error.what()};
        }
    };
}

} // namespace fernlicht
