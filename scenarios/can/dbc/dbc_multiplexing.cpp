#include "scenarios/can/dbc/dbc_meaning.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <unordered_map>

namespace fernlicht {
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
