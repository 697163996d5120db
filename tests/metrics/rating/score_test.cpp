#include "metrics/rating/path_circle.h"
#include "metrics/rating/score.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

const std::vector<std::pair<double, double>> by_reach{{60.0, 0.0}, {80.0, 4.0}, {100.0, 10.0}};

TEST(RatingPoints, RunLinearlyBetweenPairsAndStayLevelBeyond) {
    for (const auto& [reach_m, points] :
         std::initializer_list<std::pair<double, double>>{{10.0, 0.0}, {60.0, 0.0}, {70.0, 2.0}, {95.0, 8.5}, {100.0, 10.0}, {300.0, 10.0}})
        EXPECT_EQ(points_at(by_reach, reach_m).number(), points) << reach_m;
}

TEST(RatingPoints, AreABoundOnlyWhereABoundLeavesThemOpen) {
    EXPECT_EQ(points_at(by_reach, Value::at_least(150.0)).number(), 10.0);
    EXPECT_EQ(points_at(by_reach, Value::at_most(50.0)).number(), 0.0);
    EXPECT_FALSE(points_at(by_reach, Value::at_least(90.0)).measured());
    EXPECT_EQ(points_at(by_reach, Value::not_measured("dark")).reason(), "dark");
}

TEST(RatingScore, AddsWeightedPointsUpToTheCapOfAFailedRow) {
    using enum RatingVerdict;
    std::vector<ScoredRow> rows{
        {"reach", within, 6.0, 10.0, 2.0, {}}, {"glare", within, 5.0, 5.0, 1.0, 8.0}, {"sheet", told, {}, 0.0, 1.0, {}}};
    const std::vector<Grade> grades{{"poor", 0.0}, {"marginal", 5.0}, {"good", 15.0}};
    Score whole = score(rows, grades);
    EXPECT_EQ(whole.points.number(), 17.0); // 2 x 6 + 5
    EXPECT_EQ(whole.most, 25.0);
    EXPECT_EQ(whole.grade, "good");
    EXPECT_EQ(whole.capped_by, "");
    rows[1].verdict = exceeded;
    rows[1].points = 0.0;
    whole = score(rows, grades);
    EXPECT_EQ(whole.points.number(), 8.0);
    EXPECT_EQ(whole.capped_by, "glare");
    EXPECT_EQ(whole.grade, "marginal");
    rows[1].verdict = not_measured;
    EXPECT_FALSE(score(rows, grades).points.measured()) << "the row might cap";
    EXPECT_EQ(score({rows[2]}, grades).most, 0.0);
}

TEST(PathCircle, FindsRadiusSideAndWhatStraysFromIt) {
    std::vector<glm::dvec2> left, right, line;
    for (int i = 0; i <= 20; ++i) {
        const double angle = 0.03 * i;
        left.emplace_back(1000.0 + 100.0 * std::sin(angle), 50.0 + 100.0 * (1.0 - std::cos(angle)));
        right.emplace_back(230.0 * std::sin(angle), 230.0 * (std::cos(angle) - 1.0));
        line.emplace_back(3.0 * i, 4.0 * i);
    }
    EXPECT_NEAR(path_circle(left)->radius_m, 100.0, 1e-6);
    EXPECT_NEAR(path_circle(left)->arc_rad, 0.6, 1e-9);
    EXPECT_NEAR(off_circle_m(left, 100.0), 0.0, 1e-9);
    // a chord of 200 sin 0.3 m: sagittas of 100 (1 - cos 0.3) m and, on 120 m, of 120 - sqrt(120^2 - (100 sin 0.3)^2) m
    const double half_m = 100.0 * std::sin(0.3);
    EXPECT_NEAR(off_circle_m(left, 120.0), 100.0 * (1.0 - std::cos(0.3)) - (120.0 - std::sqrt(120.0 * 120.0 - half_m * half_m)), 1e-6);
    EXPECT_NEAR(path_circle(right)->radius_m, -230.0, 1e-6);
    EXPECT_NEAR(off_circle_m(right, -230.0), 0.0, 1e-9);
    EXPECT_TRUE(std::isinf(path_circle(line)->radius_m));
    left[5] += 0.7 * glm::dvec2(-std::sin(0.15), std::cos(0.15)); // towards the centre
    EXPECT_NEAR(off_circle_m(left, 100.0), 0.7, 1e-6);
    EXPECT_EQ(path_circle({{0.0, 0.0}, {1.0, 0.0}}), std::nullopt);
}

} // namespace
} // namespace fernlicht
