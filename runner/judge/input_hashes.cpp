#include "runner/judge/input_hashes.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/yaml/old_names.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

bool uses(const LampSet& lamp_set, const LampFile* file) {
    return std::ranges::any_of(lamp_set.lamps, [&](const MountedLamp& lamp) { return lamp.file.get() == file; }) ||
           std::ranges::any_of(lamp_set.changes, [&](const LampChange& change) { return change.file.get() == file; });
}

} // namespace

std::string input_hash(const FilesRead& files) {
    std::string all;
    for (const FileRead& file : files)
        all += file.xxh128 + "\n";
    return content_hash(all.data(), all.size());
}

std::vector<std::pair<std::string, std::string>> input_hashes(const Drive& drive, const LampSet& lamp_set, const FilesRead& road,
                                                              int first_tick, int last_tick) {
    Drive one = drive;
    one.lamp_sets = {lamp_set};
    one.title.clear();
    one.limits.clear();
    one.road_file.clear();
    std::vector<std::pair<std::string, std::string>> lamps;
    for (LampSource& source : one.lamp_sources)
        if (uses(lamp_set, source.file.get())) {
            source.path = fmt::format("lamp file {}", lamps.size() + 1);
            source.options.recipe.clear(); // its content is among what was opened
            lamps.emplace_back(source.path.string(), input_hash(source.file->opened));
        }
    for (MountedLamp& lamp : one.lamp_sets.front().lamps)
        if (lamp.levels) {
            lamp.levels_file.clear();
            lamps.emplace_back("levels of " + lamp.name, input_hash(lamp.levels->opened()));
        }
    const std::string bits = drive_bits(one) + fmt::format("moments: [{}, {}]\n", first_tick, last_tick);
    std::vector<std::pair<std::string, std::string>> inputs{{"drive", content_hash(bits.data(), bits.size())}, {"road", input_hash(road)}};
    std::ranges::move(lamps, std::back_inserter(inputs));
    return inputs;
}

std::string text_hashed_before(Drive drive) {
    drive.title.clear();
    drive.display.white = {}; // no picture was adapted to one
    drive.limits.clear();
    drive.road_file = "road";
    int used = 0;
    for (LampSource& source : drive.lamp_sources)
        if (uses(drive.lamp_sets.front(), source.file.get()))
            source.path = fmt::format("lamp file {}", ++used);
    for (LampSet& lamp_set : drive.lamp_sets) // was always stated
        for (MountedLamp& lamp : lamp_set.lamps)
            lamp.reference_voltage_v = lamp.reference_voltage_v.value_or(un_voltage_v);
    for (TrafficRow& row : drive.traffic_rows)
        for (MountedLamp& lamp : row.lamps)
            lamp.reference_voltage_v = lamp.reference_voltage_v.value_or(un_voltage_v);
    if (drive.seeing.glare)
        drive.seeing.glare->adaptation_cdm2 = drive.seeing.glare->adaptation_cdm2.value_or(1.0);
    const std::string text = write_drive(drive);
    std::vector<std::string> unmatched;
    return renamed_keys(text.substr(text.find('\n') + 1), {}, Naming::before, unmatched); // the comment names the program's version
}

} // namespace fernlicht
