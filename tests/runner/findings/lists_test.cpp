#include "runner/findings/lists.h"

#include "runner/write/document.h"
#include "runner/write/formats.h"
#include "tests/runner/program.h"

#include <array>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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
    EXPECT_EQ(document_text(techniques_document(rows(), methods)), "#         4 (row of Table 6.1: ~22 frames/s)\n"
                                                                   "name      full\n"
                                                                   "kind      as published\n"
                                                                   "computes  a | b\n"
                                                                   "ignores   shadows\n"
                                                                   "passes    1\n"
                                                                   "lux       surfaces\n"
                                                                   "origin    thesis, section 6\n"
                                                                   "\n"
                                                                   "name      light-map\n"
                                                                   "kind      known\n"
                                                                   "computes  a map\n"
                                                                   "passes    2\n"
                                                                   "lux       no\n"
                                                                   "\n"
                                                                   "Shadow methods\n"
                                                                   "name      map\n"
                                                                   "computes  depth | texels\n"
                                                                   "ignores   width\n");
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
    const std::string text = document_markdown(techniques_document(rows(), methods));
    EXPECT_THAT(text, HasSubstr("\n| 4 | `full` | as published | a \\| b | shadows | 1 | surfaces | thesis, section 6 |\n"));
    EXPECT_THAT(text, HasSubstr("\n|  | `light-map` | known | a map |  | 2 | no |  |\n"));
    EXPECT_THAT(text, HasSubstr("\n| `map` | depth \\| texels | width |  |\n"));
}

TEST(TechniqueList, ReferenceSaysEachInOneLine) {
    const std::string text = document_markdown(techniques_reference(rows(), methods));
    EXPECT_THAT(text, HasSubstr("\n- `full` (as published): a | b. Ignores shadows. Row 4.\n"));
    EXPECT_THAT(text, HasSubstr("\n- `light-map` (known, 2 passes, no lux): a map.\n"));
    EXPECT_THAT(text, HasSubstr("\n- `map`: depth | texels. Ignores width.\n"));
}

TEST(ReadingsList, SaysEachQuantityInWords) {
    const std::string text = document_text(readings_document());
    EXPECT_THAT(text, HasSubstr("reading     patch_dark_own[_max]_m\nunit        m\nbetter      lower\n"
                                "what it is  longest patch of a moment that is darker than its surroundings\n"));
    EXPECT_THAT(text, HasSubstr("reading     sensor_NAME_at_50m_lx, sensor_NAME_max_lx\n"));
}

TEST(ListCommands, PrintEachInOneForm) {
    EXPECT_EQ(nlohmann::json::parse(run_program("techniques --json").output).at("techniques").size(), techniques().size());
    EXPECT_EQ(run_program("techniques --json --markdown").exit_code, 2);
    const std::string refusal = run_program("bench --tables slides").output;
    EXPECT_THAT(refusal, HasSubstr("--tables: found 'slides', expected one of "));
    for (const OutputFormat& format : output_formats()) {
        SCOPED_TRACE(format.name);
        EXPECT_EQ(refusal.find(format.name) != std::string::npos, format.of_table != nullptr);
        if (!format.of_document)
            continue;
        const std::string command = fmt::format("readings --{}", format.name);
        EXPECT_EQ(run_program(command).output, format.of_document(readings_document()));
        EXPECT_EQ(run_program(command + (command.ends_with("tex") ? " --markdown" : " --tex")).exit_code, 2);
    }
}

} // namespace
} // namespace fernlicht
