// Bytes to values and back, against vectors worked out by hand; the derivation stands beside each.
#include "scenarios/can/signal_codec.h"
#include "tests/scenarios/can/dbc_trial.h"
#include "tests/trial.h"

#include <cmath>
#include <limits>
#include <random>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

class Codec : public DbcTrial {
  protected:
    /// Value of the one signal in these bytes.
    double value(const std::string& signal, const Bytes& bytes, const std::string& rest = {}) const {
        const CanMessage read = message(signal, rest, static_cast<int>(bytes.size()));
        const auto values = decode(read, bytes);
        EXPECT_EQ(values.size(), 1U);
        return values.at(0).physical;
    }
};

std::string encode_refusal(const CanMessage& message, const std::map<std::string, double>& values) {
    return tests::refusal_of([&] { encode(message, values); }, "");
}

TEST_F(Codec, BytesOrderedByIntelAndByMotorola) {
    // Bits 4 to 15: upper half of byte 0 (0xC) is the lower part, byte 1 (0xAB) the upper: 0xABC = 2748.
    EXPECT_EQ(value(" SG_ A : 4|12@1+ (1,0) [0|0] \"\" X", {0xC5, 0xAB, 0xFF}), 2748.0);
    // 16 bits of bytes 1 and 2, least significant first: 0x1234 = 4660.
    EXPECT_EQ(value(" SG_ A : 8|16@1+ (1,0) [0|0] \"\" X", {0xFF, 0x34, 0x12}), 4660.0);
    // Starts at bit 7 of byte 0, 16 bits: 0x1234.
    EXPECT_EQ(value(" SG_ A : 7|16@0+ (1,0) [0|0] \"\" X", {0x12, 0x34}), 4660.0);
    // Starts at bit 3 of byte 0 (lower half, 0x5), then byte 1 (0xAB): 12 bits 0x5AB = 1451.
    EXPECT_EQ(value(" SG_ A : 3|12@0+ (1,0) [0|0] \"\" X", {0xC5, 0xAB}), 1451.0);
    // Bit 12 = bit 4 of byte 1, 3 bits: bits 4, 3, 2 of 0b00010100 = 0b101 = 5.
    EXPECT_EQ(value(" SG_ A : 12|3@0+ (1,0) [0|0] \"\" X", {0xFF, 0x14}), 5.0);
    // Over a byte's border: bit 9 (bit 1 of byte 1), 4 bits: bits 1, 0 of byte 1 = 0b10, bits 7, 6 of byte 2 = 0b01: 0b1001 = 9.
    EXPECT_EQ(value(" SG_ A : 9|4@0+ (1,0) [0|0] \"\" X", {0x00, 0xFE, 0x7F}), 9.0);
    // 12 bits 0xFFF signed = -1; * 0.5 + 10 = 9.5. 0x800 = -2048: -1014. 0x7FF = 2047: 1033.5.
    EXPECT_EQ(value(" SG_ A : 0|12@1- (0.5,10) [0|0] \"\" X", {0xFF, 0xFF}), 9.5);
    EXPECT_EQ(value(" SG_ A : 0|12@1- (0.5,10) [0|0] \"\" X", {0x00, 0xF8}), -1014.0);
    EXPECT_EQ(value(" SG_ A : 0|12@1- (0.5,10) [0|0] \"\" X", {0xFF, 0x07}), 1033.5);
    // A single bit with sign is 0 or -1.
    EXPECT_EQ(value(" SG_ A : 0|1@1- (1,0) [0|0] \"\" X", {0x01}), -1.0);
    // Negative factor: 3 * -0.25 + 1 = 0.25.
    EXPECT_EQ(value(" SG_ A : 0|8@1+ (-0.25,1) [0|0] \"\" X", {3}), 0.25);
}

