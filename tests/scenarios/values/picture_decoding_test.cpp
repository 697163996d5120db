#include "scenarios/values/errors.h"
#include "scenarios/values/jpeg_file.h"
#include "scenarios/values/picture_decoding.h"
#include "scenarios/values/png_file.h"

#include <array>
#include <fstream>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

TEST(PictureDecoding, ADamagedTextureIsRefusedByName) {
    std::string bytes = encode_texture(Image<float>(4, 3), "illuminance.lx", {{"fernlicht:scale_lx", "10"}});
    EXPECT_EQ(decode_texture("lux.exr", bytes, 100).value.width(), 4);
    EXPECT_EQ(decode_texture("lux.exr", bytes, 100).attributes.at("fernlicht:scale_lx"), "10");
    bytes.resize(bytes.size() / 2);
    EXPECT_THAT(
        [&] { decode_texture("lux.exr", bytes, 100); },
        testing::ThrowsMessage<InputError>(testing::AllOf(testing::HasSubstr("lux.exr: cannot be decoded: "),
                                                          testing::HasSubstr("ends early or is damaged, expected a PNG or EXR picture"))));
}

TEST(PngFile, TextsTakeLittleMemory) {
    const std::array<std::uint8_t, 3> pixel{1, 2, 3};
    std::vector<std::pair<std::string, std::string>> texts(200, {"more", "and more"});
    texts.emplace_back("last", "one");
    const PngHead few = decode_png_head(encode_png({1, 1, 8, pixel.data()}, 1, "", {{"last", "one"}}));
    EXPECT_EQ(few.texts.at("last"), "one");
    EXPECT_FALSE(decode_png_head(encode_png({1, 1, 8, pixel.data()}, 1, "", texts)).texts.contains("last"));
}

TEST(PngFile, AChunkThatClaimsMoreThanThereIsTakesNoMemory) {
    const std::array<std::uint8_t, 3> pixel{1, 2, 3};
    std::string bytes = encode_png({1, 1, 8, pixel.data()}, 1, "", {});
    bytes.insert(33, "dowttEXt"); // 1.7 GB of a text, after the head
    const auto peak_kib = [] {
        std::ifstream status("/proc/self/status");
        std::string word;
        while (status >> word && word != "VmHWM:") {
        }
        long kib = 0;
        status >> kib;
        return kib;
    };
    std::ofstream("/proc/self/clear_refs") << "5"; // the peak begins anew
    const long before = peak_kib();
    EXPECT_THAT([&] { decode_png(bytes, [](const PngHead&) {}); }, testing::ThrowsMessage<std::runtime_error>("it ends early"));
    EXPECT_LT(peak_kib() - before, 100'000);
}

/// Eight by eight levels of grey in six scans, by libjpeg.
std::string progressive_jpeg() {
    const std::string_view digits =
        "ffd8ffdb00430050373c463c32504641465a55505f78c882786e6e78f5afb991c8ffffffffffffffffffffffffffffffffffffffffffff"
        "ffffffffffffffffffffffffffffffffffc2000b080008000801011100ffc40014000100000000000000000000000000000002ffda0008"
        "0101000000011fffc40014100100000000000000000000000000000000ffda00080101000105027fffc400151001010000000000000000"
        "0000000000000001ffda0008010100063f028fffc4001610010101000000000000000000000000000100b1ffda0008010100013f2130df"
        "ffda0008010100000010ff00ffc4001610000300000000000000000000000000000071f0ffda0008010100013f10a19fffd9";
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes.push_back(static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16)));
    return bytes;
}

TEST(JpegFile, ScansWithoutEndAreRefused) {
    std::string bytes = progressive_jpeg();
    const auto read = [&] { return decode_jpeg(bytes, [](const JpegPicture&) {}).bytes.size(); };
    EXPECT_EQ(read(), 64U);
    const std::string last_scan = bytes.substr(bytes.rfind("\xff\xda"), bytes.size() - 2 - bytes.rfind("\xff\xda"));
    for (int i = 0; i < 600; ++i)
        bytes.insert(bytes.size() - 2, last_scan);
    EXPECT_THAT(read, testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("more scans")));
}

} // namespace
} // namespace fernlicht
