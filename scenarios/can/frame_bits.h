// What a frame takes of the bus: its bits on the wire, from start of frame to the end of the space that follows it.
#pragma once

#include "scenarios/can/can_frame.h"

#include <cstdint>
#include <span>

namespace fernlicht {

/// Bits at the nominal rate and, of CAN FD with bit rate switch, at the data rate: from ESI to the CRC delimiter. (The rate changes within
/// the bits BRS and CRC delimiter; each is counted whole on one side, which is off by less than one nominal bit together.)
struct FrameBits {
    std::uint32_t nominal = 0, data = 0;
    std::uint32_t total() const { return nominal + data; }
    bool operator==(const FrameBits&) const = default;
};

enum class BitStuffing {
    none,  ///< as if no bits were stuffed; the fixed stuff bits of CAN FD's CRC field are there
    exact, ///< as this frame's bits and CRC need them
    worst, ///< as a frame of this kind and length can need at most: one for every four bits behind the first
};

/// Classic: ISO 11898-1 and Davis, Burns, Bril, Lukkien, "Controller Area Network (CAN) schedulability analysis: Refuted, revisited and
/// revised", Real-Time Systems 35 (2007) 239-272: without stuffing 47 + 8 n bits (67 + 8 n with 29-bit identifiers), at worst 55 + 10 n
/// (80 + 10 n), three bits of interframe space included. CAN FD: ISO 11898-1:2015, stuff count in the CRC field included.
/// Error frames: 0; how long they were is not recorded.
FrameBits frame_bits(const CanFrame& frame, BitStuffing stuffing);

/// CRC-15 of classic CAN over bits (0 or 1 each), from start of frame on: polynomial 0x4599, starting at 0.
std::uint16_t can_crc15(std::span<const std::uint8_t> bits);

} // namespace fernlicht
