// Changes between a figure and a bound.
#include "metrics/readings/significance.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// Of a reach that goes on beyond the grid nothing is told of the grid's error.
PlayedReadings reaching(const Value& reach) {
    PlayedReadings played;
    const auto put = [&](const char* name, const Value& value) {
        const ReadingKey key = key_of(name).value();
        played.readings[key] = {key, value};
    };
    put("reach_1lx_target_own_m", reach);
    if (reach.number()) {
        put("reach_1lx_target_own_grid_error_m", 0.3);
        put("reach_1lx_target_own_twin_difference_m", 0.1);
        put("reach_1lx_target_own_per_tenth_degree_m", 4.0);
    }
    return played;
}

ReadingChange change(const Value& now, const Value& before) {
    return change_of_reading(key_of("reach_1lx_target_own_m").value(), reaching(now), reaching(before));
}

TEST(Significance, ABoundIsExactAsABound) {
    for (const auto& [now, before] : {std::pair{Value::at_least(200.0), Value(56.9)}, std::pair{Value(56.9), Value::at_least(200.0)}}) {
        const ReadingChange found = change(now, before);
        EXPECT_EQ(found.kind, ChangeKind::real) << found.why_not;
        EXPECT_DOUBLE_EQ(found.uncertainty.value(), 0.4) << "that of the figure alone";
        EXPECT_NEAR(found.least(), 143.1, 1e-9);
    }
    EXPECT_EQ(change(Value::at_least(200.0), 199.9).kind, ChangeKind::unknown) << "it may be much more";
    EXPECT_EQ(change(Value::at_least(200.0), Value::at_least(200.0)).why_not, "both beyond 200 m");
}

} // namespace
} // namespace fernlicht
