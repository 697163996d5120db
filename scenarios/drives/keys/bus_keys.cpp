#include "scenarios/drives/keys/bus_keys.h"

#include "scenarios/can/bus_mapping.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/control/signals.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/schema.h"
#include "scenarios/fields/write_fields.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_databases = 64, max_mapped = 1000, max_listed_values = 1000;
constexpr double largest_factor = 1.0e12, longest_stale_s = 1.0e6, longest_cycle_s = 1000.0, shortest_cycle_s = 1.0e-4;

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

std::optional<BusSource> split(const std::string& text) {
    const std::size_t dot = text.find('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == text.size() || text.find('.', dot + 1) != std::string::npos)
        return std::nullopt;
    return BusSource{text.substr(0, dot), text.substr(dot + 1)};
}

BusSource read_bus_source(const YamlEntry& entry) {
    if (const auto source = split(entry.text()))
        return *source;
    entry.refuse("Message.Signal, as the database names them");
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

/// In the unit of the signal that was named before.
template <class Mapped> double read_signal_value(const YamlEntry& entry, const Mapped& mapped) {
    const SignalKind& kind = *known_signal(mapped.name);
    return entry.number(std::max(kind.least, -largest_factor), std::min(kind.greatest, largest_factor));
}

template <class Mapped> void read_values(const YamlEntry& entry, Mapped& mapped) {
    for (const auto& [text, value] : texts_of(entry, max_listed_values))
        mapped.values.emplace_back(text, read_signal_value(value, mapped));
}

template <class Mapped> std::string values_text(const Mapped& mapped) {
    std::string text;
    for (const auto& [said, value] : mapped.values)
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", quoted(said), value);
    return text.empty() ? "" : "{" + text + "}";
}

template <class Mapped> void read_factor(const YamlEntry& entry, Mapped& mapped) {
    mapped.factor = entry.number(-largest_factor, largest_factor);
    if (*mapped.factor == 0.0)
        entry.refuse("a number that is not 0");
}

/// From what the bus says to the signal's value, or back.
template <class Mapped> const Fields<Mapped>& scale_fields() {
    const FieldRule factors = range(-largest_factor, largest_factor);
    static const Fields<Mapped> fields{
        field("factor", 1, &Mapped::factor, factors, "on the value; by the units of both signals by default")
            .read_by(read_factor<Mapped>)
            .schema_by(R"({"type": "number", "minimum": -1000000000000, "maximum": 1000000000000, "not": {"const": 0}})"),
        field("offset", 2, &Mapped::offset, factors, "added to it"),
        own<Mapped>("values", 3, read_values<Mapped>, values_text<Mapped>, R"({"type": "object", "minProperties": 1,
            "maxProperties": 1000, "additionalProperties": {"type": "number"}})",
                    "instead: what the bus says (a label, or a physical value) and our value"),
        field("opposite", 4, &Mapped::opposite, any(), "the sign is turned round").written_off_default(),
    };
    return fields;
}

template <class Mapped> void read_scale(const Fields<Mapped>& fields, const YamlMap& keys, Mapped& mapped) {
    for (const char* const key : {"signal", "values", "factor", "opposite", "offset"})
        read_field(fields, key, keys, &mapped);
    if (!mapped.values.empty() && (mapped.factor || mapped.offset))
        keys.entry().refuse("values beside factor or offset", "one of them");
}

bool has_second(const void* input) { return static_cast<const BusInput*>(input)->also.has_value(); }

void read_tolerance(const YamlEntry& entry, BusInput& input) {
    if (!input.also)
        entry.refuse("a tolerance without a second signal", "also: Message.Signal beside it");
    input.tolerance = entry.number(0.0, largest_factor);
}

template <BusState state> void read_policy(const YamlEntry& entry, BusInput& input) {
    if (state == BusState::contradictory && !input.also)
        entry.refuse("a policy for contradictory signals without a second one", "also: Message.Signal beside it");
    const auto policy = static_cast<BusPolicy>(entry.choice({"hold", "default", "lost", "fail"}));
    if (policy == BusPolicy::fallback && !input.fallback)
        entry.refuse("'default' without a value", "default: NUMBER beside it");
    input.policies[static_cast<std::size_t>(state)] = policy;
}

template <BusState state> FieldOf<BusInput> policy_field(int id, std::string_view when) {
    return own<BusInput>(
        name_of(state), id, read_policy<state>, [](const BusInput& input) { return std::string(name_of(input.policy(state))); },
        R"({"enum": ["hold", "default", "lost", "fail"]})", when);
}

