#include "scenarios/can/can_filter.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <charconv>

namespace fernlicht {
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
