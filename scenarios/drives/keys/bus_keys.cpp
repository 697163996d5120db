#include "scenarios/drives/keys/bus_keys.h"

#include "scenarios/can/bus_mapping.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/control/signals.h"
#include "scenarios/drives/keys/drive_texts.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_databases = 64, most_mapped = 1000, most_listed_values = 1000;
constexpr double largest_factor = 1.0e12, longest_stale_s = 1.0e6, longest_cycle_s = 1000.0, shortest_cycle_s = 1.0e-4;
constexpr BusState policy_states[] = {BusState::stale, BusState::missing, BusState::out_of_range, BusState::contradictory};

InputError::Where place_of(const YamlEntry& entry) { return {entry.file(), entry.value().line, entry.value().column, entry.key_path()}; }

/// A map whose keys are names of a database, or of signals with a star: any text.
std::vector<std::pair<std::string, YamlEntry>> texts_of(const YamlEntry& entry, std::size_t most) {
    const std::vector<YamlMember>& members = entry.value().members;
    if (entry.is_scalar() || entry.is_list() || members.empty() || members.size() > most)
        entry.refuse(fmt::format("a map of 1 to {} names", most));
    std::vector<std::pair<std::string, YamlEntry>> entries;
    for (const YamlMember& member : members)
        entries.emplace_back(member.key, YamlEntry(member.value, entry.file(), fmt::format("{}.{}", entry.key_path(), member.key)));
    return entries;
}

