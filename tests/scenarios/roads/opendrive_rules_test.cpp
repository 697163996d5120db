// What becomes of each file that breaks a rule of the standard: refused, played with a warning that names the breach, or without influence
// on light. The rules and reasons are in docs/roads.md; the files are the published cases of ASAM's OpenDRIVE checker.
#include "scenarios/roads/road_network.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace fernlicht {
namespace {

using testing::Contains, testing::HasSubstr;

enum class Verdict { refused, warned, none };

struct Case {
    std::string_view files; ///< how their names begin
    Verdict verdict;
    std::string_view says; ///< part of the refusal or of a warning
};

// clang-format off
constexpr auto cases = std::to_array<Case>({
    {"fileheader_is_present/negative", Verdict::warned, "the header is missing"},
    {"junction_connection_linkage/junction_connection_linkage_invalid", Verdict::warned, "does not lead to the incoming road"},
    {"junctions_connection_connect_road_no_incoming_road/", Verdict::warned, "is itself a connecting road"},
    {"junctions_connection_one_connection_element/", Verdict::warned, "does not lead to the incoming road"},
    {"junctions_connection_one_link_to_incoming/", Verdict::warned, "against its direction"},
    {"not_implemented_yet/rule_104_", Verdict::warned, "has borders although the road has a lane offset"},
    {"not_implemented_yet/rule_178_", Verdict::none, ""},
    {"not_implemented_yet/rule_242_", Verdict::none, ""},
    {"not_implemented_yet/rule_247_", Verdict::warned, "an outline of 0 corners"},
    {"not_implemented_yet/rule_253_", Verdict::warned, "an outline of 1 corners"},
    {"not_implemented_yet/rule_255_", Verdict::warned, "an outline of 1 corners"},
    {"not_implemented_yet/rule_257_", Verdict::none, ""},
    {"not_implemented_yet/rule_263_", Verdict::none, ""},
    {"not_implemented_yet/rule_267_", Verdict::none, ""},
    {"not_implemented_yet/rule_284_", Verdict::none, ""},
    {"not_implemented_yet/rule_285_", Verdict::none, ""},
    {"not_implemented_yet/rule_286_", Verdict::none, ""},
    {"not_implemented_yet/rule_305_", Verdict::none, ""},
    {"not_implemented_yet/rule_325_", Verdict::none, ""},
    {"not_implemented_yet/rule_341_", Verdict::none, ""},
    {"not_implemented_yet/rule_343_", Verdict::none, ""},
    {"not_implemented_yet/rule_371_", Verdict::warned, "a radius beside length or width"},
    {"not_implemented_yet/rule_64_", Verdict::warned, "must not stand beside it"},
    {"performance_avoid_redundant_info/", Verdict::none, ""},
    {"road_geometry_contact_point/invalid.", Verdict::warned, "lies 3.500 m from the start of road '2'"},
    {"road_geometry_contact_point/invalid_2.", Verdict::warned, "lies 50.000 m from the end of road '2'"},
    {"road_geometry_elem_asc_order/invalid", Verdict::warned, "not in ascending order"},
    {"road_geometry_param_poly3_length_match/road_geometry_param_poly3_length_match_invalid.", Verdict::warned, "541.8765 m long, its length says 540.8765"},
    {"road_geometry_param_poly3_length_match/road_geometry_param_poly3_length_match_invalid_multiple", Verdict::warned, "541.8765 m long"},
    {"road_geometry_parampoly3_arclength_range/", Verdict::warned, "7.5523 m long, its length says 7.5553"},
    {"road_geometry_parampoly3_valid_parameters/", Verdict::warned, "does not start at its own origin and heading"},
    {"road_lane_access_no_mix_of_deny_or_allow/", Verdict::none, ""},
    {"road_lane_border_overlap_with_inner_lanes/road_lane_border_overlap_with_inner_lanes_invalid.", Verdict::warned, "overlaps its inner neighbour by 1.000 m"},
    {"road_lane_border_overlap_with_inner_lanes/road_lane_border_overlap_with_inner_lanes_invalid_1.", Verdict::none, ""},
    {"road_lane_level_true_one_side/", Verdict::none, ""},
    {"road_lane_level_true_one_side_junction/", Verdict::none, ""},
    {"road_lane_level_true_one_side_lanesection/", Verdict::none, ""},
    {"road_lane_level_true_one_side_road/", Verdict::none, ""},
    {"road_lane_link_lanes_across_lane_sections/road_lane_link_lanes_across_lane_sections_invalid_no_predecessor_road", Verdict::warned, "lane -1 has no link over s = 50"},
    {"road_lane_link_lanes_across_lane_sections/road_lane_link_lanes_across_lane_sections_invalid_non_existing_lanes", Verdict::warned, "comes from lane 4, which the section before"},
    {"road_lane_link_lanes_across_lane_sections/road_lane_link_lanes_across_lane_sections_invalid_wrong_id", Verdict::warned, "lane -3 leads to lane -2 at s = 50, which does not lead back"},
    {"road_lane_link_new_lane_appear/", Verdict::warned, "has no width"},
    {"road_linkage_is_junction_needed/road_linkage_is_junction_needed_invalid.", Verdict::warned, "linked to the end of road '1' without a junction"},
    {"road_linkage_is_junction_needed/road_linkage_is_junction_needed_invalid_converge", Verdict::warned, "linked to the start of road '1' without a junction"},
    {"root_tag_is_opendrive/negative", Verdict::refused, "found root element 'ODrive'"},
    {"smoothness_example/junction_invalid_conn_smoothness", Verdict::warned, "lane -1 jumps by 0.950 m"},
    {"smoothness_example/many_invalid", Verdict::warned, "the reference line jumps by 0.100 m"},
    {"smoothness_example/multiple_successor_invalid", Verdict::warned, "the edges of lane -1 jump by 1.000 m"},
    {"valid_schema/negative", Verdict::refused, "has no geometry"},
    {"valid_schema/unsupported_schema", Verdict::warned, "the version 0.8"},
    {"valid_xml_document/xml.valid_xml_document.negative", Verdict::refused, "is not well-formed XML"},
    {"version_is_defined/negative_no_attr", Verdict::warned, "the version is missing"},
    {"version_is_defined/negative_no_type", Verdict::refused, "found 'seven'"},
});
constexpr std::size_t known_breaches = 90; ///< files that break a rule, as the folder has them
// clang-format on

std::filesystem::path checker_folder() {
    return std::filesystem::path(FERNLICHT_SHARED_DATA) / "roads" / "asam-ev__qc-opendrive" / "tests" / "data";
}

/// By its name, does the file break a rule?
bool named_invalid(const std::string& name) {
    for (const char* word : {"invalid", "negative", "unsupported", "close_match"})
        if (name.find(word) != std::string::npos)
            return true;
    return false;
}

TEST(OpenDriveRules, EachBreachIsJudgedAsListedAndWhatIsValidIsPlayed) {
    if (!std::filesystem::is_directory(checker_folder()))
        GTEST_SKIP() << "no checker cases in " << checker_folder();
    std::size_t breaches = 0;
    for (const std::filesystem::path& file : tests::files_below(checker_folder(), {".xodr"})) {
        SCOPED_TRACE(file);
        if (!named_invalid(file.filename().string())) {
            EXPECT_NO_THROW(read_opendrive(file));
            continue;
        }
        ++breaches;
        const std::string name = std::filesystem::relative(file, checker_folder()).string();
        const auto one = std::ranges::find_if(cases, [&](const Case& row) { return name.starts_with(row.files); });
        ASSERT_NE(one, cases.end()) << "not listed";
        const std::string says(one->says);
        try {
            const RoadNetwork network = read_opendrive(file);
            EXPECT_NE(one->verdict, Verdict::refused);
            EXPECT_FALSE(network.roads.empty());
            if (one->verdict == Verdict::warned) {
                EXPECT_THAT(network.warnings, Contains(HasSubstr(says)));
            }
            for (const std::string& warning : network.warnings)
                EXPECT_THAT(warning, testing::StartsWith(file.string() + ":"));
        } catch (const InputError& error) {
            EXPECT_EQ(one->verdict, Verdict::refused) << error.what();
            EXPECT_THAT(error.what(), HasSubstr(says));
            EXPECT_GT(error.where().line, 0U);
            EXPECT_EQ(error.where().file, file);
        }
    }
    EXPECT_EQ(breaches, known_breaches);
}

/// The rule a file is about: its folder, or "rule_104" among those that the checker itself does not know yet.
std::string rule_of(std::string_view file) {
    const std::size_t slash = file.find('/');
    const std::string folder(file.substr(0, slash)), name(file.substr(slash + 1));
    return folder == "not_implemented_yet" ? name.substr(0, name.find('_', 5)) : folder;
}

TEST(OpenDriveRulesText, EachRuleIsInTheDocument) {
    std::ifstream stream(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "docs" / "roads.md");
    ASSERT_TRUE(stream);
    std::stringstream text;
    text << stream.rdbuf();
    for (const Case& one : cases)
        EXPECT_THAT(text.str(), testing::ContainsRegex("[| \n]" + rule_of(one.files) + "[ ,.]")) << one.files;
}

} // namespace
} // namespace fernlicht