constexpr std::string_view source_schema = R"({"type": "string", "pattern": "^[^.]+\\.[^.]+$"})";

BusInput default_input() {
    BusInput input;
    input.policies.fill(BusPolicy::lost);
    return input;
}

const Fields<BusInput>& bus_input_fields() {
    using Input = BusInput;
    static const Fields<Input> fields =
        Fields<Input>{
            own<Input>(
                "signal", 1, [](const YamlEntry& entry, Input& input) { input.source = read_bus_source(entry); },
                [](const Input& input) { return quoted(input.source.text()); }, source_schema, "Message.Signal, as the database names them")
                .required(),
            inlined(2, scale_fields<Input>()),
            own<Input>(
                "also", 3, [](const YamlEntry& entry, Input& input) { input.also = read_bus_source(entry); },
                [](const Input& input) { return input.also ? quoted(input.also->text()) : ""; }, source_schema,
                "a second one that must say the same"),
            field("tolerance", 4, &Input::tolerance, range(0.0, largest_factor), "between both, in our unit")
                .read_by(read_tolerance)
                .heard_if(has_second),
            policy_field<BusState::contradictory>(5, "what is taken where they differ by more").heard_if(has_second),
            field("stale_after_s", 6, &Input::stale_after_s, above(0.0, longest_stale_s),
                  "since the last frame; three cycles of its message by default"),
            policy_field<BusState::stale>(7, "what is taken then"),
            policy_field<BusState::missing>(8, "what is taken before there was one"),
            policy_field<BusState::out_of_range>(9, "what is taken for a value that cannot be"),
            field("default", 10, &Input::fallback, range(-largest_factor, largest_factor), "in our unit")
                .read_by([](const YamlEntry& entry, Input& input) { input.fallback = read_signal_value(entry, input); }),
        }
            .at_defaults(default_input());
    return fields;
}

/// "lamp.high-left.segments[1:84]": from which number to which, and the name with the number in place; nullopt: one signal.
struct NumberRange {
    std::size_t first = 0, last = 0;
    std::string before, behind;

    std::string name(std::size_t number) const { return before + std::to_string(number) + behind; }
};
std::optional<NumberRange> number_range(const std::string& text, const YamlEntry& entry) {
    const std::size_t open = text.find('['), colon = text.find(':', std::min(open, text.size())),
                      close = text.find(']', std::min(colon, text.size()));
    if (close == std::string::npos)
        return std::nullopt;
    NumberRange range{0, 0, text.substr(0, open + 1), text.substr(close)};
    const char* const from = text.data();
    const auto [colon_at, wrong] = std::from_chars(from + open + 1, from + colon, range.first);
    const auto [close_at, worse] = std::from_chars(from + colon + 1, from + close, range.last);
    if (wrong != std::errc() || worse != std::errc() || colon_at != from + colon || close_at != from + close || range.first < 1 ||
        range.last <= range.first || range.last - range.first >= max_mapped)
        entry.refuse(fmt::format("'{}'", printable(text)), fmt::format("[FIRST:LAST], whole numbers from 1 on, at most {}", max_mapped));
    return range;
}

/// "Masks.Level#" with the number in place.
void number(BusSource& source, std::size_t number) {
    for (std::string* const part : {&source.message, &source.signal})
        if (const std::size_t sign = part->find('#'); sign != std::string::npos)
            part->replace(sign, 1, std::to_string(number));
}

BusInput read_bus_input(const std::string& name, const YamlEntry& entry) {
    BusInput input = default_input();
    input.name = name;
    input.where = place_of(entry);
    if (const SignalKind& kind = kind_named(name, entry); !may_come_from_bus(kind))
        entry.refuse(fmt::format("{}, which the {} write", name, kind.writer),
                     "a signal that car, road, driver or another controller gives");
    if (listed_name(name).second > 0 && name.find('*') != std::string::npos)
        entry.refuse("a window of all lamps", "the name of a lamp in place of the star");
    if (entry.is_scalar()) {
        input.source = read_bus_source(entry);
        return input;
    }
    const YamlMap keys = entry.map(keys_of(bus_input_fields()));
    read_scale(bus_input_fields(), keys, input);
    for (const char* const key : {"also", "tolerance", "stale_after_s", "default", "stale", "missing", "out_of_range", "contradictory"})
        read_field(bus_input_fields(), key, keys, &input);
    return input;
}

