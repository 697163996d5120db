#include "scenarios/can/bus_signals.h"

#include "scenarios/can/bus_sources.h"
#include "scenarios/can/signal_codec.h"
#include "scenarios/control/signals.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double cycles_until_stale = 3.0;
constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

std::uint64_t identifier_key(std::uint32_t id, bool extended) { return id | (std::uint64_t{extended ? 1U : 0U} << 32U); }

std::int64_t staleness_ns(const BusInput& input, const CanMessage& message) {
    if (input.stale_after_s)
        return std::llround(1.0e9 * *input.stale_after_s);
    return message.cycle_s && *message.cycle_s > 0.0 ? std::llround(1.0e9 * cycles_until_stale * *message.cycle_s) : never_ns;
}

std::string words_of(BusState state) { return state == BusState::out_of_range ? "out of range" : std::string(name_of(state)); }

/// "97.2222 m/s (350 km/h on the bus)"
std::string said_by(const UnitConversion& conversion, const CanSignal& signal, const BusInput& input, double value) {
    if (std::isnan(value))
        return "a value that means nothing";
    const SignalKind* const kind = known_signal(input.name);
    const std::string_view unit = kind && kind->unit != "1" ? std::string_view(kind->unit) : std::string_view();
    std::string in_ours = fmt::format("{:g}{}{}", value, unit.empty() ? "" : " ", unit);
    if (!input.values.empty() || signal.unit.empty() || signal.unit == unit)
        return in_ours;
    return fmt::format("{} ({:g} {} on the bus)", in_ours, conversion.to_physical(input.opposite ? -value : value), printable(signal.unit));
}

} // namespace

std::string_view name_of(BusState state) {
    static constexpr std::array<std::string_view, bus_states> names{"fresh", "stale", "missing", "out_of_range", "contradictory"};
    return names[static_cast<std::size_t>(state)];
}

std::string_view name_of(BusPolicy policy) {
    static constexpr std::array<std::string_view, 4> names{"hold", "default", "lost", "fail"};
    return names[static_cast<std::size_t>(policy)];
}

std::vector<CanDatabase> read_bus_databases(const BusMapping& mapping, FilesRead& opened) {
    std::vector<CanDatabase> databases;
    for (const std::filesystem::path& path : mapping.databases)
        databases.push_back(read_dbc(path, opened));
    return databases;
}

BusSignals::BusSignals(const BusMapping& mapping, std::vector<CanDatabase> databases)
    : databases_(std::move(databases)), channel_(mapping.channel),
      recording_(mapping.log ? fmt::format(" (recording {})", printable(mapping.log->filename().string())) : ""), inputs_(mapping.inputs),
      values_(inputs_.size()), records_(inputs_.size()) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const BusInput& input = inputs_[i];
        const SignalKind* const kind = known_signal(input.name);
        if (!kind)
            throw InputError(input.where, fmt::format("no signal '{}'", printable(input.name)), "one that 'fernlicht signals' lists");
        const auto reading = [&](const BusSource& from) {
            const FoundSource found = find_source(databases_, from, input.where);
            Reading made;
            made.message = found.message;
            made.signal = found.signal;
            made.values = resolve_values(input.values, *found.signal, input.where);
            if (made.values.empty())
                made.conversion = resolve_units(input.factor, input.offset, *found.signal, kind->unit, input.where);
            return made;
        };
        Source source;
        source.first = reading(input.source);
        source.least = kind->least;
        source.greatest = kind->greatest;
        source.stale_after_ns = staleness_ns(input, *source.first.message);
        if (input.also) {
            source.second = reading(*input.also);
            source.also_stale_after_ns = staleness_ns(input, *source.second->message);
        }
        for (const auto& [state, then] : {std::pair(BusState::missing, "there"), {BusState::stale, "stale"}})
            if (input.policy(state) == BusPolicy::fail && source.stale_after_ns == never_ns)
                throw InputError(input.where,
                                 fmt::format("{}: fail, and nothing says when '{}' would be {}", name_of(state), input.source.text(), then),
                                 "stale_after_s, or a cycle time in the database");
        if (source.stale_after_ns != never_ns)
            records_[i].stale_after_s = in_seconds(source.stale_after_ns);
        const auto read_by = [&](const CanMessage& message, bool second) {
            readers_[identifier_key(message.id, message.extended)].emplace_back(i, second);
        };
        read_by(*source.first.message, false);
        if (source.second)
            read_by(*source.second->message, true);
        sources_.push_back(std::move(source));
    }
}