TEST_F(Codec, SixtyFourBitsAreExact) {
    const std::string intel = " SG_ A : 0|64@1+ (1,0) [0|0] \"\" X", motorola = " SG_ A : 7|64@0- (1,0) [0|0] \"\" X";
    const Bytes all(8, 0xFF), low{0x01, 0, 0, 0, 0, 0, 0, 0x80};
    EXPECT_EQ(decode(message(intel), all).at(0).raw, 0xFFFFFFFFFFFFFFFFU);
    EXPECT_EQ(exact_text(decode(message(intel), all).at(0)), "18446744073709551615");
    EXPECT_EQ(exact_text(decode(message(motorola), all).at(0)), "-1");
    EXPECT_EQ(decode(message(intel), low).at(0).raw, 0x8000000000000001U);
    EXPECT_EQ(decode(message(motorola), low).at(0).raw, 0x0100000000000080U);
    // 2^63 + 1 is no double: the nearest is 2^63.
    EXPECT_EQ(decode(message(intel), low).at(0).physical, 0x1p63);
    EXPECT_EQ(exact_text(decode(message(intel), low).at(0)), "9223372036854775809");
    // With factor 3 and offset -1: (2^63 + 1) * 3 - 1 = 27670116110564327426.
    const CanMessage scaled = message(" SG_ A : 0|64@1+ (3,-1) [0|0] \"\" X");
    EXPECT_EQ(exact_text(decode(scaled, low).at(0)), "27670116110564327426");
    // Not at a byte's border: 64 bits from bit 3, and Motorola from bit 4, of 9 bytes.
    const CanMessage nine = message(" SG_ A : 3|64@1+ (1,0) [0|0] \"\" X\n SG_ B : 4|64@0+ (1,0) [0|0] \"\" X", "", 9);
    Bytes bytes(9, 0);
    bytes[0] = 0x08; // A's lowest bit
    bytes[8] = 0x04; // A's highest: bit 3 + 63 = 66 = bit 2 of byte 8
    EXPECT_EQ(decode(nine, bytes).at(0).raw, 0x8000000000000001U);
    bytes.assign(9, 0);
    bytes[0] = 0x10; // B's highest bit
    bytes[8] = 0x20; // 5 bits in byte 0, 56 in bytes 1 to 7, 3 in byte 8: the lowest is bit 5
    EXPECT_EQ(decode(nine, bytes).at(1).raw, 0x8000000000000001U);
}

TEST_F(Codec, Floats) {
    // 1.5 as a float is 0x3FC00000, -2.5 as a double 0xC004000000000000 (IEEE 754).
    const std::string single = "SIG_VALTYPE_ 16 A : 1;", twice = "SIG_VALTYPE_ 16 A : 2;";
    EXPECT_EQ(value(" SG_ A : 0|32@1- (1,0) [0|0] \"\" X", {0x00, 0x00, 0xC0, 0x3F}, single), 1.5);
    EXPECT_EQ(value(" SG_ A : 7|32@0- (2,1) [0|0] \"\" X", {0x3F, 0xC0, 0x00, 0x00}, single), 4.0);
    EXPECT_EQ(value(" SG_ A : 7|64@0- (1,0) [0|0] \"\" X", {0xC0, 0x04, 0, 0, 0, 0, 0, 0}, twice), -2.5);
    EXPECT_TRUE(std::isnan(value(" SG_ A : 7|32@0- (1,0) [0|0] \"\" X", {0x7F, 0xC0, 0, 0}, single)));
    EXPECT_EQ(value(" SG_ A : 7|32@0- (1,0) [0|0] \"\" X", {0xFF, 0x80, 0, 0}, single), -std::numeric_limits<double>::infinity());
    const CanMessage read = message(" SG_ A : 7|32@0- (1,0) [0|0] \"\" X", single);
    const double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(decode(read, encode(read, {{"A", none}})).at(0).physical));
    EXPECT_EQ(encode(read, {{"A", endless}}), (Bytes{0x7F, 0x80, 0, 0, 0, 0, 0, 0}));
    EXPECT_TRUE(decode(read, encode(read, {{"A", none}})).at(0).out_of_limits());
    EXPECT_THAT(encode_refusal(read, {{"A", 1e39}}), HasSubstr("A: found 1e+39, expected a value that a float of 32 bits can hold"));
    // The float nearest to 0.1 is 13421773 / 2^27.
    EXPECT_EQ(exact_text(decode(read, encode(read, {{"A", 0.1}})).at(0)), "0.10000000149011612");
    EXPECT_EQ(decode(read, encode(read, {{"A", 0.1}})).at(0).physical, static_cast<double>(0.1F));
}

