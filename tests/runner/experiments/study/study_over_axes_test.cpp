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
