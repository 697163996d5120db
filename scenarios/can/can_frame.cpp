#include "scenarios/can/can_frame.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <sstream>

namespace fernlicht {
namespace {

constexpr std::array<std::string_view, 10> can_error_classes = {
    "tx-timeout", "lost-arbitration", "controller-problem",      "protocol-violation", "transceiver-status", "no-acknowledgement-on-tx",
    "bus-off",    "bus-error",        "restarted-after-bus-off", "error-counter-tx-rx"};
constexpr std::array<std::string_view, 7> can_controller_problems = {
    "rx-overflow", "tx-overflow", "rx-error-warning", "tx-error-warning", "rx-error-passive", "tx-error-passive", "back-to-error-active"};
constexpr std::array<std::string_view, 8> can_protocol_violations = {
    "single-bit-error",       "frame-format-error", "bit-stuffing-error", "tx-dominant-bit-error",
    "tx-recessive-bit-error", "bus-overload",       "active-error",       "error-on-tx"};

/// By the place in the frame, 1 to 31, that data[3] gives.
std::string violation_place(std::uint8_t wanted) {
    std::istringstream places(
        "unspecified id.28-to-id.21 start-of-frame bit-srtr bit-ide id.20-to-id.18 id.17-to-id.13 crc-sequence reserved-bit-0 data-field "
        "data-length-code bit-rtr reserved-bit-1 id.4-to-id.0 id.12-to-id.5 unspecified active-error-flag intermission "
        "tolerate-dominant-bits unspecified unspecified passive-error-flag error-delimiter crc-delimiter acknowledge-slot end-of-frame "
        "acknowledge-delimiter overload-flag unspecified unspecified unspecified");
    std::string place;
    for (std::uint8_t i = 0; i < wanted; ++i)
        if (!(places >> place))
            return {};
    return place;
}

template <class Words> std::string words_of_bits(std::uint8_t bits, const Words& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (bits >> i & 1)
            text += fmt::format("{}{}", text.empty() ? "" : ",", words[i]);
    return text;
}

} // namespace

std::vector<std::string> error_words(const CanFrame& frame) {
    std::vector<std::string> all;
    if (!frame.error || frame.id > 1U << can_error_classes.size())
        return all;
    const auto& data = frame.data;
    const std::string counters = fmt::format("{{{{{}}}{{{}}}}}", data[6], data[7]);
    for (std::size_t i = 0; i < can_error_classes.size(); ++i) {
        if (!(frame.id >> i & 1))
            continue;
        std::string text(can_error_classes[i]);
        if (i == 1)
            text += fmt::format("{{at bit {}}}", data[0]);
        else if (i == 2)
            text += "{" + words_of_bits(data[1], can_controller_problems) + "}";
        else if (i == 3)
            text += fmt::format("{{{{{}}}{{{}}}}}", words_of_bits(data[2], can_protocol_violations), violation_place(data[3]));
        else if (i == 9)
            text += counters;
        all.push_back(std::move(text));
    }
    if (!(frame.id >> 9 & 1) && (data[6] || data[7]))
        all.push_back("error-counter-tx-rx" + counters);
    return all;
}

namespace {

constexpr std::uint32_t extended_id_flag = 0x80000000U, remote_id_flag = 0x40000000U, error_id_flag = 0x20000000U;
constexpr std::uint32_t extended_id_mask = 0x1fffffffU, standard_id_mask = 0x7ffU;

bool hexadecimal(std::string_view text, std::uint32_t& value) {
    if (text.starts_with("0x") || text.starts_with("0X"))
        text.remove_prefix(2);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    return error == std::errc{} && end == text.data() + text.size();
}

std::uint32_t kernel_can_id(const CanFrame& frame) {
    return frame.id | (frame.extended ? extended_id_flag : 0) | (frame.remote ? remote_id_flag : 0) | (frame.error ? error_id_flag : 0);
}

} // namespace

bool CanFilter::passes(const CanFrame& frame) const {
    // As net/can/af_can.c does: a mask of the extended flag with a standard identifier looks at its 11 bits.
    std::uint32_t bits = mask & (extended_id_mask | extended_id_flag | remote_id_flag);
    if ((bits & extended_id_flag) && !(id & extended_id_flag))
        bits &= standard_id_mask | extended_id_flag | remote_id_flag;
    return !frame.error && ((kernel_can_id(frame) & bits) == (id & bits)) != inverted;
}

bool CanFilters::passes(const CanFrame& frame) const {
    if (frame.error)
        return frame.id & error_mask;
    const auto passes_one = [&](const CanFilter& filter) { return filter.passes(frame); };
    if (filters.empty())
        return true;
    return joined ? std::ranges::all_of(filters, passes_one) : std::ranges::any_of(filters, passes_one);
}

CanFilters parse_can_filters(std::string_view text, const std::string& key) {
    CanFilters all;
    for (;;) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const std::string_view one = text.substr(0, comma);
        const std::size_t sign = std::min(one.find_first_of(":~"), one.size());
        CanFilter filter;
        if (one == "j" || one == "J") {
            all.joined = true;
        } else if (one.starts_with('#') && hexadecimal(one.substr(1), all.error_mask)) {
            // done
        } else if (sign < one.size() && hexadecimal(one.substr(0, sign), filter.id) && hexadecimal(one.substr(sign + 1), filter.mask)) {
            filter.inverted = one[sign] == '~';
            filter.mask &= ~error_id_flag;
            if (sign == 8)
                filter.id |= extended_id_flag;
            all.filters.push_back(filter);
        } else {
            throw InputError({{}, 0, 0, key}, "found '" + printable(std::string(one)) + "'",
                             "filters as candump has them: ID:MASK, ID~MASK, #ERROR_MASK in hexadecimal digits, or j");
        }
        if (comma == text.size())
            return all;
        text.remove_prefix(comma + 1);
    }
}

bool ChannelFilter::passes(const CanFrame& frame) const {
    return (channel == "any" || channel == frame.channel) && (bare || filters.passes(frame));
}

ChannelFilter parse_channel_filter(std::string_view text, const std::string& key) {
    const std::size_t comma = std::min(text.find(','), text.size());
    ChannelFilter one;
    one.channel = text.substr(0, comma);
    if (one.channel.empty() || one.channel.size() > 15)
        throw InputError({{}, 0, 0, key}, "found '" + printable(std::string(text)) + "'",
                         "the name of a channel of at most 15 bytes, with filters behind it as candump has them: can0,123:7FF");
    if (comma < text.size()) {
        one.bare = false;
        one.filters = parse_can_filters(text.substr(comma + 1), key);
    }
    return one;
}

} // namespace fernlicht
