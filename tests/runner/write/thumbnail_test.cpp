// Pictures as pages embed them.
#include "runner/findings/lux_codes.h"
#include "runner/write/plots/png.h"
#include "runner/write/thumbnail.h"
#include "scenarios/values/jpeg_file.h"
#include "scenarios/values/png_file.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace fernlicht {
namespace {

std::string unpacked(const std::string& base64) {
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : base64) {
        static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        if (c == '=')
            break;
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        if (++count % 4 != 1)
            bytes += static_cast<char>(bits >> (2 * (3 - (count - 1) % 4)));
    }
    return bytes;
}

TEST(Thumbnail, PixelsAreAveragedAsLight) {
    Image<plots::Colour> stripes(1280, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 1280; ++x)
            stripes.at(x, y) = x % 2 == 0 ? plots::Colour{255, 255, 255} : plots::Colour{0, 0, 0};
    const std::string source = embedded_picture(plots::png_of_pixels(stripes)), head = "data:image/jpeg;base64,";
    ASSERT_EQ(source.substr(0, head.size()), head);
    const JpegPicture picture = decode_jpeg(unpacked(source.substr(head.size())), [](const JpegPicture&) {});
    EXPECT_EQ(picture.width, 640);
    EXPECT_EQ(picture.height, 32);
    EXPECT_THAT(picture.bytes, testing::Each(testing::AllOf(testing::Ge(187), testing::Le(189))))
        << "half of the light is code 188, not 128";
}

TEST(Thumbnail, SmallPicturesKeepTheirSizeAndAProfileItsPng) {
    const Image<plots::Colour> red(31, 17, plots::Colour{200, 10, 20});
    const std::string head = "data:image/jpeg;base64,", source = embedded_picture(plots::png_of_pixels(red));
    const JpegPicture picture = decode_jpeg(unpacked(source.substr(head.size())), [](const JpegPicture&) {});
    EXPECT_EQ(picture.width, 31);
    EXPECT_NEAR(picture.bytes[0], 200, 2);
    EXPECT_NEAR(picture.bytes[1], 10, 2);
    const std::vector<std::uint16_t> deep(3 * 4, 1000);
    EXPECT_THAT(embedded_picture(encode_png({2, 2, 16, deep.data()}, 4)), testing::StartsWith("data:image/png;base64,"));
    EXPECT_THROW(embedded_picture("no picture"), std::runtime_error);
}

TEST(LuxCodes, AreWithinTwoPerCent) {
    double worst = 0.0;
    for (double lx = 0.05; lx <= 500.0; lx *= 1.0007)
        worst = std::max(worst, std::abs(lux_of(lux_code(lx)) / lx - 1.0));
    EXPECT_LT(worst, 0.02);
    EXPECT_GT(worst, 0.015) << "else this looks at too few";
    EXPECT_EQ(lux_code(0.0499), 1);
    EXPECT_EQ(lux_code(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(lux_code(0.05), 2);
    EXPECT_EQ(lux_code(500.0), 254);
    EXPECT_EQ(lux_code(501.0), 255);
}

TEST(LuxCodes, AreOfTheMiddlesOfBlocks) {
    Image<float> lx(512, 10, 1.0F);
    lx.at(1, 1) = 100.0F;
    const Image<std::uint8_t> codes = lux_codes(lx, 256);
    EXPECT_EQ(codes.width(), 256);
    EXPECT_EQ(codes.height(), 5);
    EXPECT_EQ(codes.at(0, 0), lux_code(100.0));
    EXPECT_EQ(codes.at(1, 0), lux_code(1.0));
    const Image<std::uint8_t> flat = lux_codes(Image<float>(1024, 3, 1.0F), 256); // blocks of 4 are higher than it
    EXPECT_EQ(flat.width(), 256);
    EXPECT_EQ(flat.height(), 1);
    EXPECT_EQ(flat.at(255, 0), lux_code(1.0));
    EXPECT_NE(embedded_codes({&flat}), "");
}

} // namespace
} // namespace fernlicht
