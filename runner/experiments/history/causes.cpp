#include "runner/experiments/history/causes.h"

#include "runner/files/clean_text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

/// Of a night's machine: within one device class they change no bit.
constexpr std::array of_times_alone{"CPU", "system"};

bool is_of_times_alone(const CellInput& input) {
    return input.kind == InputKind::device && std::ranges::find(of_times_alone, input.name) != of_times_alone.end();
}

constexpr const char* conditions_name = "conditions";

/// Where the study set something else in a drive, that is the change.
InputChanges with_conditions(InputChanges changes, const NightCell& before, const NightCell& now) {
    const auto is_played_otherwise = [](const InputChange& change) {
        return change.kind == InputKind::drive && !change.before.empty() && !change.now.empty();
    };
    if (before.condition != now.condition && std::erase_if(changes, is_played_otherwise) > 0) {
        changes.push_back({InputKind::setting, conditions_name, before.condition, now.condition});
        std::ranges::sort(changes);
    }
    return changes;
}

/// Of a night that kept no hashes.
bool is_version(const std::string& value) { return !value.empty() && value.size() < 32; }

std::string short_hash(const std::string& hash) { return hash.empty() ? "none" : hash.substr(0, 12); }

} // namespace

Cause cause_of(InputKind kind) {
    switch (kind) {
    case InputKind::program:
        return Cause::program;
    case InputKind::library:
    case InputKind::device:
        return Cause::machine;
    default:
        return Cause::inputs;
    }
}

const char* cause_name(Cause cause) { return std::array{"inputs", "program", "machine"}[static_cast<std::size_t>(cause)]; }

std::string phrase_of(const InputChange& change) {
    const std::string name = short_text(change.name, 60), kind = input_kind_name(change.kind);
    switch (change.kind) {
    case InputKind::program:
        if (is_version(change.before) || is_version(change.now))
            return fmt::format("{} {} → {}", name, change.before, change.now);
        return "sources in " + name;
    case InputKind::drive: // its hash is that of the drive as it is played, which no file has
        return fmt::format("drive {} {}", short_text(change.name, 120),
                           change.before.empty() ? "is new"
                           : change.now.empty()  ? "is gone"
                                                 : "as it is played");
    case InputKind::setting:
        if (change.name == conditions_name)
            return fmt::format("conditions {} → {}", short_text(change.before, 120), short_text(change.now, 120));
        [[fallthrough]];
    case InputKind::library:
    case InputKind::device: {
        const auto told = [](const std::string& value) { return value.empty() ? "none" : short_text(value, 60); };
        return fmt::format("{} {} → {}", change.kind == InputKind::device ? name : kind + " " + name, told(change.before),
                           told(change.now));
    }
    default:
        return fmt::format("{} {} ({} → {})", kind, name, short_hash(change.before), short_hash(change.now));
    }
}

std::string phrase_of(const InputChanges& changes) {
    std::string all;
    for (const Cause cause : {Cause::inputs, Cause::program, Cause::machine}) {
        std::string of_cause;
        for (const InputChange& change : changes)
            if (cause_of(change.kind) == cause)
                of_cause += (of_cause.empty() ? "" : ", ") + phrase_of(change);
        if (!of_cause.empty())
            all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", cause_name(cause), of_cause);
    }
    return all.empty() ? "cause not known: inputs, program and machine are as they were" : all;
}

std::string causes_of(const InputChanges& changes) {
    std::string all;
    for (const Cause cause : {Cause::inputs, Cause::program, Cause::machine})
        if (has_cause(changes, cause))
            all += fmt::format("{}{}", all.empty() ? "" : " and ", cause_name(cause));
    return all.empty() ? "not known" : all;
}

bool has_cause(const InputChanges& changes, Cause cause) {
    return std::ranges::any_of(changes, [&](const InputChange& change) { return cause_of(change.kind) == cause; });
}

std::string machine_in(const Night& night, const std::string& name) {
    const auto found =
        std::ranges::find_if(night.machine, [&](const CellInput& input) { return input.kind == InputKind::device && input.name == name; });
    return found == night.machine.end() ? "" : found->hash;
}

CellInputs deciding_inputs(const Night& night, const NightCell& cell) {
    CellInputs inputs = cell.inputs->empty() ? night.machine : *cell.inputs;
    std::erase_if(inputs, is_of_times_alone);
    return inputs;
}

CellInputs timing_inputs(const Night& night, const NightCell& cell) {
    CellInputs inputs = deciding_inputs(night, cell);
    std::ranges::copy_if(night.machine, std::back_inserter(inputs), is_of_times_alone);
    return inputs;
}

InputChanges changes_between(const Night& earlier, const NightCell& before, const Night& later, const NightCell& now) {
    static const NightCell without_inputs;
    const bool kept = !before.inputs->empty() && !now.inputs->empty();
    return with_conditions(
        changed_inputs(deciding_inputs(earlier, kept ? before : without_inputs), deciding_inputs(later, kept ? now : without_inputs)),
        before, now);
}

std::string device_class_of(const CellInputs& inputs) {
    std::string device;
    for (const CellInput& input : std::set(inputs.begin(), inputs.end()))
        if (input.kind == InputKind::device)
            device += fmt::format("{}\n{}\n", input.name, input.hash);
    return device;
}

} // namespace fernlicht
