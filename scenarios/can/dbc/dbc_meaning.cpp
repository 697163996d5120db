#include "scenarios/can/dbc/dbc_meaning.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <unordered_map>

namespace fernlicht {
namespace {

template <class Number> std::optional<Number> all_of(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.begin(), text.end(), value);
    return error == std::errc{} && end == text.end() ? std::optional(value) : std::nullopt;
}

/// Raw value of a label; nullopt for what is no whole number of 64 bits.
std::optional<std::int64_t> label_value(std::string_view text) {
    if (text.starts_with('+'))
        text.remove_prefix(1);
    if (const auto value = all_of<std::int64_t>(text))
        return value;
    if (const auto great = all_of<std::uint64_t>(text))
        return static_cast<std::int64_t>(*great);
    if (const auto number = all_of<double>(text); number && std::trunc(*number) == *number && std::abs(*number) < 0x1p63)
        return static_cast<std::int64_t>(*number); // "1.0", "1e3"
    return std::nullopt;
}

} // namespace

DbcMessage* DbcReading::message(std::uint32_t id) {
    const auto found = by_id.find(id);
    return found == by_id.end() ? nullptr : &statements.messages[found->second];
}

DbcSignal* DbcReading::signal(std::uint32_t id, const std::string& name) {
    DbcMessage* in = message(id);
    if (in == nullptr)
        return nullptr;
    Places& known = places[id];
    if (known.signals != in->signals.size()) {
        known = {in->signals.size(), {}};
        for (std::size_t i = 0; i < in->signals.size(); ++i)
            known.of.emplace(in->signals[i].signal.name, i);
    }
    const auto found = known.of.find(name);
    return found == known.of.end() ? nullptr : &in->signals[found->second];
}

void DbcReading::note(std::size_t line, const std::string& text) { notes.push_back(fmt::format("line {}: {}", line, text)); }

DbcMessage* DbcReading::message_of(const char* keyword, const DbcObject& on) {
    DbcMessage* const found = message(on.id);
    if (found == nullptr && !left_out.contains({on.id, on.name}))
        note(on.line, fmt::format("{} of message {}, which is not there", keyword, on.id));
    return found;
}

DbcSignal* DbcReading::signal_of(const char* keyword, const DbcObject& on) {
    DbcSignal* const found = signal(on.id, on.name);
    if (const DbcMessage* const in = found ? nullptr : message_of(keyword, on); in && !left_out.contains({on.id, on.name}))
        note(on.line, fmt::format("{} of {}, which message {} has not", keyword, printable(on.name), printable(in->message.name)));
    return found;
}

void DbcReading::refuse(std::size_t line, const std::string& found, const std::string& expected) const {
    throw InputError({file, line, 0, {}}, "found " + found, expected);
}

std::string dbc_signal_name(const DbcMessage& message, const DbcSignal& signal) {
    return printable(message.message.name) + "." + printable(signal.signal.name);
}

void apply_dbc_value_types(DbcReading& reading) {
    for (const auto& [on, type] : reading.statements.value_types)
        if (DbcSignal* const read = reading.signal_of("SIG_VALTYPE_", on))
            read->signal.kind = type == 1 ? CanValueKind::float32 : type == 2 ? CanValueKind::float64 : CanValueKind::whole;
}

void apply_dbc_labels(DbcReading& reading) {
    for (const auto& [on, labels] : reading.statements.labels) {
        DbcSignal* const read = reading.signal_of("VAL_", on);
        if (read == nullptr)
            continue;
        read->signal.labels.clear();
        for (const auto& [number, text] : labels) {
            const std::optional<std::int64_t> value = label_value(number);
            if (!value)
                reading.note(on.line, fmt::format("'{}' is not a whole number that {} could have; its text '{}' is left out", number,
                                                  printable(on.name), printable(text)));
            else if (const auto [at, is_new] = read->signal.labels.try_emplace(*value, text); !is_new && at->second != text)
                reading.note(on.line, fmt::format("{} of {} is both '{}' and '{}'; the first is taken", number, printable(on.name),
                                                  printable(at->second), printable(text)));
        }
    }
}