const Fields<BusOutput>& bus_output_fields() {
    using Output = BusOutput;
    static const Fields<Output> fields{
        own<Output>(
            "signal", 1, [](const YamlEntry& entry, Output& output) { output.name = entry.text(), kind_named(output.name, entry); },
            [](const Output& output) { return quoted(output.name); }, R"({"type": "string", "minLength": 1})", "of lamp control")
            .required(),
        inlined(2, scale_fields<Output>()),
        field("cycle_s", 3, &Output::cycle_s, range(shortest_cycle_s, longest_cycle_s), "of its message; as the database says by default"),
    };
    return fields;
}

BusOutput read_bus_output(const std::string& target, const YamlEntry& entry) {
    const auto source = split(target);
    if (!source)
        entry.refuse(fmt::format("'{}'", printable(target)), "Message.Signal, as the database names them");
    BusOutput output;
    output.target = *source;
    output.where = place_of(entry);
    if (entry.is_scalar()) {
        output.name = entry.text();
        kind_named(output.name, entry);
    } else {
        const YamlMap keys = entry.map(keys_of(bus_output_fields()));
        read_scale(bus_output_fields(), keys, output);
        read_field(bus_output_fields(), "cycle_s", keys, &output);
    }
    if (output.name.find('*') != std::string::npos)
        entry.refuse("a star: one signal of the bus for many of ours", "the name of a lamp in its place");
    return output;
}

std::size_t windows_of(const LampSet& lamp_set, std::size_t lamp) {
    if (const MountedLamp& mounted = lamp_set.lamps[lamp]; mounted.file->pixels)
        return mounted.levels ? 0 : mounted.file->pixels->count();
    if (lamp_set.control && lamp_set.control->glare_free)
        for (const SegmentedLamp& segmented : lamp_set.control->glare_free->lamps)
            if (segmented.name == lamp_set.lamps[lamp].name)
                return segmented.windows_deg.size();
    return 0;
}

/// Windows that are named must be there.
template <class Mapped> void check_windows(const std::vector<Mapped>& mapped, const SignalTable& table, const LampSet& lamp_set) {
    for (const Mapped& signal : mapped)
        if (known_signal(signal.name)->name == "lamp.*.segments[#]") {
            const auto& listed =
                *std::ranges::find_if(table.segments(), [&](const SignalTable::Listed& of) { return table.name(of.place) == signal.name; });
            if (const std::size_t count = windows_of(lamp_set, listed.lamp); listed.number > count)
                throw InputError(signal.where,
                                 fmt::format("window {} of '{}', which has {}", listed.number, lamp_set.lamps[listed.lamp].name, count),
                                 "one of its pixels, or of its windows by control.glare_free.windows_deg");
        }
}

void check_lamp_set(const BusMapping& mapping, const LampSet& lamp_set) {
    const BusWriter writer(mapping, lamp_names(lamp_set));
    const SignalTable table(lamp_names(lamp_set), listed_names(mapping));
    for (const BusOutput& output : mapping.outputs)
        try {
            table.find(output.name);
        } catch (const std::invalid_argument& error) {
            throw InputError(output.where, fmt::format("no signal '{}' in lamp set '{}'", printable(output.name), lamp_set.name),
                             error.what());
        }
    check_windows(mapping.inputs, table, lamp_set);
    check_windows(mapping.outputs, table, lamp_set);
    for (const BusInput& input : mapping.inputs)
        if (lamp_set.swivel && input.name.starts_with("lamp.") && input.name.find(".swivel") != std::string::npos)
            throw InputError(input.where, fmt::format("{} beside actuators.swivel of lamp set '{}'", input.name, lamp_set.name),
                             "one of them");
}

std::string databases_text(const BusMapping& mapping) {
    std::string text;
    for (const std::filesystem::path& path : mapping.databases)
        text += fmt::format("\n    - {}", quoted(path.string()));
    return text;
}

std::string log_text(const BusMapping& mapping) { return mapping.scripted ? "none" : mapping.log ? quoted(mapping.log->string()) : ""; }

std::string start_text(const BusMapping& mapping) {
    if (!mapping.start_ns || !mapping.log)
        return "";
    return fmt::format("{}.{:09}", *mapping.start_ns / 1'000'000'000, *mapping.start_ns % 1'000'000'000);
}

template <std::string (*tell)(const Group&, const void*)> std::string outputs_told(const BusMapping& mapping) {
    std::string text;
    for (const BusOutput& output : mapping.outputs)
        text += fmt::format("\n    {}: {{{}}}", quoted(output.target.text()), tell(bus_output_fields(), &output));
    return text;
}