void BusSignals::take(const CanFrame& frame) {
    last_ns_ = std::max(last_ns_, frame.time_ns);
    const auto readers = frame.error || frame.remote || (!channel_.empty() && frame.channel != channel_)
                             ? readers_.end()
                             : readers_.find(identifier_key(frame.id, frame.extended));
    if (readers == readers_.end())
        return;
    ++frames_used_;
    for (const auto& [input, second] : readers->second) {
        Source& source = sources_[input];
        Reading& reading = second ? *source.second : source.first;
        const auto said = decode(*reading.message, *reading.signal, frame.bytes());
        if (!said)
            continue;
        double value = reading.conversion.to_table(said->physical);
        bool in_range = !said->out_of_limits();
        if (!reading.values.empty()) {
            const auto listed = std::ranges::find(reading.values, said->physical, &std::pair<double, double>::first);
            value = listed == reading.values.end() ? not_known : listed->second;
        }
        if (inputs_[input].opposite)
            value = 0.0 - value;
        in_range = in_range && value >= source.least && value <= source.greatest;
        const bool changed = reading.frames == 0 || reading.raw != said->raw;
        ++reading.frames;
        reading.last_ns = last_ns_;
        if (changed) {
            ++reading.changes;
            reading.changed_ns = last_ns_;
        }
        reading.raw = said->raw;
        reading.value = value;
        reading.in_range = in_range;
        if (!second) {
            records_[input].frames = reading.frames;
            records_[input].changes = reading.changes;
        }
    }
}

BusState BusSignals::state_of(std::size_t input, std::int64_t tick_ns) const {
    const Source& source = sources_[input];
    if (source.first.frames == 0)
        return BusState::missing;
    if (tick_ns - source.first.last_ns > source.stale_after_ns)
        return BusState::stale;
    if (!source.first.in_range)
        return BusState::out_of_range;
    if (source.second && source.second->frames > 0 && source.second->in_range &&
        tick_ns - source.second->last_ns <= source.also_stale_after_ns &&
        !(std::abs(source.first.value - source.second->value) <= inputs_[input].tolerance))
        return BusState::contradictory;
    return BusState::fresh;
}

void BusSignals::apply_policy(std::size_t input, std::int64_t tick_ns, BusValue& value) {
    const BusInput& by = inputs_[input];
    Source& source = sources_[input];
    if (value.state == BusState::fresh) {
        value.value = value.received;
        source.held = value.received;
        value.policy_acted = false;
        return;
    }
    value.policy_acted = true;
    const BusPolicy policy = by.policy(value.state);
    // A signal is missing when its time to come is over; until then it is lost.
    const bool may_come = value.state == BusState::missing && tick_ns <= source.stale_after_ns;
    const double fallback = by.fallback.value_or(not_known);
    value.value = policy == BusPolicy::lost ? not_known : policy == BusPolicy::hold ? source.held.value_or(fallback) : fallback;
    if (policy != BusPolicy::fail || may_come)
        return;
    const std::string now = fmt::format("{:.3f} s", in_seconds(tick_ns));
    std::string found =
        value.state == BusState::missing ? "no frame until " + now : fmt::format("no frame for {:.3f} s at {}", value.age_s, now);
    if (value.state == BusState::out_of_range || value.state == BusState::contradictory) {
        found = said_by(source.first.conversion, *source.first.signal, by, value.received);
        if (value.state == BusState::contradictory)
            found += fmt::format(" beside {} of {}", said_by(source.second->conversion, *source.second->signal, by, value.other),
                                 by.also->text());
        found += " at " + now;
    }
    throw InputError(by.where, fmt::format("{} of {} is {}: {}{}", by.name, by.source.text(), words_of(value.state), found, recording_),
                     "a fresh value, because its policy is to fail");
}

const std::vector<BusValue>& BusSignals::at(std::int64_t tick_ns) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const Source& source = sources_[i];
        BusValue& value = values_[i];
        BusRecordOfInput& record = records_[i];
        value.state = state_of(i, tick_ns);
        if (source.first.frames > 0) {
            value.received = source.first.value;
            value.age_s = in_seconds(tick_ns - source.first.last_ns);
            value.changed_s = in_seconds(source.first.changed_ns);
            record.oldest_s = std::max(record.oldest_s, value.age_s);
        }
        if (source.second && source.second->frames > 0)
            value.other = source.second->value;
        const auto state = static_cast<std::size_t>(value.state);
        ++record.ticks[state];
        if (record.states.empty() || record.states.back().second != value.state)
            record.states.emplace_back(in_seconds(tick_ns), value.state);
        if (source.second && value.state == BusState::fresh)
            record.unchecked +=
                source.second->frames == 0 || !source.second->in_range || tick_ns - source.second->last_ns > source.also_stale_after_ns
                    ? 1U
                    : 0U;
        apply_policy(i, tick_ns, value);
        record.acted[state] += value.policy_acted ? 1U : 0U;
    }
    return values_;
}

std::vector<std::pair<std::uint32_t, bool>> BusSignals::identifiers() const {
    std::vector<std::pair<std::uint32_t, bool>> all;
    for (const auto& [key, readers] : readers_)
        all.emplace_back(static_cast<std::uint32_t>(key), key >> 32U != 0);
    std::ranges::sort(all);
    return all;
}

} // namespace fernlicht
