// One frame of a CAN bus: classic, CAN FD, remote or error, with when and where it was seen.
// What an error frame says, in candump's words.
// Which frames pass: candump's filters, with the meaning that the kernel gives them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

inline double in_seconds(std::int64_t ns) { return static_cast<double>(ns) / 1.0e9; }

struct CanFrame {
    std::int64_t time_ns = 0; ///< of reception; since the epoch, or since whatever the log's stamps count from
    std::string channel;      ///< name of the interface, "can0"; at most 15 bytes (IFNAMSIZ)
    std::uint32_t id = 0;     ///< 11 bits; 29 if extended; of an error frame its class bits, without CAN_ERR_FLAG
    bool extended = false;    ///< 29-bit identifier
    bool remote = false;      ///< asks for data and has none; classic only
    bool error = false;       ///< made by the driver, not from the bus; classic only, always 8 bytes
    bool fd = false;          ///< CAN FD
    bool bit_rate_switch = false, error_state_indicator = false; ///< FD only
    std::uint8_t length = 0;             ///< bytes of data: 0-8; FD 0-8, 12, 16, 20, 24, 32, 48, 64; remote: asked for
    std::uint8_t raw_dlc = 0;            ///< classic with 8 bytes: 9-15 as it was on the bus; else 0
    std::array<std::uint8_t, 64> data{}; ///< beyond `length` 0

    std::span<const std::uint8_t> bytes() const { return {data.data(), remote ? 0U : std::size_t{length}}; }
    bool operator==(const CanFrame&) const = default;
};

/// A text for each class of the frame (bits 0-9 of its identifier, include/uapi/linux/can/error.h) with what its data add, as `candump -e`
/// prints one to a line: "controller-problem{rx-error-passive}". Nothing for frames that are no error frames, and for classes beyond these.
std::vector<std::string> error_words(const CanFrame& frame);

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
