#include "scenarios/can/dbc/dbc_meaning.h"
#include "scenarios/can/signal_codec.h"

#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace fernlicht {
namespace {

constexpr std::uint32_t dbc_extended = 0x80000000U;

// Identifier as on the bus; false: none that a bus carries.
bool take_identifier(DbcReading& reading, DbcMessage& read) {
    const std::string name = printable(read.message.name);
    read.message.extended = (read.id & dbc_extended) != 0;
    read.message.id = read.id & ~dbc_extended;
    if (read.id == dbc_unsent_signals || read.message.name == "VECTOR__INDEPENDENT_SIG_MSG")
        reading.note(read.line, fmt::format("{} holds {} signals that no message sends; left out", name, read.signals.size()));
    else if (read.message.id > 0x1FFFFFFF)
        reading.note(read.line, fmt::format("{} has identifier {:#x}, of more than 29 bits; left out", name, read.message.id));
    else {
        if (!read.message.extended && read.message.id > 0x7FF) {
            read.message.extended = true;
            reading.note(read.line, fmt::format("{} has an identifier of more than 11 bits without bit 31; taken as extended", name));
        }
        return true;
    }
    reading.left_out.emplace(read.id, "");
    for (const DbcSignal& signal : read.signals)
        reading.left_out.emplace(read.id, signal.signal.name);
    return false;
}

void check_signal(DbcReading& reading, const DbcMessage& message, DbcSignal& read) {
    CanSignal& signal = read.signal;
    const std::string name = dbc_signal_name(message, read);
    if (signal.length == 0 || signal.length > 64)
        reading.refuse(read.line, fmt::format("{} of {} bits", name, signal.length), "1 to 64");
    if (signal.kind == CanValueKind::float32 && signal.length != 32)
        reading.refuse(read.line, fmt::format("{}, a float of {} bits", name, signal.length), "32");
    if (signal.kind == CanValueKind::float64 && signal.length != 64)
        reading.refuse(read.line, fmt::format("{}, a double of {} bits", name, signal.length), "64");
    if (signal.factor == 0.0 || !std::isfinite(signal.factor) || !std::isfinite(signal.offset))
        reading.refuse(read.line, fmt::format("{} with factor {} and offset {}", name, signal.factor, signal.offset),
                       "a factor other than 0, and numbers");
    if (!std::isfinite(signal.minimum) || !std::isfinite(signal.maximum) || signal.minimum > signal.maximum) {
        reading.note(read.line, fmt::format("{} has limits from {} to {}; taken as none", name, signal.minimum, signal.maximum));
        signal.minimum = signal.maximum = 0.0;
    }
    if (const std::size_t bytes = bytes_to_hold(signal); bytes > message.message.length)
        reading.note(read.line,
                     fmt::format("{} needs {} bytes, its message has {}; only longer frames hold it", name, bytes, message.message.length));
}

/// Which signals of a message can be in one frame: multiplexors, theirs or of those above them, choose between them.
class Multiplexing {
  public:
    explicit Multiplexing(const DbcMessage& message) : message_(message) {
        std::unordered_map<std::string_view, std::size_t> by_name;
        for (std::size_t i = 0; i < message.signals.size(); ++i)
            by_name.emplace(message.signals[i].signal.name, i);
        const std::size_t none = message.signals.size();
        above_.assign(none, none);
        for (std::size_t i = 0; i < none; ++i)
            if (const auto found = by_name.find(message.signals[i].signal.multiplexed_by); found != by_name.end())
                above_[i] = found->second;
        depth_.assign(none, none);
        std::vector<std::size_t> way;
        for (std::size_t i = 0; i < none; ++i) {
            std::size_t at = i;
            for (; at != none && depth_[at] == none; at = above_[at])
                way.push_back(at);
            for (std::size_t depth = at == none ? 0 : depth_[at] + 1; !way.empty(); way.pop_back())
                depth_[way.back()] = depth++;
        }
    }

    /// Both climb to where they meet; the last step of each is what that multiplexor chooses between.
    bool together(std::size_t a, std::size_t b) {
        std::size_t from_a = a, from_b = b;
        const auto climb = [&](std::size_t& at, std::size_t& from) {
            from = at;
            at = above_[at];
            ++steps_;
        };
        while (depth_[a] > depth_[b])
            climb(a, from_a);
        while (depth_[b] > depth_[a])
            climb(b, from_b);
        if (a == b) // one is above the other
            return true;
        while (a != b) {
            climb(a, from_a);
            climb(b, from_b);
        }
        if (a == above_.size())
            return true;
        return meet(message_.signals[from_a].signal.multiplexed_when, message_.signals[from_b].signal.multiplexed_when);
    }
    std::size_t steps() const { return steps_; }

