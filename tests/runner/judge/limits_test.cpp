#include "runner/judge/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using ::testing::HasSubstr;

Drive with_limit(Limit limit) {
    Drive drive;
    drive.limits.push_back(std::move(limit));
    return drive;
}

Verdict judged(Limit limit, const Readings& readings) {
    const auto verdicts = judge_limits(with_limit(std::move(limit)), readings);
    EXPECT_EQ(verdicts.size(), 1U);
    return verdicts.at(0);
}

Reading reading(const std::string& name, const Value& value, int tick = -1) { return {key_of(name).value(), value, "", tick}; }

const Readings reach_of_61{reading("reach_5lx_road_own_m", 61.25)};

TEST(Limits, WithinIsGreenWithItsFigures) {
    const Verdict verdict = judged({"reach_5lx_road_own_m", 60.0, {}}, reach_of_61);
    EXPECT_EQ(verdict.kind, VerdictKind::pass);
    EXPECT_EQ(verdict.name, "reach_5lx_road_own_m");
    EXPECT_EQ(verdict.text, "61.25 m, limit at least 60 m");
}

TEST(Limits, BeyondIsRed) {
    EXPECT_EQ(judged({"reach_5lx_road_own_m", 61.3, {}}, reach_of_61).kind, VerdictKind::fail);
    EXPECT_EQ(judged({"reach_5lx_road_own_m", {}, 61.2}, reach_of_61).kind, VerdictKind::fail);
    const Verdict verdict = judged({"reach_5lx_road_own_m", 50.0, 60.0}, reach_of_61);
    EXPECT_EQ(verdict.kind, VerdictKind::fail);
    EXPECT_EQ(verdict.text, "61.25 m, limit at least 50 m and at most 60 m");
}

TEST(Limits, ExactlyTheLimitIsWithin) {
    EXPECT_EQ(judged({"reach_5lx_road_own_m", 61.25, {}}, reach_of_61).kind, VerdictKind::pass);
    EXPECT_EQ(judged({"reach_5lx_road_own_m", {}, 61.25}, reach_of_61).kind, VerdictKind::pass);
    EXPECT_EQ(judged({"reach_5lx_road_own_m", 61.25, 61.25}, reach_of_61).kind, VerdictKind::pass);
}

// 59.9999 m in four digits is 60 m: a failed verdict must not read "60 m, limit at least 60 m".
TEST(Limits, AFailureShowsAllItsDigitsWhereRoundingHidesIt) {
    const Verdict verdict = judged({"sensor_a_reach_5lx_m", 60.0, {}}, {reading("sensor_a_reach_5lx_m", 59.9999)});
    EXPECT_EQ(verdict.kind, VerdictKind::fail);
    EXPECT_EQ(verdict.text, "59.9999 m, limit at least 60 m");
}

TEST(Limits, NotMeasuredIsNotGreen) {
    const Verdict verdict =
        judged({"sensor_a_reach_5lx_m", 1.0, {}}, {reading("sensor_a_reach_5lx_m", Value::not_measured("the lane ends"))});
    EXPECT_EQ(verdict.kind, VerdictKind::not_measured);
    EXPECT_EQ(verdict.text, "not measured: the lane ends, limit at least 1 m");
}

TEST(Limits, ABoundIsJudgedByWhatItLeavesOpen) {
    const Readings beyond{reading("sensor_a_reach_5lx_m", Value::at_least(200.0))};
    EXPECT_EQ(judged({"sensor_a_reach_5lx_m", 180.0, {}}, beyond).kind, VerdictKind::pass);
    EXPECT_EQ(judged({"sensor_a_reach_5lx_m", 180.0, {}}, beyond).text, "> 200 m, limit at least 180 m");
    EXPECT_EQ(judged({"sensor_a_reach_5lx_m", {}, 150.0}, beyond).kind, VerdictKind::fail);
    EXPECT_EQ(judged({"sensor_a_reach_5lx_m", 220.0, {}}, beyond).kind, VerdictKind::not_measured);
    EXPECT_EQ(judged({"sensor_a_reach_5lx_m", 220.0, {}}, beyond).text, "> 200 m, limit at least 220 m");
}

TEST(Limits, AnUnknownReadingIsNotGreenAndNamesTheNearest) {
    const Verdict verdict = judged({"reach_5lx_raod_own_m", 1.0, {}}, reach_of_61);
    EXPECT_EQ(verdict.kind, VerdictKind::not_measured);
    EXPECT_THAT(verdict.text, HasSubstr("reach_5lx_road_own_m"));
    EXPECT_EQ(judged({"zzz", 1.0, {}}, {}).kind, VerdictKind::not_measured);
}

TEST(Limits, ALimitWithoutAFigureIsNotGreen) {
    EXPECT_EQ(judged({"reach_5lx_road_own_m", {}, {}}, reach_of_61).kind, VerdictKind::not_measured);
}

TEST(Limits, OfMomentsTheWorstDecidesAndTheWholeDriveComesFirst) {
    const Readings moments{reading("probe_a_lx", 3.0, 4), reading("probe_a_lx", 1.5, 7), reading("probe_a_lx", 2.0, 9)};
    const Verdict verdict = judged({"probe_a_lx", 2.0, {}}, moments);
    EXPECT_EQ(verdict.kind, VerdictKind::fail);
    EXPECT_EQ(verdict.text, "1.5 lx at frame 7, limit at least 2 lx");
    Readings whole = moments;
    whole.push_back(reading("probe_a_lx", 2.5));
    EXPECT_EQ(judged({"probe_a_lx", 2.0, {}}, whole).kind, VerdictKind::pass);
}

TEST(Limits, OneUnmeasuredMomentSpoilsAPassButHidesNoFailure) {
    Readings moments{reading("probe_a_lx", 3.0, 4), reading("probe_a_lx", Value::not_measured("out of sight"), 7)};
    EXPECT_EQ(judged({"probe_a_lx", 2.0, {}}, moments).kind, VerdictKind::not_measured);
    moments[0].value = 1.0;
    EXPECT_EQ(judged({"probe_a_lx", 2.0, {}}, moments).kind, VerdictKind::fail);
}

} // namespace
} // namespace fernlicht
