// Values that are numbers, bounds or not measured, and what they make of each other.
#include "metrics/readings/value.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace fernlicht {
namespace {

const Value none = Value::not_measured("dark");

TEST(Value, ADifferenceIsWhatBothLetItBe) {
    EXPECT_EQ(difference(90.0, 60.0, "m"), Value(30.0));
    EXPECT_EQ(difference(Value::at_least(200.0), 60.0, "m"), Value::at_least(140.0));
    EXPECT_EQ(difference(60.0, Value::at_least(200.0), "m"), Value::at_most(-140.0));
    EXPECT_EQ(difference(60.0, Value::at_most(10.0), "m"), Value::at_least(50.0));
    EXPECT_EQ(difference(Value::at_least(200.0), Value::at_most(10.0), "m"), Value::at_least(190.0));
    EXPECT_EQ(difference(Value::at_least(200.0), Value::at_least(200.0), "m"), Value::not_measured("both beyond 200 m"));
    EXPECT_EQ(difference(Value::at_most(5.0), Value::at_most(5.0), "m"), Value::not_measured("both below 5 m"));
    EXPECT_EQ(difference(Value::at_least(40.0), Value::at_least(200.0), "m"),
              Value::not_measured("one beyond 40 m, the other beyond 200 m"));
    EXPECT_EQ(difference(none, 60.0, "m"), none);
    EXPECT_EQ(difference(60.0, none, "m"), none);
}

TEST(Value, ABoundKeepsALimitOrLeavesItOpen) {
    const Value beyond = Value::at_least(200.0);
    EXPECT_EQ(holds(beyond, 180.0, {}), true);
    EXPECT_EQ(holds(beyond, {}, 150.0), false);
    EXPECT_EQ(holds(beyond, 220.0, {}), std::nullopt);
    EXPECT_EQ(holds(beyond, 180.0, 220.0), std::nullopt);
    EXPECT_EQ(holds(Value::at_most(30.0), 50.0, {}), false);
    EXPECT_EQ(holds(Value::at_most(30.0), {}, 30.0), true);
    EXPECT_EQ(holds(Value::at_most(30.0), 20.0, {}), std::nullopt);
    EXPECT_EQ(holds(61.0, 61.0, 61.0), true);
    EXPECT_EQ(holds(none, 1.0, {}), std::nullopt);
}

TEST(Value, IsNeverNanOrInfinite) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(Value{bad}, std::invalid_argument);
        EXPECT_THROW(Value::at_least(bad), std::invalid_argument);
        EXPECT_THROW(Value::at_most(bad), std::invalid_argument);
    }
}

TEST(ManyMoments, QuantilesRestOnBoundsWhereTheyMust) {
    ManyMoments moments;
    EXPECT_EQ(moments.quantile(0.5), Value::not_measured("not there in any moment"));
    for (const Value& value : {Value(130.0), Value(140.0), Value(150.0), Value::at_least(200.0)})
        moments.add(value);
    EXPECT_EQ(moments.quantile(0.0), Value(130.0));
    EXPECT_EQ(moments.quantile(0.5), Value(145.0));
    EXPECT_EQ(moments.quantile(1.0), Value::at_least(200.0));
    EXPECT_EQ(moments.quantile(0.9), Value::at_least(150.0 + 0.7 * 50.0)) << "of type 7: 0.7 of the way from the third to the fourth";
    EXPECT_FALSE(moments.mean().measured());
    moments.add(Value::not_measured("cut off"));
    EXPECT_EQ(moments.account(), "4 moments, 1 left out: cut off");
}

TEST(ManyMoments, BoundsAmongTheNumbersRankWhereTheyMayLie) {
    ManyMoments moments; // the first may be anything from 20 up
    for (const Value& value : {Value::at_least(20.0), Value(30.0), Value(40.0)})
        moments.add(value);
    EXPECT_EQ(moments.quantile(0.0), Value::at_least(20.0));
    EXPECT_EQ(moments.quantile(0.5), Value::at_least(30.0));
    EXPECT_EQ(moments.quantile(1.0), Value::at_least(40.0));
    moments.add(Value::at_most(35.0));
    EXPECT_EQ(moments.quantile(1.0), Value::at_least(40.0));
    EXPECT_EQ(moments.quantile(0.0), Value::at_most(30.0));
    EXPECT_EQ(moments.quantile(2.0 / 3.0), Value::not_measured("between 30 and 40"));
}

TEST(ManyMoments, MeansNeedNumbers) {
    ManyMoments moments;
    for (const double value : {1.0, 2.0, 6.0})
        moments.add(value);
    EXPECT_EQ(moments.mean(), Value(3.0));
    EXPECT_NEAR(*moments.standard_deviation().number(), std::sqrt(7.0), 1e-12);
    ManyMoments cut;
    cut.add(Value::not_measured("cut off"));
    EXPECT_EQ(cut.quantile(0.5), Value::not_measured("cut off in every moment"));
}

} // namespace
} // namespace fernlicht
