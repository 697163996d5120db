#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/compare/runs/run_pairs.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

const YamlValue* lamps_of(const RunDrive& drive) {
    const YamlValue* lamp_sets = member_of(drive.resolved, "lamp_sets");
    const YamlValue* lamp_set = lamp_sets ? member_of(*lamp_sets, drive.lamp_set) : nullptr;
    return lamp_set ? member_of(*lamp_set, "lamps") : nullptr;
}

std::string text_in(const YamlValue& map, const char* key) {
    const YamlValue* value = member_of(map, key);
    return value ? value->text : "";
}

std::string hash_of(const RunDrive& drive, const std::string& path) {
    const auto found = drive.hashes.find(path);
    return found == drive.hashes.end() ? "" : found->second;
}

/// The file as the run read it. Throws InputError where it is gone, is another one by now, or needs more than the file to be read.
LampFile read_as_played(const RunDrive& drive, const YamlValue& lamp) {
    const fs::path path = text_in(lamp, "file");
    LampFile file = read_lamp(path, {});
    if (file.opened.empty() || file.opened.front().xxh128 != hash_of(drive, path.string()))
        throw InputError({path, 0, 0, {}}, "is not the file any more that the run read");
    if (const std::string axis = text_in(lamp, "type_c_axis"); !axis.empty() && axis != "automatic")
        throw InputError({path, 0, 0, {}}, "was read with an axis of its own");
    return file;
}

} // namespace

void compare_lamp_files(DriveComparison& drive) {
    const YamlValue *before = lamps_of(drive.before), *now = lamps_of(drive.now);
    if (!before || !now)
        return;
    for (const YamlMember& lamp : now->members) {
        const YamlValue* other = member_of(*before, lamp.key);
        if (!other)
            continue;
        const std::string file = text_in(lamp.value, "file"), old_file = text_in(*other, "file");
        if (file.empty() || old_file.empty() || hash_of(drive.now, file) == hash_of(drive.before, old_file))
            continue;
        const auto same =
            std::ranges::find_if(drive.lamp_files, [&](const LampFilesDifference& d) { return d.now == file && d.before == old_file; });
        if (same != drive.lamp_files.end()) {
            same->lamps += ", " + lamp.key;
            continue;
        }
        try {
            const LampFile tested = read_as_played(drive.now, lamp.value), against = read_as_played(drive.before, *other);
            drive.lamp_files.push_back({lamp.key, old_file, file, difference_of(tested, against, 0.0)});
            plots::Figure figure = difference_figure(tested, against, drive.lamp_files.back().difference);
            drive.figures.push_back({fmt::format("lamps_{}_{}", drive.name, drive.lamp_files.size()), figure.title, figure});
        } catch (const InputError& error) {
            drive.left_out.push_back(fmt::format("the tables of the lamp {}, and their noise: {}", printable(lamp.key), error.what()));
        }
    }
}

} // namespace fernlicht