  private:
    /// Whether a value lies in a range of either; both ascend.
    bool meet(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& x,
              const std::vector<std::pair<std::uint64_t, std::uint64_t>>& y) {
        for (auto p = x.begin(), q = y.begin(); p != x.end() && q != y.end(); ++steps_)
            if (p->second < q->first)
                ++p;
            else if (q->second < p->first)
                ++q;
            else
                return true;
        return false;
    }

    const DbcMessage& message_;
    std::vector<std::size_t> above_, depth_; ///< by signal; above_ of a root is their number
    std::size_t steps_ = 0;
};

void check_overlaps(DbcReading& reading, const DbcMessage& message) {
    constexpr std::size_t max_pairs = 1'000'000, max_steps = 100'000'000; // messages of others have some thousands of pairs
    Multiplexing multiplexing(message);
    std::vector<std::vector<std::size_t>> holders;                                // by bit: signals that hold it
    std::vector<std::size_t> met(message.signals.size(), message.signals.size()); // by signal: the last that it was looked at with
    std::size_t pairs = 0, overlaps = 0, line = 0;
    const auto enough = [&] { return pairs >= max_pairs || multiplexing.steps() >= max_steps; };
    std::string first_pair;
    for (std::size_t i = 0; i < message.signals.size() && !enough(); ++i) {
        const CanSignal& signal = message.signals[i].signal;
        const std::size_t first = first_bit(signal);
        for (std::size_t k = 0; k < signal.length; ++k) {
            // One numbering for both byte orders: byte * 8 + place within the byte from its least significant bit.
            const std::size_t bit = signal.big_endian ? ((first + k) / 8) * 8 + 7 - (first + k) % 8 : first + k;
            if (bit >= holders.size())
                holders.resize(bit + 64);
            for (const std::size_t other : holders[bit]) {
                if (met[other] == i)
                    continue;
                met[other] = i;
                if (enough())
                    break;
                ++pairs;
                if (!multiplexing.together(other, i) || overlaps++ > 0)
                    continue;
                line = message.signals[i].line;
                first_pair = fmt::format("{} overlaps {}", dbc_signal_name(message, message.signals[i]),
                                         printable(message.signals[other].signal.name));
            }
            holders[bit].push_back(i);
        }
    }
    if (overlaps == 0 && enough())
        reading.note(message.line, fmt::format("of the signals of {} only {} pairs were looked at for overlap, and none does",
                                               printable(message.message.name), pairs));
    if (overlaps > 0)
        reading.note(line, first_pair + (overlaps > 1 ? fmt::format(", and {}{} more pairs of this message do", enough() ? "at least " : "",
                                                                    overlaps - 1)
                                                      : ""));
}

} // namespace

void check_dbc_names(DbcReading& reading) {
    std::vector<DbcMessage> kept;
    std::map<std::string, std::size_t> lines;
    std::map<std::pair<std::uint32_t, bool>, std::size_t> identifiers;
    for (DbcMessage& read : reading.statements.messages) {
        if (!take_identifier(reading, read))
            continue;
        if (const auto [before, is_new] = identifiers.try_emplace({read.message.id, read.message.extended}, read.line); !is_new)
            reading.refuse(read.line, fmt::format("a second message with identifier {}, {}", read.id, printable(read.message.name)),
                           fmt::format("each once (the first is in line {})", before->second));
        if (const auto [before, is_new] = lines.try_emplace(read.message.name, read.line); !is_new)
            reading.note(read.line, fmt::format("a second message {} (the first is in line {}); by name the first is found",
                                                printable(read.message.name), before->second));
        std::map<std::string, std::size_t> signals;
        for (const DbcSignal& signal : read.signals)
            if (const auto [before, is_new] = signals.try_emplace(signal.signal.name, signal.line); !is_new)
                reading.refuse(signal.line, fmt::format("a second signal {}", dbc_signal_name(read, signal)),
                               fmt::format("each name once in a message (the first is in line {})", before->second));
        reading.by_id[read.id] = kept.size();
        kept.push_back(std::move(read));
    }
    reading.statements.messages = std::move(kept);
}

void check_dbc_layout(DbcReading& reading) {
    for (DbcMessage& message : reading.statements.messages) {
        for (DbcSignal& signal : message.signals)
            check_signal(reading, message, signal);
        check_overlaps(reading, message);
    }
}

} // namespace fernlicht
