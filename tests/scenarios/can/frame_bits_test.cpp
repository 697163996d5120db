// Bits on the wire against published formulas, hand counts and a plain second way of stuffing.
#include "scenarios/can/candump_log.h"
#include "scenarios/can/frame_bits.h"
#include "tests/scenarios/can/random_frames.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

CanFrame frame_of(const std::string& text) { return parse_candump_line("(1.000000) can0 " + text, {}).frame; }

std::uint32_t total(const std::string& text, BitStuffing stuffing) { return frame_bits(frame_of(text), stuffing).total(); }

TEST(FrameBits, AreThoseOfDavisAndOthers) { // Real-Time Systems 35 (2007), equations 1 to 3
    std::string data;
    for (std::uint32_t n = 0; n <= 8; ++n, data += "55") {
        EXPECT_EQ(total("123#" + data, BitStuffing::none), 47 + 8 * n);
        EXPECT_EQ(total("123#" + data, BitStuffing::worst), 55 + 10 * n);
        EXPECT_EQ(total("12345678#" + data, BitStuffing::none), 67 + 8 * n);
        EXPECT_EQ(total("12345678#" + data, BitStuffing::worst), 80 + 10 * n);
    }
    EXPECT_EQ(total("123#R8", BitStuffing::none), 47U); // asks for data, has none
    EXPECT_EQ(total("20000004#0000000000000000", BitStuffing::worst), 0U);
}

TEST(FrameBits, OfCanFdAreCountedByHand) {
    // SOF 1, ID 11, RRS 1, IDE 1, FDF 1, res 1, BRS 1, ESI 1, DLC 4; stuff count 4, CRC 17, fixed 6; delimiter 1, ACK 2, EOF 7, IFS 3
    EXPECT_EQ(total("123##0", BitStuffing::none), 22U + 27 + 13);
    std::string data;
    for (int i = 0; i < 64; ++i)
        data += "55";
    EXPECT_EQ(total("123##0" + data, BitStuffing::none), 22U + 512 + 32 + 13); // CRC 21, fixed 7
    EXPECT_EQ(total("12345678##0" + data, BitStuffing::none), 41U + 512 + 32 + 13);
    EXPECT_EQ(total("123##0" + data.substr(0, 32), BitStuffing::none), 22U + 128 + 27 + 13);
    EXPECT_EQ(total("123##0" + data.substr(0, 40), BitStuffing::none), 22U + 160 + 32 + 13);
    // With the rate switched: ESI 1, DLC 4, data, CRC field, delimiter.
    const FrameBits fast = frame_bits(frame_of("123##1" + data), BitStuffing::none);
    EXPECT_EQ(fast.data, 5U + 512 + 32 + 1);
    EXPECT_EQ(fast.nominal, 17U + 12);
    EXPECT_EQ(frame_bits(frame_of("123##0" + data), BitStuffing::none).data, 0U);
}

TEST(FrameBits, HaveThePublishedCrc) { // CRC-15/CAN of "123456789" is 0x059e (catalogue of parametrised CRC algorithms)
    std::vector<std::uint8_t> bits;
    for (const char c : std::string("123456789"))
        for (int bit = 7; bit >= 0; --bit)
            bits.push_back(static_cast<std::uint8_t>(c >> bit & 1));
    EXPECT_EQ(can_crc15(bits), 0x059e);
}

TEST(FrameBits, OfZerosAreStuffedEveryFive) {
    // 19 bits and a CRC of 15, all 0: a stuffed 1 behind each five of 34.
    EXPECT_EQ(total("000#", BitStuffing::exact), 47U + 6);
}

/// As a string, by the rules' own words.
std::string plain_bits(const CanFrame& frame) {
    std::string bits = "0";
    const auto add = [&](std::uint32_t value, int width) {
        for (int i = width - 1; i >= 0; --i)
            bits += value >> i & 1 ? '1' : '0';
    };
    if (frame.extended) {
        add(frame.id >> 18, 11);
        bits += "11";
        add(frame.id, 18);
        bits += frame.remote ? "100" : "000";
    } else {
        add(frame.id, 11);
        bits += frame.remote ? "100" : "000";
    }
    add(frame.raw_dlc > 8 ? frame.raw_dlc : frame.length, 4);
    for (const std::uint8_t byte : frame.bytes())
        add(byte, 8);
    return bits;
}

TEST(FrameBits, AreThoseOfAPlainSender) {
    std::mt19937_64 random(3);
    int most_stuffed = 0;
    for (int i = 0; i < 20'000; ++i) {
        CanFrame frame = random_frame(random);
        if (frame.error)
            continue;
        if (random() % 3 == 0) { // long runs
            frame.data.fill(random() % 2 ? 0xff : 0x00);
            std::fill(frame.data.begin() + frame.length, frame.data.end(), std::uint8_t{0});
        }
        const std::uint32_t none = frame_bits(frame, BitStuffing::none).total(), exact = frame_bits(frame, BitStuffing::exact).total(),
                            worst = frame_bits(frame, BitStuffing::worst).total();
        ASSERT_LE(none, exact);
        ASSERT_LE(exact, worst);
        if (frame.fd)
            continue;
        std::string bits = plain_bits(frame);
        // Long division by x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1.
        std::string rest = bits + std::string(15, '0');
        for (std::size_t at = 0; at + 15 < rest.size(); ++at)
            if (rest[at] == '1')
                for (std::size_t j = 0; j < 16; ++j)
                    rest[at + j] = rest[at + j] == "1100010110011001"[j] ? '0' : '1';
        bits += rest.substr(rest.size() - 15);
        std::string sent;
        for (const char bit : bits) {
            sent += bit;
            if (sent.size() >= 5 && sent.substr(sent.size() - 5).find_first_not_of(bit) == std::string::npos)
                sent += bit == '0' ? '1' : '0';
        }
        ASSERT_EQ(exact, sent.size() + 13);
        most_stuffed = std::max(most_stuffed, static_cast<int>(sent.size() - bits.size()));
    }
    EXPECT_GE(most_stuffed, 12);
}

} // namespace
} // namespace fernlicht
