#include "scenarios/values/exr_file.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

std::string little_exr() {
    const Image<float> values(4, 3);
    return encode_exr({{"illuminance.lx", &values}}, {{"fernlicht:scale_lx", std::string("10")}}, 4);
}

/// What is said of it, "" where it passes.
std::string refusal(const std::string& bytes) {
    try {
        check_exr_headers(bytes);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

std::string little_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(value >> shift);
    return bytes;
}

/// With other bytes in an attribute's value, from `offset` on.
std::string patched(std::string bytes, const std::string& name_and_type, std::size_t offset, const std::string& value) {
    const std::size_t at = bytes.find(name_and_type) + name_and_type.size() + 4;
    return bytes.replace(at + offset, value.size(), value);
}

/// OpenEXR takes memory for what an attribute claims: 4 GB for a file of 500 bytes.
TEST(ExrFile, AnAttributeLongerThanItsFileIsRefusedBeforeItIsRead) {
    std::string bytes = little_exr();
    EXPECT_EQ(refusal(bytes), "");
    const std::size_t size = bytes.find("string", bytes.find("scale_lx")) + 7;
    bytes.replace(size, 4, "\x02\x01\xff\xff");
    EXPECT_THAT(refusal(bytes), HasSubstr("ends early or is damaged"));
}

/// OpenEXR reads 16 bytes of a window whatever its size is said to be, and takes what follows for attributes.
TEST(ExrFile, AnAttributeOfAnotherSizeThanItsTypeIsRefused) {
    std::string bytes = little_exr();
    const std::string name("dataWindow\0box2i\0", 17);
    bytes.replace(bytes.find(name) + name.size(), 1, "\x11").insert(bytes.find(name) + name.size() + 4 + 16, 1, '\0');
    EXPECT_THAT(refusal(bytes), HasSubstr("ends early or is damaged"));
}

TEST(ExrFile, AHeaderEndsWithAnEmptyName) {
    const std::string bytes = little_exr();
    std::size_t end = bytes.size();
    while (!refusal(bytes.substr(0, end - 1)).starts_with("it is no EXR"))
        --end;
    EXPECT_LT(end, bytes.size()) << "what follows is no part of it";
    EXPECT_EQ(bytes[end - 1], '\0');
    for (std::size_t cut = 0; cut < end; ++cut)
        EXPECT_THAT(refusal(bytes.substr(0, cut)), HasSubstr("ends early")) << cut;
}

TEST(ExrFile, OfSeveralPartsEveryHeaderCounts) {
    const std::string attribute("a\0string\0\1\0\0\0x", 14), broken("a\0string\0\1\0\1\0x", 14), end(1, '\0'), magic("v/1\1\2\x10\0\0", 8);
    EXPECT_THAT(refusal(magic + attribute + end + attribute + end + end), HasSubstr("neither scan lines nor tiles"));
    EXPECT_THAT(refusal(magic + attribute + end + broken + end + end), HasSubstr("damaged"));
    EXPECT_THAT(refusal(std::string("v/1\1\2\0\0\0", 8) + attribute + end + broken), testing::Not(HasSubstr("damaged")))
        << "pixels of the only part";
}

/// Each made OpenEXR take gigabytes: for tables of lines, for lines, for tiles, for pixels.
TEST(ExrFile, HeadersThatClaimMoreThanTheFileHoldsAreRefused) {
    const std::string window("dataWindow\0box2i\0", 17), compression("compression\0compression\0", 24), exr = little_exr();
    const auto of_size = [&](std::uint32_t width, std::uint32_t height) {
        return patched(exr, window, 8, little_endian(width - 1) + little_endian(height - 1));
    };
    const auto compressed = [&](const std::string& bytes, char how) { return patched(bytes, compression, 0, std::string(1, how)); };
    constexpr char none = 0, dwab = 9;
    EXPECT_THAT(refusal(compressed(of_size(4, 1U << 28), dwab)), HasSubstr("it claims 4 x 268435456 pixels of 4 bytes in a file of"));
    EXPECT_THAT(refusal(compressed(of_size(4, 200), none)), HasSubstr("it claims 4 x 200 pixels of 4 bytes in a file of"));
    EXPECT_THAT(refusal(of_size(1U << 28, 3)), HasSubstr("it claims blocks of 268435456 x 16 pixels of 4 bytes"));
    EXPECT_THAT(refusal(of_size(1U << 17, 16)), HasSubstr("it claims 131072 x 16 pixels of 4 bytes in a file of")) << "zip shortens less";
    EXPECT_EQ(refusal(compressed(of_size(1U << 17, 16), dwab)), "") << "dwab may shorten more";
    EXPECT_THAT(refusal(of_size(0, 3)), HasSubstr("it claims 0 x 3 pixels"));
    EXPECT_THAT(refusal(patched(exr, window, 0, little_endian(0x80000000U))), HasSubstr("it claims 2147483652 x 3"));
    // With the bit of tiles, and tiles.
    const auto tiled = [&](std::uint32_t side) {
        std::string bytes = exr;
        bytes[5] = 2;
        return bytes.insert(8, std::string("tiles\0tiledesc\0\x09\0\0\0", 19) + little_endian(side) + little_endian(side) + '\0');
    };
    EXPECT_EQ(refusal(tiled(64)), "");
    EXPECT_THAT(refusal(tiled(16384)), HasSubstr("it claims blocks of 16384 x 16384 pixels of 4 bytes"));
    EXPECT_THAT(refusal(tiled(0)), HasSubstr("it claims blocks of 0 x 0"));
    std::string untiled = exr;
    untiled[5] = 2;
    EXPECT_THAT(refusal(untiled), HasSubstr("it claims blocks of 0 x 0"));
}

TEST(ExrFile, WhatWasWrittenComesBackToTheBit) {
    Image<float> light(5, 4), depth(5, 4);
    for (std::size_t i = 0; i < light.size(); ++i) {
        light.pixels()[i] = 0.1F * static_cast<float>(i);
        depth.pixels()[i] = 1e30F / static_cast<float>(i + 1);
    }
    const std::string bytes =
        encode_exr({{"luminance.cdm2", &light}, {"depth.m", &depth}}, {{"note", std::string("night")}, {"tick", 3}, {"time_s", 0.1}}, 1);
    EXPECT_EQ(bytes, encode_exr({{"luminance.cdm2", &light}, {"depth.m", &depth}},
                                {{"note", std::string("night")}, {"tick", 3}, {"time_s", 0.1}}, 1));
    const ExrPicture read = decode_exr(bytes, [](const ExrHead& head) { return std::pair(std::size_t{0}, head.channels.size()); });
    EXPECT_THAT(read.head.channels, testing::ElementsAre("depth.m", "luminance.cdm2"));
    EXPECT_EQ(read.head.pixel_type, "float");
    EXPECT_THAT(read.head.texts, testing::Contains(testing::Pair("note", "night")));
    EXPECT_THAT(read.channels, testing::ElementsAre(depth, light));
}

} // namespace
} // namespace fernlicht
