#include "runner/judge/baseline_difference.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using ::testing::HasSubstr;

AcceptedReading reading(double mean, int count = 1, double variance = 0.0) {
    return {key_of("probe_a_lx").value(), -1, mean, count, variance};
}

ResultDifference compared(const AcceptedReading& tested, const AcceptedReading& accepted, std::size_t comparisons = 1) {
    std::vector<AcceptedReading> ours{tested}, theirs{accepted};
    for (std::size_t i = 1; i < comparisons; ++i) {
        ours.push_back({key_of("probe_other-" + std::to_string(i) + "_lx").value(), -1, 1.0, 1, 0.0});
        theirs.push_back(ours.back());
    }
    return compare_readings(ours, theirs, {}).front();
}

// 100 lx may round by 0.1001 lx, and no further.
TEST(ReadingWithoutSpread, IsJudgedByRoundingAlone) {
    EXPECT_EQ(compared(reading(100.1), reading(100.0)).agreement, Agreement::agrees);
    EXPECT_EQ(compared(reading(99.9), reading(100.0)).agreement, Agreement::agrees);
    EXPECT_EQ(compared(reading(100.11), reading(100.0)).agreement, Agreement::differs);
    EXPECT_EQ(compared(reading(99.89), reading(100.0)).agreement, Agreement::differs);
    EXPECT_EQ(compared(reading(100.11, 5), reading(100.0, 7)).agreement, Agreement::differs) << "equal repeats have no spread";
    EXPECT_THAT(compared(reading(100.11), reading(100.0)).text, HasSubstr("allowed for rounding: 0.1 lx"));
}

// A grid error of 1.6 mm at a reach of 60 m is the difference of two figures of 60 m: these may round by 0.6 mm, and it by 0.1 mm of its
// own.
TEST(ReadingWithoutSpread, IsRoundedAsTheOtherWhoseErrorItTells) {
    const auto judged = [](double error_m) {
        const AcceptedReading reach{key_of("reach_1lx_target_own_m").value(), -1, 60.0, 1, 0.0};
        const auto error_of = [](double value) {
            return AcceptedReading{key_of("reach_1lx_target_own_grid_error_m").value(), -1, value, 1, 0.0};
        };
        return compare_readings({error_of(error_m), reach}, {error_of(0.0016), reach}, {}).front();
    };
    EXPECT_EQ(judged(0.0016 + 0.0007).agreement, Agreement::agrees);
    EXPECT_EQ(judged(0.0016 + 0.00071).agreement, Agreement::differs);
    EXPECT_THAT(judged(0.003).text, HasSubstr("allowed for rounding: 0.000702 m"));
}

// Accepted: 20 repeats with a standard deviation of 0.05 lx. Student's t with 19 degrees of freedom at 0.001: 3.883 (printed tables); the
// error of one play against their mean 0.05 sqrt(1 + 1/20) = 0.05123: chance reaches 0.1989 lx, with rounding 0.2990.
TEST(ReadingWithSpread, IsJudgedByStudentsTestOnTopOfRounding) {
    const AcceptedReading accepted = reading(100.0, 20, 0.0025);
    EXPECT_EQ(compared(reading(100.298), accepted).agreement, Agreement::agrees);
    EXPECT_EQ(compared(reading(100.300), accepted).agreement, Agreement::differs);
    EXPECT_EQ(compared(reading(99.700), accepted).agreement, Agreement::differs);
    EXPECT_THAT(compared(reading(100.300), accepted).text, HasSubstr("z = 5.86, at most 3.88 by chance (19 repeats beyond the first)"));
    EXPECT_EQ(compared(reading(100.300), accepted, 10).agreement, Agreement::agrees) << "ten readings share the false alarm";
    EXPECT_EQ(compared(reading(102.0), accepted, 10).agreement, Agreement::differs) << "2 % of light is seen all the same";
}

TEST(ReadingWithSpread, TooFewRepeatsAreNoGreen) {
    const AcceptedReading two = reading(100.0, 2, 0.0025); // t with one degree of freedom at 0.001: 636.6
    EXPECT_EQ(compared(reading(100.05), two).agreement, Agreement::undecided);
    EXPECT_THAT(compared(reading(100.05), two).text, HasSubstr("accept a run with more repeats"));
    EXPECT_EQ(compared(reading(200.0), two).agreement, Agreement::differs);
    EXPECT_EQ(compared(reading(100.05), reading(100.0, 2, 1e-8)).agreement, Agreement::agrees) << "next to no spread needs no more";
    // 0.0008 sqrt(3/2) = 0.00098 lx is within a hundredth of 0.1001 lx, 0.0009 sqrt(3/2) = 0.0011 lx is not; by chance among ten thousand
    // readings either could reach some thousand lx.
    EXPECT_EQ(compared(reading(100.05), reading(100.0, 2, 0.0008 * 0.0008), 10000).agreement, Agreement::agrees);
    EXPECT_EQ(compared(reading(100.05), reading(100.0, 2, 0.0009 * 0.0009), 10000).agreement, Agreement::undecided);
    EXPECT_EQ(compared(reading(100.11), reading(100.0, 2, 0.0008 * 0.0008), 10000).agreement, Agreement::undecided);
}

TEST(ReadingWithSpread, TheRunsOwnRepeatsCount) {
    // Ten plays of the run with 0.05 lx against one accepted: the same degrees of freedom as if it stood the other way round.
    EXPECT_EQ(compared(reading(100.0, 10, 0.0025), reading(100.3)).agreement,
              compared(reading(100.3), reading(100.0, 10, 0.0025)).agreement);
    EXPECT_EQ(compared(reading(100.25, 40, 0.0025), reading(100.0, 40, 0.0025)).agreement, Agreement::differs)
        << "means of many plays are known better than one play";
    EXPECT_EQ(compared(reading(100.25), reading(100.0, 40, 0.0025)).agreement, Agreement::agrees);
}

TEST(ReadingWithSpread, WhetherItIsMeasuredComesFirst) {
    AcceptedReading other = reading(100.0, 20, 0.0025);
    other.mean = Value();
    EXPECT_EQ(compared(reading(100.0), other).agreement, Agreement::differs);
    AcceptedReading neither = reading(0.0);
    neither.mean = Value();
    EXPECT_EQ(compared(neither, other).agreement, Agreement::agrees);
}

} // namespace
} // namespace fernlicht
