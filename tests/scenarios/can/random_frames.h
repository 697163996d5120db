// Frames of every kind, the same for the same seed.
#pragma once

#include "scenarios/can/can_frame.h"

#include <array>
#include <random>

namespace fernlicht {

inline CanFrame random_frame(std::mt19937_64& random) {
    const auto below = [&](std::uint64_t bound) { return random() % bound; };
    static constexpr std::array<std::uint8_t, 16> fd_lengths = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    CanFrame frame{.time_ns = static_cast<std::int64_t>(below(2'000'000'000'000'000)) * 1000,
                   .channel = std::array<const char*, 4>{"can0", "vcan12", "c", "fifteen_letters"}[below(4)]};
    switch (below(6)) {
    case 0:
        frame.error = true;
        break;
    case 1:
        frame.remote = true;
        break;
    case 2:
    case 3:
        frame.fd = true;
        frame.bit_rate_switch = below(2);
        frame.error_state_indicator = below(2);
        break;
    default:
        break;
    }
    frame.extended = !frame.error && below(2);
    frame.id = static_cast<std::uint32_t>(below(frame.extended || frame.error ? 0x20000000U : 0x800U));
    frame.length = frame.fd ? fd_lengths[below(16)] : static_cast<std::uint8_t>(frame.error && below(2) ? 8 : below(9));
    if (!frame.remote)
        for (std::size_t i = 0; i < frame.length; ++i)
            frame.data[i] = static_cast<std::uint8_t>(below(3) == 0 ? 'a' + below(20) : below(256));
    if (!frame.fd && !frame.error && frame.length == 8 && below(3) == 0)
        frame.raw_dlc = static_cast<std::uint8_t>(9 + below(7));
    return frame;
}

} // namespace fernlicht
