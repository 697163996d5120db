// Tolerances of a study through the program: read, told, kept by a resumed study.
#include "runner/experiments/run/run_report.h"
#include "runner/experiments/study/study_document.h"
#include "runner/findings/series.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

std::string study_with_tolerances(const TemporaryFolder& folder, const std::string& tolerances) {
    std::string file = folder / "cars.yaml";
    std::ofstream(file) << "fernlicht_study: 1\nlamps:\n  old: {low: " << library_file("lamps/halogen-low.ies")
                        << "}\n  new: {low: " << library_file("lamps/xenon-low.ies") << ", source: arc}\ndrives: ["
                        << library_file("drives/straight.yaml")
                        << "]\npictured_moments: 1\nresolution_px: [96, 72]\ncompare: [{new: new, against: old}]\nmeasure:\n  tolerances: "
                        << tolerances << '\n';
    return file;
}

TEST(StudyCars, AreToldAndKeptByAResumedStudy) {
    const TemporaryFolder folder;
    const std::string call =
        "study " +
        study_with_tolerances(folder, "{cars: 20, draws: 100, yaw_deg: 0, roll_deg: 0, pitch_deg: {sigma: 0.1, source: end of line}, "
                                      "limits: [{reading: reach_5lx_target_own_right_edge_m, at_least: 62}]}") +
        " --frames 0:1 --quiet --no-accuracy --out " + (folder / "out");
    const Outcome run = run_program(call);
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const std::string page = content_of(folder / "out/report.html");
    for (const char* words : {"Cars of a series", "normal, standard deviation 0.1°", "end of line", "assumed", "at least 62 m"})
        EXPECT_THAT(page, HasSubstr(words));
    const Report cell = read_report(folder / "out/cells/straight_old");
    ASSERT_TRUE(cell.played.at(0).series);
    const SeriesFindings& series = *cell.played.at(0).series;
    EXPECT_EQ(series.parts.size(), 5U) << "pitch and flux of each lamp, height";
    EXPECT_EQ(series.cars, 20U);
    EXPECT_THAT(content_of(folder / "out/cells/straight_old/readings.csv"),
                HasSubstr("cars_within_reach_5lx_target_own_right_edge_m_percent"));
    EXPECT_THAT(content_of(folder / "out/study.csv"), HasSubstr("reach_5lx_target_own_right_edge_cars_p05_m"));
    EXPECT_THAT(content_of(folder / "out/cells/straight_old/report.html"), HasSubstr("Cars of a series"));

    const Outcome again = run_program(call + " --resume");
    EXPECT_EQ(again.exit_code, 0) << again.output;
    const auto cars_of = [](const std::string& html) { return html.substr(html.find("Cars of a series"), 3000); };
    EXPECT_EQ(cars_of(content_of(folder / "out/report.html")), cars_of(page));
}

TEST(StudyCars, ALimitOnWhatIsNotReadIsRefused) {
    const TemporaryFolder folder;
    const Outcome run =
        run_program("study " + study_with_tolerances(folder, "{limits: [{reading: glare_nobody_facing_max_lx, at_most: 1}]}") +
                    " --quiet --out " + (folder / "out"));
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.output, HasSubstr("measure.tolerances.limits: found reading 'glare_nobody_facing_max_lx'"));
}

} // namespace
} // namespace fernlicht