TEST_F(Codec, ShortFramesHoldWhatTheyHoldAndLabelsAreOfRawValues) {
    const CanMessage read = message(" SG_ A : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ B : 15|12@0+ (1,0) [0|0] \"\" X");
    EXPECT_EQ(decode(read, Bytes{1}).size(), 1U);
    EXPECT_EQ(decode(read, Bytes{1, 2}).size(), 1U) << "B ends in byte 2";
    EXPECT_EQ(decode(read, Bytes{1, 2, 3}).size(), 2U);
    EXPECT_EQ(decode(read, Bytes{}).size(), 0U);
    EXPECT_FALSE(decode(read, read.signals[1], Bytes{1, 2}));
    const CanMessage other_read = message(" SG_ A : 0|8@1- (0.5,0) [0|0] \"\" X\n SG_ B : 8|8@1+ (1,0) [0|0] \"\" X",
                                          "VAL_ 16 A -1 \"lost\" 2 \"one\" ;\nVAL_ 16 B 255 \"none\" ;");
    const auto values = decode(other_read, Bytes{0xFF, 0xFF, 0, 0, 0, 0, 0, 0});
    ASSERT_NE(values.at(0).label, nullptr);
    EXPECT_EQ(*values[0].label, "lost");
    EXPECT_EQ(*values[1].label, "none");
    EXPECT_EQ(*decode(other_read, Bytes{2, 0}).at(0).label, "one");
    EXPECT_EQ(decode(other_read, Bytes{3, 0}).at(0).label, nullptr);
}

TEST_F(Codec, ValuesRoundToTheNearestAndMustFit) {
    const CanMessage read = message(" SG_ A : 0|8@1+ (0.1,0) [0|0] \"\" X\n SG_ B : 8|8@1- (1,0) [0|0] \"\" X");
    EXPECT_EQ(encode(read, {{"A", 0.3}})[0], 3);
    EXPECT_EQ(encode(read, {{"A", 0.34}})[0], 3);
    EXPECT_EQ(encode(read, {{"A", 0.36}})[0], 4);
    EXPECT_EQ(encode(read, {{"A", 25.54}})[0], 255);
    EXPECT_EQ(encode_refusal(read, {{"A", 25.6}}), "A: found 25.6, expected 0 to 25.5, which is what its 8 bits hold");
    EXPECT_EQ(encode(read, {{"B", -128.4}})[1], 0x80);
    EXPECT_EQ(encode_refusal(read, {{"B", -129}}), "B: found -129, expected -128 to 127, which is what its 8 bits hold");
    EXPECT_THAT(encode_refusal(read, {{"B", std::nan("")}}), HasSubstr("B: found nan, expected a number"));
    EXPECT_THAT(encode_refusal(read, {{"B", 1e300}}), HasSubstr("-128 to 127"));
    EXPECT_EQ(encode_refusal(read, {{"b", 1}}), "Lamp: found no signal 'b' in this message, expected one of its 2");
}

TEST_F(Codec, GreatValuesOfSignalsWithFractions) {
    // 2^60 / 0.1 is 11529215046068469760, one of 64 bits without sign; the double quotient is exact to 53 bits.
    const CanMessage read = message(" SG_ A : 0|64@1+ (0.1,0) [0|0] \"\" X");
    EXPECT_EQ(raw_of(read.signals[0], 0x1p60), 11529215046068469760U);
    EXPECT_EQ(encode_refusal(read, {{"A", 0x1p61}}),
              "A: found 2.305843009213694e+18, expected 0 to 1.8446744073709553e+18, which is what its 64 bits hold");
    const CanMessage whole = message(" SG_ A : 0|64@1- (2,0) [0|0] \"\" X");
    EXPECT_EQ(raw_of(whole.signals[0], 0x1p63), std::uint64_t{1} << 62);
    EXPECT_EQ(raw_of(whole.signals[0], -0x1p64), std::uint64_t{1} << 63);
    EXPECT_THAT(encode_refusal(whole, {{"A", 0x1p64}}), HasSubstr("expected -18446744073709551616 to 18446744073709551614"));
}

TEST_F(Codec, SimpleMultiplexing) {
    const CanMessage read = message(" SG_ Mux M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ A m0 : 8|8@1+ (1,0) [0|0] \"\" X\n"
                                    " SG_ B m3 : 8|16@1+ (1,0) [0|0] \"\" X\n SG_ C : 4|4@1+ (1,0) [0|0] \"\" X");
    const auto zero = decode(read, Bytes{0x50, 7, 1}), three = decode(read, Bytes{0x53, 7, 1}), four = decode(read, Bytes{0x54, 7, 1});
    ASSERT_EQ(zero.size(), 3U);
    EXPECT_EQ(zero[1].signal->name, "A");
    EXPECT_EQ(three.at(1).signal->name, "B");
    EXPECT_EQ(three[1].physical, 263.0);
    EXPECT_EQ(four.size(), 2U) << "only Mux and C";
    EXPECT_EQ(encode(read, {{"B", 263}, {"C", 5}}), (Bytes{0x53, 7, 1, 0, 0, 0, 0, 0})) << "the multiplexor follows what was named";
    EXPECT_EQ(encode_refusal(read, {{"B", 1}, {"Mux", 0}}),
              "Lamp.B: found a value, although Mux = 0 leaves the signal out, expected Mux = 3");
    EXPECT_THAT(encode_refusal(read, {{"A", 1}, {"B", 0}}), HasSubstr("Lamp.Mux: found no value that lets A, B be in one frame"));
}