namespace {

void apply_multiplexing_ranges(DbcReading& reading) {
    for (const DbcMultiplexing& said : reading.statements.multiplexing) {
        DbcMessage* message = reading.message(said.on.id);
        DbcSignal* signal = reading.signal(said.on.id, said.on.name);
        DbcSignal* by = reading.signal(said.on.id, said.multiplexor);
        if (signal == nullptr || by == nullptr) {
            reading.note(said.on.line, fmt::format("SG_MUL_VAL_ of message {} names {}, which it has not", said.on.id,
                                                   printable(signal == nullptr ? said.on.name : said.multiplexor)));
            continue;
        }
        if (signal == by)
            reading.refuse(said.on.line, fmt::format("{} as its own multiplexor", dbc_signal_name(*message, *signal)), "another signal");
        if (!signal->signal.multiplexed_by.empty() && signal->signal.multiplexed_by != said.multiplexor)
            reading.refuse(said.on.line,
                           fmt::format("{} as multiplexor of {}", printable(said.multiplexor), dbc_signal_name(*message, *signal)),
                           fmt::format("{} as before", printable(signal->signal.multiplexed_by)));
        if (!by->signal.multiplexor) {
            by->signal.multiplexor = true;
            reading.note(said.on.line, fmt::format("{} is a multiplexor, although its SG_ does not say M", dbc_signal_name(*message, *by)));
        }
        signal->signal.multiplexed_by = said.multiplexor;
        signal->signal.multiplexed_when.insert(signal->signal.multiplexed_when.end(), said.when.begin(), said.when.end());
    }
}

// Those of which only "m3" is said follow the one plain multiplexor (M) of their message.
void apply_simple_multiplexing(DbcReading& reading, DbcMessage& message) {
    std::vector<std::string> plain;
    for (const DbcSignal& one : message.signals)
        if (one.signal.multiplexor && !one.when && one.signal.multiplexed_by.empty())
            plain.push_back(one.signal.name);
    std::set<std::string> gone;
    for (DbcSignal& one : message.signals) {
        if (!one.when || !one.signal.multiplexed_by.empty())
            continue;
        if (plain.size() == 1) {
            one.signal.multiplexed_by = plain.front();
            one.signal.multiplexed_when = {{*one.when, *one.when}};
        } else {
            gone.insert(one.signal.name);
            reading.note(one.line, fmt::format("{} (m{}) is left out: its message has {}", dbc_signal_name(message, one), *one.when,
                                               plain.empty() ? "no multiplexor (M)"
                                                             : "several multiplexors (M) and no SG_MUL_VAL_ says which it follows"));
        }
    }
    if (!gone.empty()) { // and whom these switch
        std::unordered_multimap<std::string_view, std::string_view> switched;
        for (const DbcSignal& one : message.signals)
            switched.emplace(one.signal.multiplexed_by, one.signal.name);
        for (std::vector<std::string_view> by(gone.begin(), gone.end()); !by.empty();) {
            const auto [first, last] = switched.equal_range(by.back());
            by.pop_back();
            for (auto one = first; one != last; ++one)
                if (gone.emplace(one->second).second)
                    by.push_back(one->second);
        }
    }
    for (const std::string& name : gone)
        reading.left_out.emplace(message.id, name);
    std::erase_if(message.signals, [&](const DbcSignal& one) { return gone.contains(one.signal.name); });
}

// Who switches whom must end somewhere. Each way up is gone once: it ends where one before it has been.
void check_multiplexing_ends(DbcReading& reading, const DbcMessage& message) {
    std::unordered_map<const DbcSignal*, const DbcSignal*> seen_from; // by signal: where the way began that came past it
    for (const DbcSignal& one : message.signals)
        for (const DbcSignal* by = &one; by != nullptr && seen_from.try_emplace(by, &one).second;
             by = reading.signal(message.id, by->signal.multiplexed_by))
            if (const DbcSignal* next = reading.signal(message.id, by->signal.multiplexed_by);
                next != nullptr && seen_from.contains(next) && seen_from[next] == &one)
                reading.refuse(one.line,
                               fmt::format("multiplexors that switch each other in a ring, {} among them", dbc_signal_name(message, *next)),
                               "a multiplexor that is always there");
}

} // namespace

void apply_dbc_multiplexing(DbcReading& reading) {
    apply_multiplexing_ranges(reading);
    for (DbcMessage& message : reading.statements.messages) {
        apply_simple_multiplexing(reading, message);
        check_multiplexing_ends(reading, message);
        for (DbcSignal& one : message.signals) {
            if (one.signal.multiplexor && one.signal.kind != CanValueKind::whole)
                reading.refuse(one.line, fmt::format("{} as multiplexor, a floating-point signal", dbc_signal_name(message, one)),
                               "a whole number");
            std::ranges::sort(one.signal.multiplexed_when);
        }
    }
}

} // namespace fernlicht
