#include "runner/judge/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>

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

TEST(Limits, AreJudgedByWhatWasMeasured) {
    const std::string reach = "reach_5lx_road_own_m", at_sensor = "sensor_a_reach_5lx_m", probe = "probe_a_lx";
    const Readings of_61{reading(reach, 61.25)}, beyond{reading(at_sensor, Value::at_least(200.0))},
        moments{reading(probe, 3.0, 4), reading(probe, 1.5, 7), reading(probe, 2.0, 9)};
    Readings whole = moments;
    whole.push_back(reading(probe, 2.5));
    const Reading out_of_sight = reading(probe, Value::not_measured("out of sight"), 7);
    const struct {
        const char* what;
        Limit limit;
        Readings readings;
        VerdictKind kind;
        std::string text; ///< "": whatever it is
    } cases[] = {
        {"within", {reach, 60.0, {}}, of_61, VerdictKind::pass, "61.25 m, limit at least 60 m"},
        {"beyond", {reach, 61.3, {}}, of_61, VerdictKind::fail, ""},
        {"beyond", {reach, {}, 61.2}, of_61, VerdictKind::fail, ""},
        {"beyond", {reach, 50.0, 60.0}, of_61, VerdictKind::fail, "61.25 m, limit at least 50 m and at most 60 m"},
        {"exactly the limit", {reach, 61.25, {}}, of_61, VerdictKind::pass, ""},
        {"exactly the limit", {reach, {}, 61.25}, of_61, VerdictKind::pass, ""},
        {"exactly the limit", {reach, 61.25, 61.25}, of_61, VerdictKind::pass, ""},
        // In four digits this is 60 m: a failed verdict must not read "60 m, limit at least 60 m".
        {"rounding hides it", {at_sensor, 60.0, {}}, {reading(at_sensor, 59.9999)}, VerdictKind::fail, "59.9999 m, limit at least 60 m"},
        {"not measured",
         {at_sensor, 1.0, {}},
         {reading(at_sensor, Value::not_measured("the lane ends"))},
         VerdictKind::not_measured,
         "not measured: the lane ends, limit at least 1 m"},
        {"a bound within", {at_sensor, 180.0, {}}, beyond, VerdictKind::pass, "> 200 m, limit at least 180 m"},
        {"a bound beyond", {at_sensor, {}, 150.0}, beyond, VerdictKind::fail, ""},
        {"a bound that leaves it open", {at_sensor, 220.0, {}}, beyond, VerdictKind::not_measured, "> 200 m, limit at least 220 m"},
        {"unknown", {"zzz", 1.0, {}}, {}, VerdictKind::not_measured, ""},
        {"without a figure", {reach, {}, {}}, of_61, VerdictKind::not_measured, ""},
        {"the worst moment", {probe, 2.0, {}}, moments, VerdictKind::fail, "1.5 lx at frame 7, limit at least 2 lx"},
        {"the whole drive", {probe, 2.0, {}}, whole, VerdictKind::pass, ""},
        {"a pass spoilt", {probe, 2.0, {}}, {reading(probe, 3.0, 4), out_of_sight}, VerdictKind::not_measured, ""},
        {"no failure hidden", {probe, 2.0, {}}, {reading(probe, 1.0, 4), out_of_sight}, VerdictKind::fail, ""}};
    for (const auto& [what, limit, readings, kind, text] : cases) {
        const Verdict verdict = judged(limit, readings);
        EXPECT_EQ(verdict.kind, kind) << what << ": " << verdict.text;
        EXPECT_TRUE(text.empty() || verdict.text == text) << what << ": " << verdict.text;
    }
    EXPECT_EQ(judged({reach, 60.0, {}}, of_61).name, reach);
    const Verdict misspelt = judged({"reach_5lx_raod_own_m", 1.0, {}}, of_61);
    EXPECT_EQ(misspelt.kind, VerdictKind::not_measured);
    EXPECT_THAT(misspelt.text, HasSubstr(reach));
}

} // namespace
} // namespace fernlicht
