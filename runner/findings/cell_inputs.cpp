#include "runner/findings/cell_inputs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

constexpr std::array input_kind_names{"drive", "road", "lamp", "model", "setting", "program", "library", "device"};

using InputsByName = std::map<std::pair<InputKind, std::string>, std::string>;

InputsByName by_kind_and_name(const CellInputs& inputs) {
    InputsByName all;
    for (const CellInput& input : inputs)
        all[{input.kind, input.name}] += input.hash;
    return all;
}

std::string phrase_of_change(InputKind kind, const std::string& name, const std::string& before, const std::string& now) {
    switch (kind) {
    case InputKind::program:
        return fmt::format("program changed: {}", name);
    case InputKind::setting:
    case InputKind::library:
    case InputKind::device:
        return fmt::format("{} changed: {} {} -> {}", input_kind_name(kind), name, before, now);
    case InputKind::drive:
        return fmt::format("drive {} changed as it is played (its file, or what the study sets in it)", name);
    default: // a comment in it counts as well
        return fmt::format("{} {} changed (bytes of its file)", input_kind_name(kind), name);
    }
}

} // namespace

const char* input_kind_name(InputKind kind) { return input_kind_names[static_cast<std::size_t>(kind)]; }

JsonMembers cell_input_members(CellInput& input) {
    const auto names = [] { return std::vector<std::string>(input_kind_names.begin(), input_kind_names.end()); };
    return {{"kind", one_of(input.kind, names)}, {"name", input.name}, {"hash", input.hash}};
}

std::vector<std::string> input_changes(const CellInputs& before, const CellInputs& now) {
    const InputsByName old_inputs = by_kind_and_name(before), new_inputs = by_kind_and_name(now);
    std::vector<std::string> phrases;
    for (const auto& [key, hash] : new_inputs)
        if (const auto old_input = old_inputs.find(key); old_input == old_inputs.end())
            phrases.push_back(fmt::format("{} {} is new", input_kind_name(key.first), key.second));
        else if (old_input->second != hash)
            phrases.push_back(phrase_of_change(key.first, key.second, old_input->second, hash));
    for (const auto& [key, hash] : old_inputs)
        if (!new_inputs.contains(key))
            phrases.push_back(fmt::format("{} {} is gone", input_kind_name(key.first), key.second));
    return phrases;
}

} // namespace fernlicht