/// By names that may hold more than those of lamps: a scalar, or the keys of a group.
std::string mapped_schema(std::string_view names, std::string_view scalar, const Group& group) {
    return fmt::format(R"({{"type": "object", "minProperties": 1, "maxProperties": {}, "propertyNames": {},
        "additionalProperties": {{"anyOf": [{}, {}]}}}})",
                       max_mapped, names, scalar, schema_of(group));
}

} // namespace

const Fields<BusMapping>& can_fields() {
    static const Fields<BusMapping> fields =
        Fields<BusMapping>{
            own<BusMapping>("databases", 1, nullptr, databases_text, R"({"anyOf": [{"type": "string", "minLength": 1},
                {"type": "array", "minItems": 1, "maxItems": 64, "items": {"type": "string", "minLength": 1}}]})",
                            "DBC files, or one of them")
                .required(),
            field("channel", 2, &BusMapping::channel, a_name(), "CAN frames of other channels are left out").written_off_default(),
            own<BusMapping>("log", 3, nullptr, log_text, R"({"type": "string", "minLength": 1})",
                            "recording (candump) that the drive is played by; none: its own speed and signals"),
            own<BusMapping>(
                "start", 4, nullptr, start_text,
                R"({"anyOf": [{"type": "number", "minimum": 0}, {"type": "string", "pattern": "^[0-9]{1,10}(\\.[0-9]{1,9})?$"}]})",
                "stamp in the log that is the drive's 0 s; that of its first frame by default"),
            named("inputs", 5, &BusMapping::inputs, max_mapped, bus_input_fields(),
                  "signals of lamp control (fernlicht signals) and where they come from; segments[1:84] with # in the bus's names: each")
                .schema_by(mapped_schema(R"({"type": "string"})", source_schema, bus_input_fields())),
            own<BusMapping>("outputs", 6, nullptr, outputs_told<flow_text>, mapped_schema(source_schema, file_schema, bus_output_fields()),
                            "what is sent: Message.Signal and the signal of lamp control")
                .bits_by(outputs_told<field_bits>)
                .of(bus_output_fields()),
        }
            .block()
            .in_schema(R"({"anyOf": [{"required": ["inputs"]}, {"required": ["outputs"]}]})");
    return fields;
}

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
    const YamlMap of = given->map(keys_of(can_fields()));
    BusMapping mapping;
    mapping.where = place_of(*given);
    const YamlEntry databases = of.require("databases");
    for (const YamlEntry& database : databases.is_scalar() ? std::vector{databases} : databases.list(1, max_databases)) {
        mapping.databases.push_back(database.path());
        check_file(mapping.databases.back(), database);
    }
    read_field(can_fields(), "channel", of, &mapping);
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
        for (const auto& [name, entry] : texts_of(*inputs, max_mapped)) {
            const auto range = number_range(name, entry);
            if (!range)
                mapping.inputs.push_back(read_bus_input(name, entry));
            for (std::size_t i = range ? range->first : 1; range && i <= range->last; ++i) {
                BusInput& input = mapping.inputs.emplace_back(read_bus_input(range->name(i), entry));
                if (input.source.text().find('#') == std::string::npos)
                    entry.refuse(fmt::format("one signal for {}", printable(name)), "# for the number in its signal");
                number(input.source, i);
                if (input.also)
                    number(*input.also, i);
            }
        }
    if (mapping.inputs.size() > max_mapped)
        given->refuse(fmt::format("{} inputs", mapping.inputs.size()), fmt::format("at most {}", max_mapped));
    if (const auto outputs = of.find("outputs"))
        for (const auto& [target, entry] : texts_of(*outputs, max_mapped))
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
    const auto known = std::ranges::find_if(drive.lamp_sets, [](const LampSet& lamp_set) { return lamp_set.control != nullptr; });
    ControlParameters no_laws;
    no_laws.period_s = known == drive.lamp_sets.end() ? no_laws.period_s : (*known).control->period_s;
    for (LampSet& lamp_set : drive.lamp_sets) {
        check_lamp_set(mapping, lamp_set);
        if (!lamp_set.control)
            lamp_set.control = std::make_shared<const ControlParameters>(no_laws);
    }
    drive.can = std::make_shared<const BusMapping>(std::move(mapping));
    bus_period_s(drive);
}

} // namespace fernlicht