BusSource read_source(const YamlEntry& entry) {
    const std::string text = entry.text();
    const std::size_t dot = text.find('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == text.size() || text.find('.', dot + 1) != std::string::npos)
        entry.refuse("Message.Signal, as the database names them");
    return {text.substr(0, dot), text.substr(dot + 1)};
}

BusSource source_from_key(const std::string& key, const YamlEntry& entry) {
    const std::size_t dot = key.find('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == key.size() || key.find('.', dot + 1) != std::string::npos)
        entry.refuse(fmt::format("'{}'", printable(key)), "Message.Signal, as the database names them");
    return {key.substr(0, dot), key.substr(dot + 1)};
}

const SignalKind& kind_named(const std::string& name, const YamlEntry& entry) {
    if (const SignalKind* const kind = known_signal(name))
        return *kind;
    std::vector<std::string> names;
    for (const SignalKind& kind : known_signals())
        names.emplace_back(kind.name);
    const std::string near = nearest_name(name, names);
    entry.refuse(fmt::format("no signal '{}'", printable(name)),
                 near.empty() ? "a signal that 'fernlicht signals' lists" : fmt::format("'{}', the nearest signal", near));
}

std::vector<std::pair<std::string, double>> read_values(const YamlMap& keys, const SignalKind& kind) {
    std::vector<std::pair<std::string, double>> values;
    if (const auto given = keys.find("values"))
        for (const auto& [text, entry] : texts_of(*given, most_listed_values))
            values.emplace_back(text, entry.number(std::max(kind.least, -1.0e12), std::min(kind.greatest, 1.0e12)));
    return values;
}

/// factor and offset, neither of them beside `values`.
template <class Mapped> void read_scale(const YamlMap& keys, Mapped& mapped) {
    if (const auto factor = keys.find("factor")) {
        mapped.factor = factor->number(-largest_factor, largest_factor);
        if (*mapped.factor == 0.0)
            factor->refuse("a number that is not 0");
    }
    mapped.opposite = keys.flag_or("opposite", false);
    if (const auto offset = keys.find("offset"))
        mapped.offset = offset->number(-largest_factor, largest_factor);
    if (!mapped.values.empty() && (mapped.factor || mapped.offset))
        keys.entry().refuse("values beside factor or offset", "one of them");
}

BusInput read_bus_input(const std::string& name, const YamlEntry& entry) {
    BusInput input;
    input.name = name;
    input.where = place_of(entry);
    input.policies.fill(BusPolicy::lost);
    const SignalKind& kind = kind_named(name, entry);
    if (!may_come_from_bus(kind))
        entry.refuse(fmt::format("{}, which the {} write", name, kind.writer),
                     "a signal that car, road, driver or another controller gives");
    if (entry.is_scalar()) {
        input.source = read_source(entry);
        return input;
    }
    const YamlMap keys = entry.map({"signal", "also", "tolerance", "factor", "offset", "values", "opposite", "stale_after_s", "stale",
                                    "missing", "out_of_range", "contradictory", "default"});
    input.source = read_source(keys.require("signal"));
    input.values = read_values(keys, kind);
    read_scale(keys, input);
    if (const auto also = keys.find("also"))
        input.also = read_source(*also);
    if (const auto tolerance = keys.find("tolerance")) {
        if (!input.also)
            tolerance->refuse("a tolerance without a second signal", "also: Message.Signal beside it");
        input.tolerance = tolerance->number(0.0, largest_factor);
    }
    if (const auto stale = keys.find("stale_after_s"))
        input.stale_after_s = stale->number_above(0.0, longest_stale_s);
    if (const auto fallback = keys.find("default"))
        input.fallback = fallback->number(std::max(kind.least, -1.0e12), std::min(kind.greatest, 1.0e12));
    for (const BusState state : policy_states) {
        const auto given = keys.find(name_of(state));
        if (!given)
            continue;
        if (state == BusState::contradictory && !input.also)
            given->refuse("a policy for contradictory signals without a second one", "also: Message.Signal beside it");
        const auto policy = static_cast<BusPolicy>(given->choice({"hold", "default", "lost", "fail"}));
        if (policy == BusPolicy::fallback && !input.fallback)
            given->refuse("'default' without a value", "default: NUMBER beside it");
        input.policies[static_cast<std::size_t>(state)] = policy;
    }
    return input;
}

BusOutput read_bus_output(const std::string& target, const YamlEntry& entry) {
    BusOutput output;
    output.target = source_from_key(target, entry);
    output.where = place_of(entry);
    if (entry.is_scalar()) {
        output.name = entry.text();
        kind_named(output.name, entry);
    } else {
        const YamlMap keys = entry.map({"signal", "factor", "offset", "values", "opposite", "cycle_s"});
        const YamlEntry signal = keys.require("signal");
        output.name = signal.text();
        output.values = read_values(keys, kind_named(output.name, signal));
        read_scale(keys, output);
        if (const auto cycle = keys.find("cycle_s"))
            output.cycle_s = cycle->number(shortest_cycle_s, longest_cycle_s);
    }
    if (output.name.find('*') != std::string::npos)
        entry.refuse("a star: one signal of the bus for many of ours", "the name of a lamp in its place");
    return output;
}

std::vector<std::string> lamps_of(const Variant& variant) {
    std::vector<std::string> names;
    for (const MountedLamp& lamp : variant.lamps)
        names.push_back(lamp.name);
    return names;
}

void check_variant(const BusMapping& mapping, const Variant& variant) {
    const BusWriter writer(mapping, lamps_of(variant));
    const SignalTable table(lamps_of(variant));
    for (const BusOutput& output : mapping.outputs)
        try {
            table.find(output.name);
        } catch (const std::invalid_argument& error) {
            throw InputError(output.where, fmt::format("no signal '{}' in variant '{}'", printable(output.name), variant.name),
                             error.what());
        }
    for (const BusInput& input : mapping.inputs)
        if (variant.swivel && input.name.starts_with("lamp.") && input.name.find(".swivel") != std::string::npos)
            throw InputError(input.where, fmt::format("{} beside actuators.swivel of variant '{}'", input.name, variant.name),
                             "one of them");
}

std::string values_text(const std::vector<std::pair<std::string, double>>& values) {
    std::string text;
    for (const auto& [said, value] : values)
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", quoted(said), value);
    return ", values: {" + text + "}";
}

template <class Mapped> std::string scale_text(const Mapped& mapped) {
    return (mapped.factor ? fmt::format(", factor: {}", *mapped.factor) : "") +
           (mapped.offset ? fmt::format(", offset: {}", *mapped.offset) : "") + (mapped.values.empty() ? "" : values_text(mapped.values)) +
           (mapped.opposite ? ", opposite: true" : "");
}

std::string stamp_text(std::int64_t ns) {
    const std::int64_t rest = ns % 1'000'000'000;
    return fmt::format("{}.{:09}", ns / 1'000'000'000, rest);
}

} // namespace

bool may_come_from_bus(const SignalKind& kind) {
    if (kind.name == "time_s" || kind.name == "lamp.*.segments_lit" || kind.name == "lamp.*.swivel_stuck")
        return false;
    return kind.name.starts_with("lamp.") || kind.writer != "laws";
}

std::optional<std::int64_t> stamp_from_text(const std::string& text) {
    const std::size_t dot = text.find('.');
    const std::string whole = text.substr(0, dot), part = dot == std::string::npos ? "" : text.substr(dot + 1);
    const auto digits = [](const std::string& of) { return std::ranges::all_of(of, [](char c) { return c >= '0' && c <= '9'; }); };
    if (whole.empty() || whole.size() > 10 || part.size() > 9 || !digits(whole) || !digits(part) ||
        (dot != std::string::npos && part.empty()))
        return std::nullopt;
    const std::string all = whole + part + std::string(9 - part.size(), '0');
    std::int64_t ns = 0;
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), ns);
    return error == std::errc() ? std::optional(ns) : std::nullopt;
}

