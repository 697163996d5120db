#include "runner/findings/cell_inputs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace fernlicht {
namespace {

constexpr std::array input_kind_names{"drive", "road", "lamp", "model", "setting", "program", "library", "device"};

using HashesByInput = std::map<std::pair<InputKind, std::string>, std::string>;

/// Of several with one name, all of their hashes.
HashesByInput hashes_of(const CellInputs& inputs) {
    HashesByInput hashes;
    for (const CellInput& input : inputs)
        hashes[{input.kind, input.name}] += input.hash;
    return hashes;
}

std::string file_of_drive(const std::string& name) { return name.substr(0, name.rfind(before_key)); }

/// Where it is played before and now, as one.
InputChanges with_drives_as_one(InputChanges changes, const HashesByInput& before, const HashesByInput& now) {
    constexpr const char* changed = "changed";
    const auto has = [](const HashesByInput& inputs, const std::string& file) {
        return std::ranges::any_of(
            inputs, [&](const auto& input) { return input.first.first == InputKind::drive && file_of_drive(input.first.second) == file; });
    };
    std::map<std::string, std::string> keys_by_file;
    for (const InputChange& change : changes)
        if (change.kind == InputKind::drive) {
            const std::string file = file_of_drive(change.name);
            std::string& keys = keys_by_file[file];
            if (file != change.name) // else of a program that told no keys
                keys += (keys.empty() ? "" : ", ") + change.name.substr(file.size() + before_key.size());
        }
    std::erase_if(changes, [](const InputChange& change) { return change.kind == InputKind::drive; });
    for (const auto& [file, keys] : keys_by_file) {
        const bool was = has(before, file), is = has(now, file);
        changes.push_back({InputKind::drive, was && is && !keys.empty() ? fmt::format("{} ({})", file, keys) : file, was ? changed : "",
                           is ? changed : ""});
    }
    std::ranges::sort(changes);
    return changes;
}

std::string phrase_of_change(const InputChange& change) {
    const char* const kind = input_kind_name(change.kind);
    if (change.before.empty() || change.now.empty())
        return fmt::format("{} {} is {}", kind, change.name, change.before.empty() ? "new" : "gone");
    switch (change.kind) {
    case InputKind::program:
        return fmt::format("program changed: {}", change.name);
    case InputKind::setting:
    case InputKind::library:
    case InputKind::device:
        return fmt::format("{} changed: {} {} -> {}", kind, change.name, change.before, change.now);
    case InputKind::drive:
        return fmt::format("drive changed: {}, in its file or set by the study", change.name);
    default: // a comment in it counts as well
        return fmt::format("{} {} changed (bytes of its file)", kind, change.name);
    }
}

} // namespace

const char* input_kind_name(InputKind kind) { return input_kind_names[static_cast<std::size_t>(kind)]; }

JsonMembers cell_input_members(CellInput& input) {
    const auto names = [] { return std::vector<std::string>(input_kind_names.begin(), input_kind_names.end()); };
    return {{"kind", one_of(input.kind, names)}, {"name", input.name}, {"hash", input.hash}};
}

InputChanges changed_inputs(const CellInputs& before, const CellInputs& now) {
    const HashesByInput old_inputs = hashes_of(before), new_inputs = hashes_of(now);
    InputChanges changes;
    for (const auto& [input, hash] : new_inputs) {
        const auto found = old_inputs.find(input);
        const std::string was = found == old_inputs.end() ? "" : found->second;
        if (was != hash)
            changes.push_back({input.first, input.second, was, hash});
    }
    for (const auto& [input, hash] : old_inputs)
        if (!new_inputs.contains(input))
            changes.push_back({input.first, input.second, hash, ""});
    return with_drives_as_one(std::move(changes), old_inputs, new_inputs);
}

std::vector<std::string> input_changes(const CellInputs& before, const CellInputs& now) {
    std::vector<std::string> phrases;
    std::ranges::transform(changed_inputs(before, now), std::back_inserter(phrases), phrase_of_change);
    return phrases;
}

} // namespace fernlicht
