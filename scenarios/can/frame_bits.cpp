#include "scenarios/can/frame_bits.h"

#include <array>
#include <cstddef>

namespace fernlicht {
namespace {

/// The bits of a frame that may be followed by stuff bits, in their order.
struct StuffedBits {
    std::array<std::uint8_t, 41 + 64 * 8> bits{};
    std::size_t count = 0;
    std::size_t data_rate_from = 0; ///< the first at the data rate of CAN FD

    void add(std::uint32_t value, int width) {
        while (width-- > 0)
            bits[count++] = value >> width & 1U;
    }
};

std::uint32_t length_code(const CanFrame& frame) {
    if (!frame.fd)
        return frame.length == 8 && frame.raw_dlc > 8 ? frame.raw_dlc : frame.length;
    constexpr std::array<std::uint8_t, 7> lengths = {12, 16, 20, 24, 32, 48, 64};
    std::uint32_t code = frame.length;
    for (std::uint32_t i = 0; i < lengths.size(); ++i)
        if (frame.length == lengths[i])
            code = 9 + i;
    return code;
}

StuffedBits bits_up_to_data(const CanFrame& frame) {
    StuffedBits out;
    out.add(0, 1); // start of frame
    if (frame.extended) {
        out.add(frame.id >> 18, 11);
        out.add(3, 2); // SRR, IDE
        out.add(frame.id & 0x3ffff, 18);
    } else {
        out.add(frame.id, 11);
    }
    out.add(frame.remote ? 1 : 0, 1); // RTR, or RRS of CAN FD
    if (!frame.extended)
        out.add(0, 1); // IDE
    if (frame.fd) {
        out.add(2, 2); // FDF, res
        out.add(frame.bit_rate_switch ? 1 : 0, 1);
        out.data_rate_from = out.count;
        out.add(frame.error_state_indicator ? 1 : 0, 1);
    } else {
        out.add(0, frame.extended ? 2 : 1); // r1, r0
    }
    out.add(length_code(frame), 4);
    for (const std::uint8_t byte : frame.bytes())
        out.add(byte, 8);
    return out;
}

/// Stuff bits behind bits [0, count) that stand before bit `end`: a complement after five equal ones, itself the first of the next run.
/// `last` says whether one is stuffed behind the very last bit, too.
std::uint32_t stuff_bits(const StuffedBits& bits, std::size_t from, bool last) {
    std::uint32_t stuffed = 0;
    std::uint8_t value = 2;
    int run = 0;
    for (std::size_t i = 0; i < bits.count; ++i) {
        run = bits.bits[i] == value ? run + 1 : 1;
        value = bits.bits[i];
        if (run < 5)
            continue;
        if (i >= from && (last || i + 1 < bits.count))
            ++stuffed;
        value = value == 0 ? 1 : 0;
        run = 1;
    }
    return stuffed;
}

} // namespace

std::uint16_t can_crc15(std::span<const std::uint8_t> bits) {
    std::uint32_t crc = 0;
    for (const std::uint8_t bit : bits) {
        const bool feed = (bit != 0) != ((crc & 0x4000U) != 0);
        crc = crc << 1 & 0x7fffU;
        if (feed)
            crc ^= 0x4599U;
    }
    return static_cast<std::uint16_t>(crc);
}

FrameBits frame_bits(const CanFrame& frame, BitStuffing stuffing) {
    if (frame.error)
        return {};
    const std::uint32_t data_bits = 8U * static_cast<std::uint32_t>(frame.bytes().size());
    const std::uint32_t header = frame.fd ? (frame.extended ? 41U : 22U) : (frame.extended ? 39U : 19U);
    constexpr std::uint32_t trail = 1 + 1 + 7 + 3; // acknowledge and its delimiter, end of frame, space between frames
    if (!frame.fd) {
        const std::uint32_t stuffable = header + data_bits + 15;
        FrameBits bits{stuffable + 1 + trail, 0}; // CRC delimiter
        if (stuffing == BitStuffing::worst) {
            bits.nominal += (stuffable - 1) / 4;
        } else if (stuffing == BitStuffing::exact) {
            StuffedBits stuffed = bits_up_to_data(frame);
            const std::uint16_t crc = can_crc15({stuffed.bits.data(), stuffed.count});
            stuffed.add(crc, 15);
            // A run that ends with the CRC is followed by a stuff bit, too: it belongs to the stuffed part (ISO 11898-1).
            bits.nominal += stuff_bits(stuffed, 0, true);
        }
        return bits;
    }
    // Stuff count (4) and CRC (17, or 21 from 20 bytes on) with a fixed stuff bit in front and behind every four.
    const std::uint32_t check = frame.length > 16 ? 4 + 21 + 7 : 4 + 17 + 6;
    const std::uint32_t switched = frame.bit_rate_switch ? 1 + 4 + data_bits + check + 1 : 0; // ESI, DLC, ..., CRC delimiter
    FrameBits bits{header + data_bits + check + 1 + trail - switched, switched};
    if (stuffing == BitStuffing::none)
        return bits;
    if (stuffing == BitStuffing::worst) {
        const std::uint32_t all = (header + data_bits - 2) / 4; // none behind the last
        const std::uint32_t before = frame.bit_rate_switch ? (header - 5 - 1) / 4 : all;
        bits.nominal += before;
        bits.data += all - before;
        return bits;
    }
    const StuffedBits stuffed = bits_up_to_data(frame);
    // The CRC field begins with a fixed stuff bit, which serves a run that ends with the data.
    const std::uint32_t all = stuff_bits(stuffed, 0, false);
    const std::uint32_t fast = frame.bit_rate_switch ? stuff_bits(stuffed, stuffed.data_rate_from, false) : 0;
    bits.nominal += all - fast;
    bits.data += fast;
    return bits;
}

} // namespace fernlicht
