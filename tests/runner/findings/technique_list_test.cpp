#include "runner/findings/technique_list.h"

#include <array>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr;

std::array<Technique, 2> rows() {
    Technique full, light_map;
    full.name = "full";
    full.kind = TechniqueKind::as_published;
    full.thesis_row = 4;
    full.thesis_fps = "~22";
    full.origin = "thesis, section 6";
    full.computes = "a | b";
    full.ignores = "shadows";
    full.illuminance = true;
    light_map.name = "light-map";
    light_map.kind = TechniqueKind::known;
    light_map.computes = "a map";
    light_map.passes = 2;
    return {full, light_map};
}

constexpr ShadowMethodName methods[] = {{ShadowMethod::map, "map", "", "depth | texels", "width"}};

TEST(TechniqueList, TextSaysEachOnce) {
    EXPECT_EQ(techniques_text(rows(), methods), "full  (as published; 1 pass; lux image of surfaces; Table 6.1 row 4: ~22 frames/s)\n"
                                                "    origin    thesis, section 6\n"
                                                "    computes  a | b\n"
                                                "    ignores   shadows\n"
                                                "\n"
                                                "light-map  (known; 2 passes; no lux image)\n"
                                                "    computes  a map\n"
                                                "\n"
                                                "shadows: map  (of photometric)\n"
                                                "    computes  depth | texels\n"
                                                "    ignores   width\n");
}

TEST(TechniqueList, JsonHoldsWhatTheRowHolds) {
    const auto json = nlohmann::json::parse(techniques_json(rows(), methods));
    EXPECT_EQ(json.at("schema_version"), 1);
    const auto& list = json.at("techniques");
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[0].at("thesis_row"), 4);
    EXPECT_EQ(list[0].at("kind"), "as published");
    EXPECT_EQ(list[0].at("illuminance"), true);
    EXPECT_TRUE(list[1].at("thesis_row").is_null());
    EXPECT_TRUE(list[1].at("thesis_fps").is_null());
    EXPECT_EQ(list[1].at("passes"), 2);
    EXPECT_EQ(json.at("shadow_methods").at(0).at("ignores"), "width");
}

TEST(TechniqueList, MarkdownEscapesItsOwnSigns) {
    const std::string text = techniques_markdown(rows(), methods);
    EXPECT_THAT(text, HasSubstr("\n| 4 | `full` | as published | a \\| b | shadows | 1 | surfaces | thesis, section 6 |\n"));
    EXPECT_THAT(text, HasSubstr("\n|  | `light-map` | known | a map |  | 2 | no |  |\n"));
    EXPECT_THAT(text, HasSubstr("\n| `map` | depth \\| texels | width |  |\n"));
}

} // namespace
} // namespace fernlicht
