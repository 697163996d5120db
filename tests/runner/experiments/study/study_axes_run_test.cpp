// Axes of a study through the program: what is played at each point, and where its values stand.
#include "runner/experiments/study/study_document.h"
#include "runner/experiments/study/study_plan.h"
#include "runner/experiments/study/study_run.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/values/files.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>
#include <map>
#include <sstream>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct StudyAxesProgram : testing::Test {
    TemporaryFolder folder;

    std::string study_file(const std::string& more) {
        std::string file = folder / "axes.yaml";
        std::ofstream(file) << "fernlicht_study: 1\nlamps:\n  old: {low: " << library_file("lamps/halogen-low.ies")
                            << "}\n  new: {low: " << library_file("lamps/xenon-low.ies") << ", source: arc}\ndrives: ["
                            << library_file("drives/straight.yaml") << "]\npictured_moments: 1\nresolution_px: [96, 72]\n"
                            << more;
        return file;
    }
};

double reading_of(const json& cell, const std::string& name) {
    for (const json& row : cell.at("readings"))
        if (row.at("name") == name && row.at("value").is_number())
            return row.at("value");
    ADD_FAILURE() << name << " in " << cell.at("name");
    return 0.0;
}

TEST_F(StudyAxesProgram, ModelsThatAnAxisNamesAreInputsOfTheirCellsAlone) {
    for (const double width_m : {1.7, 1.8})
        write_file(folder / (width_m == 1.7 ? "a.glb" : "b.glb"), glb_of(car_body({{4.2, width_m, 1.5}, -0.8, glm::vec3(0.3F)})));
    const std::string file = folder / "models.yaml";
    write_file(file, "fernlicht_study: 1\nlamps: {old: {low: " + library_file("lamps/halogen-low.ies") + "}, new: {low: " +
                         library_file("lamps/xenon-low.ies") + ", source: arc}}\ndrives: [" + library_file("drives/oncoming.yaml") +
                         "]\naxes: {traffic.ahead.model: [" + (folder / "a.glb") + ", " + (folder / "b.glb") + "]}\n");
    const auto keys = [&] {
        StudyOptions options{.store = folder / "store"};
        std::vector<std::string> all;
        for (const PlannedCell& cell : plan_study(read_study(file), options).cells)
            all.push_back(cell.key);
        return all;
    };
    const std::vector<std::string> before = keys();
    write_file(folder / "b.glb", glb_of(car_body({{4.2, 1.8, 1.5}, -0.8, glm::vec3(0.6F)}))); // as large as before
    const std::vector<std::string> after = keys();
    ASSERT_EQ(after.size(), 4U);
    for (std::size_t i = 0; i < after.size(); ++i)
        EXPECT_EQ(after[i] == before[i], i < 2) << i; // both lamps at one point, then at the next
}

TEST_F(StudyAxesProgram, PlaysEveryPointAndTellsItsValues) {
    const Outcome run = run_program("study " + study_file("axes: {weather.wetness: [0, 1], mount_height_m: [0.5, 0.8]}\n") +
                                    " --frames 0:2 --quiet --no-accuracy --out " + (folder / "out"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const json study = tests::checked(content_of(folder / "out/study.json"), study_members);
    ASSERT_EQ(study.at("cells").size(), 8U);
    std::map<std::string, json> cells;
    for (const json& cell : study.at("cells"))
        cells[cell.at("name")] = cell;
    const json& low = cells.at("straight_old_p01");
    const json& high = cells.at("straight_old_p02");
    EXPECT_EQ(high.at("point"), 2);
    EXPECT_EQ(high.at("axes"), json::parse(R"([{"axis": "weather.wetness", "value": 0}, {"axis": "mount_height_m", "value": 0.8}])"));
    // A target of 25 cm stands under the cut-off, which dips 1 cm in 1 m, up to 25 m before the low lamp and 55 m before the high one.
    const std::string reach = "reach_5lx_target_own_m";
    EXPECT_GT(reading_of(high, reach), reading_of(low, reach));
    // Compared at one point, never across points.
    for (const json& change : study.at("changes")) {
        const std::string now = change.at("new_cell"), before = change.at("old_cell");
        EXPECT_EQ(now.substr(now.rfind('_')), before.substr(before.rfind('_')));
    }
    std::istringstream csv(content_of(folder / "out/study.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_THAT(line, HasSubstr(",change_bound,weather.wetness,mount_height_m\r"));
    std::getline(csv, line);
    EXPECT_THAT(line, HasSubstr(",0,0.5\r"));
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("weather.wetness 1, mount_height_m 0.8"));
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("mount_height_m from 0.5 to 0.8: old from "));
    EXPECT_TRUE(fs::exists(folder / "out/figures/axis_mount_height_m_reach_5lx_target_own_m.svg"));
    EXPECT_THAT(content_of(folder / "out/cells/straight_new_p04/straight-1.yaml"), HasSubstr("wetness: 1"));
}

TEST_F(StudyAxesProgram, ListsPointsAndRefusesBeforeAnythingIsPlayed) {
    const Outcome list =
        run_program("study " + study_file("axes: {mount_height_m: {from: 0.5, to: 0.9}}\nsample: {low_discrepancy: 3000}\n") +
                    " --list --only '*_new_p0003'");
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_THAT(list.output, HasSubstr("straight_new_p0003"));
    EXPECT_THAT(list.output, HasSubstr("mount_height_m 0.8"));
    const Outcome refused = run_program("study " + study_file("axes: {weather.wetness: [0, 2]}\n") + " --out " + (folder / "none"));
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("axes.weather.wetness: found 2, which this drive refuses"));
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

} // namespace
} // namespace fernlicht
