#include "scenarios/values/errors.h"
#include "scenarios/values/picture_decoding.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

std::string little_picture() { return encode_texture(Image<float>(4, 3), "illuminance.lx", {{"fernlicht:scale_lx", "10"}}); }

/// OpenEXR takes memory for what an attribute claims: 4 GB for a file of 500 bytes.
TEST(PictureDecoding, AnAttributeLongerThanItsFileIsRefusedBeforeItIsRead) {
    std::string bytes = little_picture();
    EXPECT_TRUE(has_whole_exr_header(bytes));
    EXPECT_EQ(decode_texture("lux.exr", bytes, 100).value.width(), 4);
    const std::size_t size = bytes.find("string", bytes.find("scale_lx")) + 7;
    bytes.replace(size, 4, "\x02\x01\xff\xff");
    EXPECT_FALSE(has_whole_exr_header(bytes));
    EXPECT_THAT([&] { decode_texture("lux.exr", bytes, 100); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("lux.exr: ends early or is damaged, expected a PNG or EXR picture")));
}

TEST(PictureDecoding, AHeaderEndsWithAnEmptyName) {
    const std::string bytes = little_picture();
    std::size_t end = bytes.size();
    while (has_whole_exr_header(bytes.substr(0, end - 1)))
        --end;
    EXPECT_LT(end, bytes.size()) << "what follows is no part of it";
    EXPECT_EQ(bytes[end - 1], '\0');
    for (std::size_t cut = 0; cut < end; ++cut)
        EXPECT_FALSE(has_whole_exr_header(bytes.substr(0, cut))) << cut;
}

TEST(PictureDecoding, OfSeveralPartsEveryHeaderCounts) {
    const std::string attribute("a\0string\0\1\0\0\0x", 14), broken("a\0string\0\1\0\1\0x", 14), end(1, '\0'), magic("v/1\1\2\x10\0\0", 8);
    EXPECT_TRUE(has_whole_exr_header(magic + attribute + end + attribute + end + end));
    EXPECT_FALSE(has_whole_exr_header(magic + attribute + end + broken + end + end));
    EXPECT_TRUE(has_whole_exr_header(std::string("v/1\1\2\0\0\0", 8) + attribute + end + broken)) << "pixels of the only part";
}

} // namespace
} // namespace fernlicht
