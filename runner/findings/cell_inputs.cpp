#include "runner/findings/cell_inputs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <set>

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

/// What changed of a drive's keys, " (start, weather)"; "" where one of both did not tell them.
std::string changed_keys(const std::string& file, const HashesByInput& before, const HashesByInput& now) {
    const std::string begins = file + std::string(before_key);
    const auto keys_of = [&](const HashesByInput& inputs) {
        std::map<std::string, std::string> keys;
        for (const auto& [input, hash] : inputs)
            if (input.first == InputKind::drive && input.second.starts_with(begins))
                keys[input.second.substr(begins.size())] = hash;
        return keys;
    };
    const auto old_keys = keys_of(before), new_keys = keys_of(now);
    std::set<std::string> changed;
    for (const auto* const some : {&old_keys, &new_keys})
        for (const auto& [key, hash] : *some)
            if (const auto was = old_keys.find(key), is = new_keys.find(key);
                was == old_keys.end() || is == new_keys.end() || was->second != is->second)
                changed.insert(key);
    return old_keys.empty() || new_keys.empty() || changed.empty() ? "" : fmt::format(" ({})", fmt::join(changed, ", "));
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
    constexpr const char* changed = "changed";
    const HashesByInput old_inputs = hashes_of(before), new_inputs = hashes_of(now);
    std::set<std::pair<InputKind, std::string>> all;
    for (const CellInputs* const some : {&before, &now})
        for (const CellInput& input : *some)
            if (!is_key(input))
                all.emplace(input.kind, input.name);
    InputChanges changes;
    for (const auto& input : all) {
        const auto hash_in = [&](const HashesByInput& inputs) {
            const auto found = inputs.find(input);
            return found == inputs.end() ? std::string() : found->second;
        };
        const std::string was = hash_in(old_inputs), is = hash_in(new_inputs);
        if (was == is)
            continue;
        if (input.first == InputKind::drive)
            changes.push_back({input.first, input.second + changed_keys(input.second, old_inputs, new_inputs), was.empty() ? "" : changed,
                               is.empty() ? "" : changed});
        else
            changes.push_back({input.first, input.second, was, is});
    }
    std::ranges::sort(changes);
    return changes;
}

std::vector<std::string> input_changes(const CellInputs& before, const CellInputs& now) {
    std::vector<std::string> phrases;
    std::ranges::transform(changed_inputs(before, now), std::back_inserter(phrases), phrase_of_change);
    return phrases;
}

} // namespace fernlicht
