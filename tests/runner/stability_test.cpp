// Every case of `fernlicht stability`, judged as the command judges it; and the judging itself.
#include "runner/stability/stability_case.h"
#include "runner/stability/stability_text.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

namespace fernlicht {
namespace {

std::string test_name(const testing::TestParamInfo<const StabilityCase*>& info) {
    std::string name = info.param->full_name();
    std::ranges::replace_if(
        name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}

std::vector<const StabilityCase*> all_cases() {
    std::vector<const StabilityCase*> cases;
    for (const StabilityCase& one : stability_cases())
        cases.push_back(&one);
    return cases;
}

class Stability : public testing::TestWithParam<const StabilityCase*> {};

TEST_P(Stability, HoldsItsBound) {
    const TemporaryFolder folder;
    StabilityBench bench("auto", folder.path(), false);
    const StabilityRow row = judge(*GetParam(), bench);
    EXPECT_EQ(row.verdict, Judgement::pass) << stability_text(row);
}

INSTANTIATE_TEST_SUITE_P(Cases, Stability, testing::ValuesIn(all_cases()), test_name);

StabilityRow judged(double bound, const std::function<Found(StabilityBench&)>& measure) {
    static StabilityCase one;
    one = {"trial", "case", "nothing", bound, "units", "none", measure};
    StabilityBench bench("auto", "unused", false);
    return judge(one, bench);
}

Found found(double error) {
    Found result;
    result.add(error, "here");
    return result;
}

TEST(StabilityJudging, ComparesWithTheBound) {
    EXPECT_EQ(judged(1.0, [](auto&) { return found(1.0); }).verdict, Judgement::pass);
    EXPECT_EQ(judged(1.0, [](auto&) { return found(1.0000001); }).verdict, Judgement::fail);
    EXPECT_EQ(judged(0.0, [](auto&) { return found(0.0); }).verdict, Judgement::pass);
}

TEST(StabilityJudging, WhatIsNoNumberFails) {
    EXPECT_EQ(judged(1e300, [](auto&) { return found(std::numeric_limits<double>::quiet_NaN()); }).verdict, Judgement::fail);
    EXPECT_EQ(judged(1e300, [](auto&) { return found(std::numeric_limits<double>::infinity()); }).verdict, Judgement::fail);
    const StabilityRow thrown = judged(1.0, [](auto&) -> Found { throw std::logic_error("a bug"); });
    EXPECT_EQ(thrown.verdict, Judgement::fail);
    EXPECT_EQ(thrown.found.where, "thrown: a bug");
}

TEST(StabilityJudging, NotMeasuredIsNoPass) {
    const StabilityRow row = judged(1.0, [](auto&) {
        Found result;
        result.not_measured = "no such device";
        return result;
    });
    EXPECT_EQ(row.verdict, Judgement::not_measured);
    EXPECT_THAT(stability_summary({row}), testing::HasSubstr("0 pass, 0 fail, 1 not_measured: trial/case"));
}

TEST(StabilityJudging, TheWorstTrialStays) {
    Found worst;
    worst.add(1.0, "a");
    worst.add(3.0, "b");
    worst.add(2.0, "c");
    EXPECT_EQ(worst.where, "b");
    worst.add(std::numeric_limits<double>::quiet_NaN(), "d");
    worst.add(9.0, "e");
    EXPECT_EQ(worst.where, "d");
    EXPECT_TRUE(std::isnan(worst.error));
}

TEST(StabilityCases, HaveNamesOfTheirOwnAndReasons) {
    std::set<std::string> names;
    for (const StabilityCase& one : stability_cases()) {
        EXPECT_TRUE(names.insert(one.full_name()).second) << one.full_name();
        EXPECT_GT(one.reason.size(), 20U) << one.full_name();
        EXPECT_GT(one.could_break.size(), 10U) << one.full_name();
        EXPECT_FALSE(one.unit.empty()) << one.full_name();
    }
}

TEST(StabilityCommand, TriesWhatItIsAskedFor) {
    const Outcome outcome = run_program("stability --only 'table/w*' --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const auto rows = nlohmann::json::parse(outcome.output).at("rows");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].at("case"), "table/wrap-around");
    EXPECT_EQ(rows[0].at("verdict"), "pass");
    EXPECT_LE(rows[0].at("error").get<double>(), rows[0].at("bound").get<double>());
}

TEST(StabilityCommand, RefusesAPatternThatFitsNothing) {
    const Outcome outcome = run_program("stability --only table/zerro");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, testing::HasSubstr("expected table/zero"));
}

} // namespace
} // namespace fernlicht
