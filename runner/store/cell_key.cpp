#include "runner/store/cell_key.h"

#include "renderer/reference/embree_scene.h"
#include "runner/judge/baseline_key.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>
#include <gnu/libc-version.h>

namespace fernlicht {
namespace {

/// Contents of these are told apart from one another by their order alone.
bool is_file(InputKind kind) {
    return kind == InputKind::drive || kind == InputKind::road || kind == InputKind::lamp || kind == InputKind::model;
}

std::string hash_of_files(const FilesRead& files) {
    if (files.size() == 1)
        return files.front().xxh128;
    std::string all;
    for (const FileRead& file : files)
        all += file.xxh128 + "\n";
    return content_hash(all.data(), all.size());
}

std::string lamp_mark(std::size_t number) { return fmt::format("<lamp {}>", number); }

/// Each file by its content instead of its path.
std::string without_paths(std::string bits, const FilesRead& files) {
    std::vector<const FileRead*> longest_first;
    for (const FileRead& file : files)
        longest_first.push_back(&file);
    std::ranges::stable_sort(longest_first, std::greater(), [](const FileRead* file) { return file->path.native().size(); });
    for (const FileRead* const file : longest_first)
        for (std::size_t at = bits.find(file->path.native()); at != std::string::npos; at = bits.find(file->path.native(), at))
            bits.replace(at, file->path.native().size(), file->xxh128);
    return bits;
}

/// The sources that the drive uses, in their order: all others were replaced, by a study's lamps for one.
std::vector<const LampSource*> lamps_in_use(const Drive& drive) {
    Drive marked = drive;
    for (std::size_t i = 0; i < marked.lamp_sources.size(); ++i)
        marked.lamp_sources[i].path = lamp_mark(i);
    const std::string bits = drive_bits(marked);
    std::vector<const LampSource*> used;
    for (std::size_t i = 0; i < drive.lamp_sources.size(); ++i)
        if (const LampSource& source = drive.lamp_sources[i];
            bits.find(lamp_mark(i)) != std::string::npos || source.file == drive.adaptation_lamp)
            used.push_back(&source);
    return used;
}

} // namespace

CellInputs cell_inputs(const Drive& drive, const FilesRead& road, const FilesRead& others, const CellSettings& settings) {
    CellInputs inputs;
    Drive one = drive;
    one.title.clear();
    one.limits.clear();
    one.road_file.clear();
    FilesRead files = drive.opened;
    files.insert(files.end(), others.begin(), others.end());
    const std::vector<const LampSource*> lamps = lamps_in_use(drive);
    for (std::size_t i = 0; i < one.lamp_sources.size(); ++i) {
        LampSource& source = one.lamp_sources[i];
        const auto used = std::ranges::find(lamps, source.file, [](const LampSource* lamp) { return lamp->file; });
        source.path = used == lamps.end() ? "" : lamp_mark(static_cast<std::size_t>(used - lamps.begin()));
        source.options.recipe.clear(); // its content is among what was opened
    }
    std::string all;
    CellInputs keys;
    for (const auto& [key, told] : drive_bits_by_key(one)) {
        const std::string bits = without_paths(told, files);
        all += bits;
        keys.push_back({InputKind::drive, fmt::format("{}{}{}", drive.file.filename().string(), before_key, key),
                        content_hash(bits.data(), bits.size())});
    }
    inputs.push_back({InputKind::drive, drive.file.filename().string(), content_hash(all.data(), all.size())});
    inputs.insert(inputs.end(), keys.begin(), keys.end());
    inputs.push_back({InputKind::road, road.empty() ? "" : road.front().path.filename().string(), hash_of_files(road)});
    for (const LampSource* const lamp : lamps)
        inputs.push_back({InputKind::lamp, lamp->path.filename().string(), hash_of_files(lamp->file->opened)});
    for (const FileRead& file : others)
        inputs.push_back({InputKind::model, file.path.filename().string(), file.xxh128});
    inputs.push_back({InputKind::setting, "moments", fmt::format("{}:{}", settings.first_tick, settings.last_tick)});
    inputs.push_back({InputKind::setting, "accuracy", settings.accuracy ? "measured" : "left out"});
    inputs.push_back({InputKind::setting, "plays", fmt::format("{}", settings.repeats)});
    return inputs;
}

CellInputs machine_inputs(const RunContext& context, bool accuracy) {
    CellInputs inputs;
    for (const auto& [folder, hash] : program_sources())
        inputs.push_back({InputKind::program, folder, hash});
    for (const auto& [library, version] : context.versions)
        if (library != "fernlicht") // its sources tell
            inputs.push_back({InputKind::library, library, version});
    const BaselineKey device = baseline_key("", "", "", context, {});
    inputs.push_back({InputKind::device, "backend", device.backend});
    inputs.push_back({InputKind::device, "driver", context.gl_version});
    inputs.push_back({InputKind::device, "renderer", device.gl_renderer});
    inputs.push_back({InputKind::device, "SIMD", device.simd});
    inputs.push_back({InputKind::library, "glibc", ::gnu_get_libc_version()}); // its libm
    if (accuracy) {                                                            // the reference's rays differ where pictures do not
        const std::size_t open = context.cpu.rfind('('), close = context.cpu.rfind(')');
        inputs.push_back({InputKind::device, "SIMD of the reference", context.cpu.substr(open + 1, close - open - 1)});
        inputs.push_back({InputKind::library, "Embree", reference::embree_version()});
    }
    return inputs;
}

std::string cell_key(const CellInputs& inputs) {
    std::string text = "cell 1\n";
    for (const CellInput& input : inputs)
        text += fmt::format("{} {} {}\n", input_kind_name(input.kind), is_file(input.kind) ? "" : input.name, input.hash);
    return content_hash(text.data(), text.size());
}

} // namespace fernlicht
