#include "scenarios/values/errors.h"
#include "scenarios/values/picture_decoding.h"

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

} // namespace
} // namespace fernlicht