TEST_F(Codec, CascadesOfMultiplexors) {
    const CanMessage read = message(" SG_ Top M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ Sub m2M : 8|8@1+ (1,0) [0|0] \"\" X\n"
                                    " SG_ Deep m5 : 16|8@1+ (1,0) [0|0] \"\" X\n SG_ Wide m0 : 16|8@1+ (1,0) [0|0] \"\" X",
                                    "SG_MUL_VAL_ 16 Sub Top 2-2;\nSG_MUL_VAL_ 16 Deep Sub 5-7, 200-255;\nSG_MUL_VAL_ 16 Wide Top 3-4;");
    EXPECT_EQ(decode(read, Bytes{2, 6, 9}).size(), 3U);
    EXPECT_EQ(decode(read, Bytes{2, 255, 9}).size(), 3U);
    EXPECT_EQ(decode(read, Bytes{2, 8, 9}).size(), 2U);
    EXPECT_EQ(decode(read, Bytes{1, 6, 9}).size(), 1U) << "Deep is not there where Sub is not";
    EXPECT_EQ(decode(read, Bytes{4, 6, 9}).at(1).signal->name, "Wide");
    EXPECT_EQ(encode(read, {{"Deep", 9}}), (Bytes{2, 5, 9, 0, 0, 0, 0, 0}));
    EXPECT_EQ(encode(read, {{"Deep", 9}, {"Sub", 201}}), (Bytes{2, 201, 9, 0, 0, 0, 0, 0}));
    EXPECT_THAT(encode_refusal(read, {{"Deep", 9}, {"Top", 3}}), HasSubstr("Sub"));
}

TEST_F(Codec, StartValuesAreSentAndOverlappingSignalsMustAgree) {
    const CanMessage read = message(" SG_ A : 0|8@1+ (0.5,0) [0|0] \"\" X\n SG_ B : 8|8@1- (1,0) [0|0] \"\" X",
                                    "BA_DEF_ SG_ \"GenSigStartValue\" FLOAT 0 255;\nBA_ \"GenSigStartValue\" SG_ 16 A 200;\n"
                                    "BA_ \"GenSigStartValue\" SG_ 16 B -2;");
    EXPECT_EQ(encode(read, {}), (Bytes{200, 0xFE, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(encode(read, {{"A", 1}}), (Bytes{2, 0xFE, 0, 0, 0, 0, 0, 0}));
    const CanMessage other_read = message(" SG_ A : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ B : 4|8@1+ (1,0) [0|0] \"\" X");
    EXPECT_EQ(encode(other_read, {{"A", 0x51}, {"B", 0x25}}), (Bytes{0x51, 0x02, 0, 0, 0, 0, 0, 0}));
    EXPECT_THAT(encode_refusal(other_read, {{"A", 0x51}, {"B", 0x24}}),
                HasSubstr("Lamp.A: found a signal whose bits another one of these values needs"));
}

TEST_F(Codec, RandomRawValuesComeBackFromEveryPlace) {
    // Written bit by bit, read by whole bytes: two ways that must agree, for every length and random places in 64 bytes.
    std::mt19937_64 random(20);
    for (int i = 0; i < 20000; ++i) {
        CanSignal signal{.length = static_cast<std::uint16_t>(1 + random() % 64), .big_endian = random() % 2 == 0};
        const std::size_t first = random() % (513U - signal.length);
        signal.start_bit = static_cast<std::uint16_t>(signal.big_endian ? first / 8 * 8 + 7 - first % 8 : first);
        Bytes bytes(64);
        for (auto& byte : bytes)
            byte = static_cast<std::uint8_t>(random());
        const std::uint64_t raw = random() & all_bits(signal);
        const Bytes before = bytes;
        write_bits(signal, raw, bytes);
        ASSERT_EQ(read_bits(signal, bytes), raw) << signal.start_bit << "|" << signal.length << "@" << !signal.big_endian;
        write_bits(signal, read_bits(signal, before), bytes);
        ASSERT_EQ(bytes, before) << "only the signal's bits changed";
    }
}

} // namespace
} // namespace fernlicht
