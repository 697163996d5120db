#include "scenarios/can/bus_outputs.h"

#include "scenarios/can/bus_sources.h"
#include "scenarios/can/signal_codec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

double physical_of_raw(const CanSignal& signal, double raw) { return raw * signal.factor + signal.offset; }

/// What the multiplexors above a signal must say for it to be there: name and physical value of each.
std::map<std::string, double> switched_on_by(const CanMessage& message, const CanSignal& signal, const InputError::Where& where) {
    std::map<std::string, double> fixed;
    const CanSignal* at = &signal;
    while (!at->multiplexed_by.empty()) {
        const CanSignal* const above = message.signal(at->multiplexed_by);
        if (!above || at->multiplexed_when.empty() || fixed.contains(above->name))
            throw InputError(where, fmt::format("signal '{}', which no value of a multiplexor chooses", printable(at->name)),
                             "a signal that a frame can carry");
        fixed[above->name] = physical_of_raw(*above, static_cast<double>(at->multiplexed_when.front().first));
        at = above;
    }
    return fixed;
}

const SignalKind& kind_of_output(const BusOutput& output, const SignalTable& table, std::size_t& place) {
    try {
        place = table.find(output.name);
    } catch (const std::invalid_argument& error) {
        throw InputError(output.where, fmt::format("no signal '{}'", printable(output.name)), error.what());
    }
    return table.kind(place);
}

/// On a live bus our frames would collide with those of who sends the message.
void refuse_what_is_read(const BusMapping& mapping, const std::vector<CanDatabase>& databases, const BusOutput& output,
                         const CanMessage& sent) {
    const auto is_sent = [&](const BusSource& source) {
        return std::ranges::any_of(databases, [&](const CanDatabase& database) {
            const CanMessage* const read = database.message(source.message);
            return read && read->id == sent.id && read->extended == sent.extended;
        });
    };
    for (const BusInput& input : mapping.inputs)
        if (is_sent(input.source) || (input.also && is_sent(*input.also)))
            throw InputError(output.where,
                             fmt::format("an output of message '{}', which {} is read from", printable(sent.name), input.name),
                             "a message that nobody else sends");
}

} // namespace

BusOutputs::BusOutputs(const BusMapping& mapping, std::vector<CanDatabase> databases, const SignalTable& table)
    : databases_(std::move(databases)), channel_(mapping.channel.empty() ? "can0" : mapping.channel) {
    for (const BusOutput& output : mapping.outputs) {
        Value value;
        const SignalKind& kind = kind_of_output(output, table, value.place);
        const FoundSource found = find_source(databases_, output.target, output.where);
        refuse_what_is_read(mapping, databases_, output, *found.message);
        if (found.signal->multiplexor)
            throw InputError(output.where, fmt::format("multiplexor '{}'", printable(output.target.text())),
                             "a signal below it: the multiplexor follows");
        value.signal = found.signal->name;
        value.name = output.name;
        value.opposite = output.opposite;
        value.values = resolve_values(output.values, *found.signal, output.where);
        // Written for what is sent: physical = factor * value + offset; a conversion goes the other way.
        if (output.factor || output.offset)
            value.conversion = {1.0, -output.offset.value_or(0.0), output.factor.value_or(1.0)};
        else if (value.values.empty())
            value.conversion = resolve_units({}, {}, *found.signal, kind.unit, output.where);
        std::tie(value.least, value.greatest) = physical_range(*found.signal);
        value.now = std::clamp(physical_of_raw(*found.signal, found.signal->start_value.value_or(0.0)), value.least, value.greatest);

        auto sent = std::ranges::find(messages_, found.message, &Sent::message);
        if (sent == messages_.end()) {
            messages_.push_back({found.message, 0, 0, {}});
            sent = messages_.end() - 1;
        }
        const double cycle_s = output.cycle_s.value_or(found.message->cycle_s.value_or(0.0));
        const std::int64_t cycle_ns = std::llround(1.0e9 * cycle_s);
        if (cycle_ns <= 0)
            throw InputError(output.where, fmt::format("message '{}' without a cycle time", printable(found.message->name)),
                             "GenMsgCycleTime in its database, or cycle_s");
        if (sent->cycle_ns != 0 && sent->cycle_ns != cycle_ns && output.cycle_s)
            throw InputError(output.where, fmt::format("another cycle of message '{}' than before", printable(found.message->name)),
                             "one for all its signals");
        if (sent->cycle_ns == 0 || output.cycle_s)
            sent->cycle_ns = cycle_ns;
        const std::map<std::string, double> fixed = switched_on_by(*found.message, *found.signal, output.where);
        auto page = std::ranges::find(sent->pages, fixed, &Page::fixed);
        if (page == sent->pages.end()) {
            sent->pages.push_back({fixed, {}});
            page = sent->pages.end() - 1;
        }
        page->values.push_back(std::move(value));
    }
    // What no multiplexor switches is on every page.
    for (Sent& sent : messages_) {
        const auto always = std::ranges::find_if(sent.pages, [](const Page& page) { return page.fixed.empty(); });
        if (always == sent.pages.end() || sent.pages.size() == 1)
            continue;
        const Page common = *always;
        sent.pages.erase(always);
        for (Page& page : sent.pages)
            page.values.insert(page.values.end(), common.values.begin(), common.values.end());
    }
}

