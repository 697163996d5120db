// What a model's materials say that no surface does.
#include "scenarios/models/material_doubts.h"

#include "scenarios/models/model.h"
#include "scenarios/values/png_file.h"
#include "tests/scenarios/models/written_gltf.h"
#include "tests/trial.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using test::give_picture, test::Json, test::square, test::WrittenGltf;
using testing::HasSubstr;

std::string doubts(const WrittenGltf& file) {
    const std::filesystem::path folder = tests::new_folder();
    file.write_glb(folder / "model.glb");
    std::string all;
    for (const MaterialDoubt& doubt : read_model(folder / "model.glb").doubts)
        all += doubt.text + "\n";
    return all;
}

TEST(MaterialDoubts, WhatNoSurfaceReflectsIsDoubted) {
    const auto with = [](const Json& material) {
        WrittenGltf file = square();
        file.json["materials"][0] = material;
        return doubts(file);
    };
    const auto factor = [](double r, double g, double b) { return Json{{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1}}}}}; };
    EXPECT_THAT(with(factor(0.95, 0.95, 0.95)), HasSubstr("reflects 0.95"));
    EXPECT_EQ(with(factor(0.8, 0.8, 0.8)), "");
    EXPECT_THAT(with(factor(0.01, 0.01, 0.01)), HasSubstr("reflects 0.010"));
    EXPECT_THAT(with(factor(128 / 255.0, 64 / 255.0, 32 / 255.0)), HasSubstr("steps of 1/255"));
    EXPECT_EQ(with(factor(0.2158605, 0.0512695, 0.0144438)), "") << "the same as linear numbers";
    Json sign = factor(0.5, 0.5, 0.5);
    sign["emissiveFactor"] = {1, 1, 1};
    sign["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 900;
    EXPECT_EQ(with(sign), "");
    sign["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 5000;
    EXPECT_THAT(with(sign), HasSubstr("shines with 5000 cd/m2"));
    Json sheet = factor(0.5, 0.5, 0.5); // 500 cd/(lx m2) over a lobe of 0.02 rad, from the angle 0: 2 pi 500 0.02^2 = 1.26
    sheet["extras"] = {{"retro_rl", 500}, {"retro_reference_rad", 1e-5}, {"retro_falloff_rad", 0.02}};
    EXPECT_THAT(with(sheet), HasSubstr("reflects 0.50 diffusely and returns 1.26"));
}

TEST(MaterialDoubts, APictureThatIsNoColourIsDoubted) {
    const auto png = [](int r, int g, int b, bool linear) {
        const std::vector<std::uint8_t> rgb{static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
        std::string bytes = encode_png({1, 1, 8, rgb.data()}, 1);
        if (linear) // gAMA of 1.0, with its checksum, behind the head
            bytes.insert(33, std::string("\0\0\0\4gAMA\0\1\x86\xa0\x31\xe8\x96\x5f", 16));
        return bytes;
    };
    WrittenGltf file = square();
    give_picture(file, png(128, 130, 100, false));
    EXPECT_EQ(doubts(file), "");
    give_picture(file, png(128, 130, 100, true));
    EXPECT_THAT(doubts(file), HasSubstr("says it is linear"));
    give_picture(file, png(128, 127, 250, false));
    EXPECT_THAT(doubts(file), HasSubstr("looks like directions of a surface"));
    file.json["materials"].push_back({{"normalTexture", {{"index", 0}}}});
    EXPECT_THAT(doubts(file), HasSubstr("is directions of a surface elsewhere"));
}

} // namespace
} // namespace fernlicht