void read_can(const YamlMap& keys, const DriveEdits& edits, Drive& drive) {
    const auto given = keys.find("can");
    if (!given) {
        if (edits.can_log || edits.can_start_ns || edits.can_channel)
            throw InputError({drive.file, 0, 0, "can"}, "found a drive without `can`", "a mapping of its signals to those of a bus");
        return;
    }
    const YamlMap of = given->map({"databases", "channel", "log", "start", "inputs", "outputs"});
    BusMapping mapping;
    mapping.where = place_of(*given);
    const YamlEntry databases = of.require("databases");
    for (const YamlEntry& database : databases.is_scalar() ? std::vector{databases} : databases.list(1, most_databases)) {
        mapping.databases.push_back(database.path());
        check_file(mapping.databases.back(), database);
    }
    if (const auto channel = of.find("channel"))
        mapping.channel = channel->name();
    if (const auto log = of.find("log")) {
        mapping.scripted = log->text() == "none";
        if (!mapping.scripted) {
            mapping.log = log->path();
            if (!edits.can_log)
                check_file(*mapping.log, *log);
        }
    }
    if (const auto start = of.find("start")) {
        mapping.start_ns = stamp_from_text(start->text());
        if (!mapping.start_ns)
            start->refuse("a stamp of the recording in seconds, as 1436509052.249713");
        if (!mapping.log)
            start->refuse("a start without a recording", "log: FILE beside it");
    }
    if (const auto inputs = of.find("inputs"))
        for (const auto& [name, entry] : texts_of(*inputs, most_mapped))
            mapping.inputs.push_back(read_bus_input(name, entry));
    if (const auto outputs = of.find("outputs"))
        for (const auto& [target, entry] : texts_of(*outputs, most_mapped))
            mapping.outputs.push_back(read_bus_output(target, entry));
    if (mapping.inputs.empty() && mapping.outputs.empty())
        given->refuse("a bus without signals", "inputs, outputs or both");
    if (edits.can_log) {
        mapping.scripted = edits.can_log->empty();
        mapping.log = mapping.scripted ? std::nullopt : std::optional(std::filesystem::absolute(*edits.can_log).lexically_normal());
        mapping.start_ns.reset();
    }
    if (edits.can_start_ns && mapping.scripted)
        throw InputError({drive.file, 0, 0, "--can-start"}, "found a start of a drive that is played without a recording",
                         "--can-log FILE beside it");
    if (edits.can_start_ns)
        mapping.start_ns = edits.can_start_ns;
    if (edits.can_channel)
        mapping.channel = *edits.can_channel;
    const auto known = std::ranges::find_if(drive.variants, [](const Variant& variant) { return variant.control != nullptr; });
    ControlParameters no_laws;
    no_laws.period_s = known == drive.variants.end() ? no_laws.period_s : (*known).control->period_s;
    for (Variant& variant : drive.variants) {
        check_variant(mapping, variant);
        if (!variant.control)
            variant.control = std::make_shared<const ControlParameters>(no_laws);
    }
    drive.can = std::make_shared<const BusMapping>(std::move(mapping));
    bus_period_s(drive);
}

std::string can_text(const Drive& drive) {
    if (!drive.can)
        return "";
    const BusMapping& mapping = *drive.can;
    std::string text = "\n  databases:";
    for (const std::filesystem::path& path : mapping.databases)
        text += fmt::format("\n    - {}", quoted(path.string()));
    if (!mapping.channel.empty())
        text += fmt::format("\n  channel: {}", quoted(mapping.channel));
    if (mapping.scripted || mapping.log)
        text += fmt::format("\n  log: {}", mapping.scripted ? "none" : quoted(mapping.log->string()));
    if (mapping.start_ns && mapping.log)
        text += fmt::format("\n  start: {}", stamp_text(*mapping.start_ns));
    text += mapping.inputs.empty() ? "" : "\n  inputs:";
    for (const BusInput& input : mapping.inputs) {
        text += fmt::format("\n    {}: {{signal: {}{}", quoted(input.name), quoted(input.source.text()), scale_text(input));
        if (input.also)
            text += fmt::format(", also: {}, tolerance: {}, contradictory: {}", quoted(input.also->text()), input.tolerance,
                                name_of(input.policy(BusState::contradictory)));
        if (input.stale_after_s)
            text += fmt::format(", stale_after_s: {}", *input.stale_after_s);
        for (const BusState state : {BusState::stale, BusState::missing, BusState::out_of_range})
            text += fmt::format(", {}: {}", name_of(state), name_of(input.policy(state)));
        if (input.fallback)
            text += fmt::format(", default: {}", *input.fallback);
        text += "}";
    }
    text += mapping.outputs.empty() ? "" : "\n  outputs:";
    for (const BusOutput& output : mapping.outputs)
        text += fmt::format("\n    {}: {{signal: {}{}{}}}", quoted(output.target.text()), quoted(output.name), scale_text(output),
                            output.cycle_s ? fmt::format(", cycle_s: {}", *output.cycle_s) : "");
    return text;
}

} // namespace fernlicht
