// Which frames pass: candump's filters, with the meaning that the kernel gives them.
#pragma once

#include "scenarios/can/can_frame.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

struct CanFilter {
    std::uint32_t id = 0, mask = 0;
    bool inverted = false;
    /// (received & mask) == (id & mask), or != where inverted; error frames never pass.
    bool passes(const CanFrame& frame) const;
    bool operator==(const CanFilter&) const = default;
};

/// "123:7FF,400~7F0,#FFFFFFFF,j": any filter passes a frame (j: all must), error frames pass by #mask alone. Without a filter all data
/// frames pass, with nothing but an error mask, too (include a filter 0~0 for none).
struct CanFilters {
    std::vector<CanFilter> filters;
    std::uint32_t error_mask = 0;
    bool joined = false;
    bool passes(const CanFrame& frame) const;
    bool operator==(const CanFilters&) const = default;
};

/// Throws InputError with `key`: what is no filter as candump writes it. An identifier of 8 digits is an extended one.
CanFilters parse_can_filters(std::string_view text, const std::string& key);

/// candump's "can0", "can0,123:7FF,#FFFFFFFF" or "any,...".
struct ChannelFilter {
    std::string channel; ///< "any": all
    CanFilters filters;
    bool bare = true; ///< the name alone: all frames pass, error frames too
    bool passes(const CanFrame& frame) const;
};
ChannelFilter parse_channel_filter(std::string_view text, const std::string& key);

} // namespace fernlicht
