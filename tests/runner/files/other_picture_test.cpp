#include "runner/files/other_picture.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/picture_decoding.h"

#include <cstring>
#include <fstream>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

const std::filesystem::path tests = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "tests";

std::string bytes_of(const std::filesystem::path& file) {
    FilesRead opened;
    return read_file(file, opened);
}

bool same_bits(const Image<float>& a, const Image<float>& b) {
    return a.width() == b.width() && a.height() == b.height() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// PNG, JPEG and EXR are read without OpenImageIO, and to the same values: few bits, CMYK, half, whole numbers,
/// tiles of a pyramid, several parts, windows beside the origin, channels in its order.
TEST(OtherPicture, OpenImageIoReadsTheSame) {
    const std::filesystem::path seeds = tests / "fuzz/seeds/picture";
    for (const char* name : {"bits.png", "grey.png", "icc.png", "rgb.png"})
        EXPECT_EQ(read_png(seeds / name), read_other_picture(seeds / name).display) << name;
    for (const char* name : {"cmyk.jpg", "grey.jpg", "rgb.jpg"}) {
        const DecodedPicture ours = decode_picture(seeds / name, "", bytes_of(seeds / name), 1000);
        const Image<Rgb8> theirs = read_other_picture(seeds / name).display;
        ASSERT_EQ(ours.rgba.size(), 4 * theirs.size()) << name;
        for (std::size_t i = 0; i < theirs.size(); ++i)
            EXPECT_EQ((Rgb8{ours.rgba[4 * i], ours.rgba[4 * i + 1], ours.rgba[4 * i + 2]}), theirs.pixels()[i]) << name << ' ' << i;
    }
    for (const char* name : {"half.exr", "lux.exr", "parts.exr", "rgb.exr", "tiles.exr", "uint.exr"}) {
        const std::vector<PictureChannel> ours = read_exr(seeds / name), theirs = read_other_picture(seeds / name).linear;
        ASSERT_EQ(ours.size(), theirs.size()) << name;
        for (std::size_t c = 0; c < ours.size(); ++c) {
            EXPECT_EQ(ours[c].name, theirs[c].name) << name;
            EXPECT_TRUE(same_bits(ours[c].values, theirs[c].values)) << name << ' ' << ours[c].name;
        }
    }
    const TextureImage sixteen = decode_texture("grey-16.png", bytes_of(seeds / "grey-16.png"), 1000);
    EXPECT_EQ(sixteen.pixel_type, "uint16");
    EXPECT_TRUE(same_bits(sixteen.value, read_other_picture(seeds / "grey-16.png").linear.at(0).values));
}

TEST(OtherPicture, OthersAreReadByTheirExtension) {
    EXPECT_TRUE(is_other_picture("a/B.TIF"));
    EXPECT_FALSE(is_other_picture("lamp.ies"));
    const Image<Rgb8> display = read_other_picture(tests / "runner/files/pictures/rgb.tif").display; // the i-th level is i % 17 sixteenths
    ASSERT_EQ(display.size(), 48U);
    EXPECT_EQ(display.at(0, 0), (Rgb8{0, 16, 32}));
    EXPECT_EQ(display.at(7, 5), (Rgb8{80, 96, 112}));
    const std::vector<PictureChannel> light = read_other_picture(tests / "runner/files/pictures/sky.hdr").linear;
    ASSERT_EQ(light.size(), 3U);
    EXPECT_EQ(light[1].name, "G");
    EXPECT_NEAR(light[1].values.at(7, 5), 6.0F / 16.0F, 0.004F);
}

TEST(OtherPicture, WhatIsNoneIsRefusedInOneSentence) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "no-picture.tif";
    std::ofstream(file) << "II*";
    EXPECT_THAT([&] { read_other_picture(file); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("no-picture.tif: cannot be read: ")));
    std::filesystem::remove(file);
}

} // namespace
} // namespace fernlicht
