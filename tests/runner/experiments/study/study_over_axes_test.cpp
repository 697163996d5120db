// Readings over a study's axes: what is drawn, and what is not.
#include "runner/experiments/study/study_document.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::EndsWith;

class StudyOverAxes : public testing::Test {
  protected:
    StudyOverAxes() {
        study.study.lamps.resize(1);
        study.study.lamps[0].name = "old";
        study.study.decide = {reach};
        study.study.axes = {{"weather.wetness", {}, {}, {}}, {"eyes_m", {}, {}, {}}, {"traffic.ahead.model", {}, {}, {}}};
        study.keys = {key_of(reach).value()};
        double reach_m = 40.0;
        for (const char* const wetness : {"0", "0.5", "1"})
            for (const char* const eyes : {"1.1", "1.2"}) {
                CellResult& cell = study.cells.emplace_back();
                cell.cell.axes = {{"weather.wetness", wetness}, {"eyes_m", eyes}, {"traffic.ahead.model", eyes + std::string(".glb")}};
                read(cell, reach_m);
                reach_m += 2.0;
            }
    }
    static void read(CellResult& cell, double reach_m) {
        const ReadingKey key = key_of(reach).value();
        cell.readings[key] = {key, reach_m};
    }
    std::vector<StudyFigure> drawn() const {
        std::vector<StudyFigure> figures;
        add_over_axes(study, figures);
        return figures;
    }
    static const plots::Figure& figure(const StudyFigure& of) { return std::get<plots::Figure>(of.plot.figure); }

    static constexpr const char* reach = "reach_5lx_target_own_m";
    StudyResult study;
};

TEST_F(StudyOverAxes, ALineALampThroughMedians) {
    const std::vector<StudyFigure> figures = drawn();
    ASSERT_EQ(figures.size(), 2U) << "models are no numbers";
    EXPECT_THAT(figures[0].title, EndsWith("weather.wetness from 0 to 1: old from 40 to 48 m"));
    EXPECT_THAT(figures[1].title, EndsWith("eyes_m from 1.1 to 1.2: old from 44 to 46 m"));
    ASSERT_EQ(figure(figures[0]).series.size(), 1U);
    EXPECT_EQ(figure(figures[0]).series[0].points.size(), 3U);
    EXPECT_THAT(figure(figures[0]).subtitle, testing::HasSubstr("median of up to 2 cells a point"));
}

TEST_F(StudyOverAxes, ALineADriveWhereTheyAreFew) {
    for (std::size_t i = 0; i < study.cells.size(); ++i)
        study.cells[i].drive = i % 2 == 0 ? "country" : "straight";
    const std::vector<StudyFigure> figures = drawn();
    const plots::Figure& wetness = figure(figures.at(0));
    EXPECT_THAT(figures[0].title, EndsWith(": old, country from 40 to 48 m; old, straight from 42 to 50 m"));
    ASSERT_EQ(wetness.series.size(), 2U);
    EXPECT_NE(wetness.series[0].dash, wetness.series[1].dash);
    EXPECT_EQ(wetness.y.label, "reach at 5 lx on a target");
    study.study.lamps.resize(4, study.study.lamps.front());
    for (const std::size_t lamp : {1U, 2U, 3U})
        for (std::size_t i = 0; i < 6; ++i)
            study.cells.emplace_back(study.cells[i]).cell.lamp = lamp;
    EXPECT_EQ(figure(drawn().at(0)).series.size(), 4U) << "of eight lines one for each lamp, through the medians";
}

TEST_F(StudyOverAxes, ASampleIsDots) {
    study.study.sample.kind = SampleKind::low_discrepancy;
    EXPECT_EQ(figure(drawn().front()).series.size(), 3U);
}

TEST_F(StudyOverAxes, NothingThatStaysAsItIs) {
    for (CellResult& cell : study.cells)
        read(cell, 40.0);
    EXPECT_THAT(drawn(), testing::IsEmpty());
}

} // namespace
} // namespace fernlicht