void BusOutputs::set(const SignalTable& table) {
    for (Sent& sent : messages_)
        for (Page& page : sent.pages)
            for (Value& value : page.values) {
                const double now = value.opposite ? 0.0 - table[value.place] : table[value.place];
                value.lost = std::isnan(now);
                if (value.lost)
                    continue;
                double physical = value.conversion.to_physical(now);
                if (!value.values.empty())
                    physical = std::ranges::min_element(value.values, {}, [&](const auto& listed) {
                                   return std::abs(listed.second - now);
                               })->first;
                value.now = std::clamp(physical, value.least, value.greatest);
                value.beyond = value.now != physical;
            }
}

CanFrame BusOutputs::frame(const Sent& sent, Page& page) const {
    std::map<std::string, double> physical = page.fixed;
    for (Value& value : page.values) {
        physical[value.signal] = value.now;
        value.no_number += value.lost ? 1U : 0U;
        value.cut += !value.lost && value.beyond ? 1U : 0U;
    }
    const std::vector<std::uint8_t> bytes = encode(*sent.message, physical);
    CanFrame frame;
    frame.time_ns = sent.next_ns;
    frame.channel = channel_;
    frame.id = sent.message->id;
    frame.extended = sent.message->extended;
    frame.fd = sent.message->fd;
    frame.bit_rate_switch = sent.message->fd && sent.message->bit_rate_switch;
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::ranges::copy(bytes, frame.data.begin());
    return frame;
}

std::vector<CanFrame> BusOutputs::due(std::int64_t until_ns) {
    std::vector<CanFrame> frames;
    while (next_ns() <= until_ns) {
        Sent& first = *std::ranges::min_element(messages_, {}, &Sent::next_ns); // of equal ones the mapping's first
        for (Page& page : first.pages)
            frames.push_back(frame(first, page));
        first.next_ns += first.cycle_ns;
    }
    return frames;
}

std::int64_t BusOutputs::next_ns() const {
    std::int64_t next = std::numeric_limits<std::int64_t>::max();
    for (const Sent& sent : messages_)
        next = std::min(next, sent.next_ns);
    return next;
}

std::vector<std::string> BusOutputs::notes() const {
    std::vector<std::string> notes;
    for (const Sent& sent : messages_)
        for (const Page& page : sent.pages)
            for (const Value& value : page.values) {
                const std::string target = fmt::format("{}.{}", sent.message->name, value.signal);
                if (value.cut > 0)
                    notes.push_back(fmt::format("{} of {} was beyond {:g} to {:g} in {} frames of those sent, and cut to that", target,
                                                value.name, value.least, value.greatest, value.cut));
                if (value.no_number > 0)
                    notes.push_back(fmt::format("{} of {} was lost in {} frames of those sent, which repeat what was sent before", target,
                                                value.name, value.no_number));
            }
    return notes;
}

} // namespace fernlicht
