// What a change of a beam is made of and what limits it, against differences and small cases worked out by hand.
#include "metrics/improve/beam_limits.h"
#include "tests/lamps.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace fernlicht {
namespace {

/// A beam with a slope in both angles, in samples finer than the knots.
CandelaTable sloping_table() {
    return tests::table_of(tests::steps(-4.0, 4.0, 0.2), tests::steps(-2.0, 2.0, 0.1),
                           [](double h, double v) { return 1000.0 + 100.0 * h - 200.0 * v; });
}

std::vector<double> drawn_change(std::size_t count, double size, std::uint64_t seed = 1) {
    std::mt19937_64 generator(seed);
    std::vector<double> x(count);
    for (double& one : x)
        one = size * (2.0 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1.0);
    return x;
}

TEST(BeamBasis, ChangesLightByAShareOfWhatIsThereBetweenItsKnots) {
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    ASSERT_EQ(basis.size(), 4U * 4U); // knots at H -1, -0.6 ... 1 and V -0.5, -0.3 ... 0.5, without the border
    std::vector<double> x(basis.size());
    x[5] = 0.5;
    const Direction knot = basis.knot(5);
    EXPECT_NEAR(knot.h_deg, -0.2, 1e-12);
    EXPECT_NEAR(knot.v_deg, -0.1, 1e-12);
    const CandelaTable changed = basis.changed(x);
    const auto change = [&](double h, double v) {
        return (intensity_cd(changed, h, v) - intensity_cd(table, h, v)) / (intensity_cd(table, h, v) + 50.0);
    };
    EXPECT_NEAR(change(-0.2, -0.1), 0.5, 1e-12);
    EXPECT_NEAR(change(0.0, -0.1), 0.25, 1e-12); // half of the way to the next knot
    EXPECT_NEAR(change(0.0, 0.0), 0.125, 1e-12);
    EXPECT_NEAR(change(0.2, -0.1), 0.0, 1e-12);
    x[5] = -2.0; // more than all
    EXPECT_NEAR(intensity_cd(basis.changed(x), -0.2, -0.1), 0.0, 1e-12);
}

TEST(BeamBasis, FollowsFiguresOfTheTable) {
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    const std::vector<double> x = drawn_change(basis.size(), 0.3);
    const CandelaTable changed = basis.changed(x);
    for (const Direction to : {Direction{0.13, -0.21}, Direction{-0.97, 0.44}}) {
        for (const Receiver& receiver : {Receiver{Receiver::Shape::square, 0.149}, Receiver{Receiver::Shape::disc, 0.5}, Receiver{}}) {
            const std::vector<SampleWeight> weights = received_weights(table, receiver, to);
            double sum = 0.0;
            for (const SampleWeight& one : weights)
                sum += one.weight * table.cd[one.sample];
            EXPECT_NEAR(sum, *received_cd(table, receiver, to), 1e-9 * sum);
            EXPECT_NEAR(value_of(basis.form(weights), x), *received_cd(changed, receiver, to) - sum, 1e-9 * sum);
        }
    }
    EXPECT_TRUE(basis.form(received_weights(table, {Receiver::Shape::square, 0.149}, {3.0, 1.5})).empty());
    EXPECT_TRUE(received_weights(table, {}, {5.0, 0.0}).empty());
}

/// x H x / 2.
double half_square(const BeamBasis& basis, double length_h_deg, double length_v_deg, const std::vector<double>& x) {
    double sum = 0.0;
    for (const auto& [row, column, value] : basis.size_and_bends(length_h_deg, length_v_deg))
        sum += (row == column ? 0.5 : 1.0) * value * x[row] * x[column];
    return sum;
}

TEST(BeamBasis, CountsSizeAndBends) {
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    std::vector<double> x(basis.size());
    x[5] = 0.5;
    const double area = 0.4 * 0.2, bend_h = 0.5 / 0.16, bend_v = 0.5 / 0.04; // second differences 1, -2, 1
    EXPECT_NEAR(half_square(basis, 0.0, 0.0, x), area * 0.25, 1e-12);
    EXPECT_NEAR(half_square(basis, 0.4, 0.0, x), area * (0.25 + std::pow(0.16 * bend_h, 2.0) * 6.0), 1e-12);
    EXPECT_NEAR(half_square(basis, 0.0, 0.3, x), area * (0.25 + std::pow(0.09 * bend_v, 2.0) * 6.0), 1e-12);
    x.assign(basis.size(), 0.0);
    x[0] = 1.0; // beside two borders: the surface bends up from 0 there, too
    EXPECT_NEAR(half_square(basis, 0.4, 0.0, x), area * (1.0 + 6.0), 1e-12);
}

TEST(BeamBasis, TakesTheKnotsThatATableHas) {
    const CandelaTable coarse =
        tests::table_of(tests::steps(-6.0, 6.0, 1.5), {-3.0, -1.0, -0.9, -0.8, 1.0, 3.0}, [](double, double) { return 1.0; });
    const BeamBasis basis(coarse, {-2.0, 2.0, -0.9, 0.0}, 0.5, 0.25, 1.0);
    ASSERT_EQ(basis.size(), 3U * 1U); // H -3, -1.5 ... 3; V -0.9, 1, 3
    EXPECT_EQ(basis.knot(0).h_deg, -1.5);
    EXPECT_EQ(basis.knot(0).v_deg, 1.0);
    EXPECT_TRUE(BeamBasis(tests::even_table(5.0), {-1, 1, -1, 1}, 0.5, 0.25, 1.0).at_sample(0).empty());
}

/// The rows of one name with the least and the most that any of them may be.
std::vector<LinearRow> rows_of(const std::vector<LimitRow>& all, const std::string& of) {
    std::vector<LinearRow> rows;
    for (const LimitRow& limit : all)
        if (limit.of == of)
            rows.push_back(limit.row);
    return rows;
}

TEST(TableLimits, AreWhatTheChangedTableSays) {
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    const std::vector<double> none(basis.size()), x = drawn_change(basis.size(), 0.3);
    const CandelaTable changed = basis.changed(x);
    // 9 x 9 samples lie within the border. Those beside it change by half of what a knot does.
    EXPECT_TRUE(table_rows(basis, {}, {none, 0.5}).empty()); // half of it: no sample comes near to 0
    EXPECT_EQ(rows_of(table_rows(basis, {}, {none, 1.5}), "no light less than none").size(), 49U);
    const auto by_share =
        rows_of(table_rows(basis, {.change_share = 0.1, .change_cd = 80.0}, {none, 0.5}), "the most that a sample may change");
    ASSERT_EQ(by_share.size(), 81U);
    for (const LinearRow& row : by_share) {
        EXPECT_LE(row.high, 80.0 / (800.0 + 50.0) + 1e-12);
        EXPECT_EQ(row.low, -row.high);
    }
    const auto flux = rows_of(table_rows(basis, {.flux_share = -0.01}, {none, 0.5}), "flux");
    ASSERT_EQ(flux.size(), 1U);
    EXPECT_NEAR(value_of(flux[0].form, x), 100.0 * (flux_lm(changed) / flux_lm(table) - 1.0), 1e-9);
    EXPECT_NEAR(flux[0].high, -1.0, 1e-12);
    // 200 cd/deg downwards is the steepest; doubled, -400 to 400.
    const auto slopes = rows_of(table_rows(basis, {.steepness = 2.0}, {none, 2.0}), "the steepest place");
    ASSERT_FALSE(slopes.empty());
    for (const LinearRow& row : slopes) {
        EXPECT_NEAR(row.high - row.low, 4.0, 1e-9);
        EXPECT_TRUE(std::abs(row.high - 3.0) < 1e-9 || std::abs(row.high - 1.5) < 1e-9) << row.high; // V falls, H rises half as fast
    }
}

class Rows : public testing::Test {
  protected:
    /// A point that wants more, one that wants less, a sum, and a zone that is dark enough.
    static Regulation regulation() {
        Regulation r{.id = "test", .receiver = {Receiver::Shape::square, 0.149}};
        r.rows = {{"point", RowKind::point, {{0.0, 0.0}}, {900.0, 1100.0}},
                  {"sum", RowKind::sum, {{-0.4, 0.0}, {0.4, 0.0}}, {1500.0, unbounded}},
                  {"zone", RowKind::zone, {{-0.6, 0.1}, {0.6, 0.1}, {0.6, 0.3}, {-0.6, 0.3}}, {0.0, 1050.0}},
                  {"two", RowKind::point, {{0.0, 0.0}}, {900.0, 1100.0}, Scope::each_of_two}};
        return r;
    }
};

TEST_F(Rows, HoldWhatTheCheckFinds) {
    const Regulation r = regulation();
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    RegulationRows rows(r, false, table);
    EXPECT_EQ(rows.before().verdict, RowVerdict::pass);
    EXPECT_EQ(rows.missed_by(rows.before()).by, 0.0);
    const std::vector<double> none(basis.size());
    const auto limits = rows.rows(basis, table, rows.before(), {none, 0.5});
    EXPECT_TRUE(rows_of(limits, "two").empty());
    const auto points = rows_of(limits, "point"), sums = rows_of(limits, "sum"), zone = rows_of(limits, "zone");
    ASSERT_EQ(points.size(), 2U); // at least, at most
    ASSERT_EQ(sums.size(), 1U);
    EXPECT_GT(zone.size(), 3U);
    // In hundredths of the limit, a little inside: 902 cd at 1000.
    EXPECT_NEAR(points[0].low, 100.0 * (901.8 - 1000.0) / 901.8, 1e-6);
    EXPECT_NEAR(points[1].high, 100.0 * (1097.8 - 1000.0) / 1097.8, 1e-6);
    EXPECT_NEAR(sums[0].low, 100.0 * (1503.0 - 2000.0) / 1503.0, 1e-6);
    // What keeps to all rows passes the check; what breaks one may not.
    std::vector<double> x;
    const auto keeps = [&](const std::vector<LimitRow>& all) {
        return std::ranges::all_of(all, [&](const LimitRow& limit) {
            const double value = value_of(limit.row.form, x);
            return value >= limit.row.low - 1e-9 && value <= limit.row.high + 1e-9;
        });
    };
    int kept = 0, broken = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        x = drawn_change(basis.size(), 0.004 * static_cast<double>(seed), seed);
        const RegulationCheck check = rows.check(basis.changed(x));
        if (keeps(limits)) {
            // Where it does not, the worst place that it found is held from now on.
            EXPECT_TRUE(check.verdict == RowVerdict::pass || !keeps(rows.rows(basis, table, rows.before(), {none, 0.5}))) << seed;
            ++kept;
        } else if (check.verdict == RowVerdict::fail) {
            EXPECT_GT(rows.missed_by(check).by, 0.0);
            ++broken;
        }
    }
    EXPECT_GT(kept, 10);
    EXPECT_GT(broken, 10);
}

TEST_F(Rows, LetStandWhatTheBeamBrokeFromTheFirst) {
    Regulation r = regulation();
    r.rows[0].limits = {1200.0, unbounded}; // 1000 cd are there
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    RegulationRows rows(r, false, table);
    EXPECT_EQ(rows.before().verdict, RowVerdict::fail);
    EXPECT_EQ(rows.missed_by(rows.before()).by, 0.0);
    const std::vector<double> none(basis.size());
    const auto points = rows_of(rows.rows(basis, table, rows.before(), {none, 0.5}), "point");
    ASSERT_EQ(points.size(), 1U);
    EXPECT_NEAR(points[0].low, 0.0, 1e-6); // no less than it has
    EXPECT_EQ(rows.missed_by(rows.check(scaled(table, 0.99))).row, "point");
}

TEST_F(Rows, KeepWhatIsToGetNoWorse) {
    const Regulation r = regulation();
    const CandelaTable table = sloping_table();
    const BeamBasis basis(table, {-1.0, 1.0, -0.5, 0.5}, 0.4, 0.2, 50.0);
    RegulationRows rows(r, false, table, {"zone"});
    const std::vector<double> none(basis.size());
    const double most = 1000.0 + 100.0 * 0.6 - 200.0 * 0.1; // of the zone, at its lower right corner
    for (const LinearRow& row : rows_of(rows.rows(basis, table, rows.before(), {none, 0.5}), "zone"))
        EXPECT_LE(row.high, 100.0 * (most - 880.0) / most + 1e-6); // 880 cd at its darkest corner
    EXPECT_EQ(rows.missed_by(rows.before()).by, 0.0);
    EXPECT_EQ(rows.missed_by(rows.check(scaled(table, 1.008))).row, "zone"); // far from the limit itself
    EXPECT_THROW(RegulationRows(r, false, table, {"Zone"}), std::invalid_argument);
}

TEST(RegulationRows, HoldALowBeamsMirrorImageAlike) {
    const CandelaTable table = read_lamp(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/lamps/halogen-low.ies").table,
                       left = mirrored(table);
    RegulationRows right_hand(regulation("r112-b"), false, table), left_hand(regulation("r112-b"), true, left);
    const BeamBasis basis(table, {-3.0, 3.0, -1.5, 1.0}, 0.5, 0.25, 50.0), left_basis(left, {-3.0, 3.0, -1.5, 1.0}, 0.5, 0.25, 50.0);
    const std::vector<double> none(basis.size()), left_none(left_basis.size());
    const auto rows = right_hand.rows(basis, table, right_hand.before(), {none, 1.0});
    const auto left_rows = left_hand.rows(left_basis, left, left_hand.before(), {left_none, 1.0});
    const auto point = rows_of(rows, "75R"), left_point = rows_of(left_rows, "75L");
    ASSERT_EQ(point.size(), 1U);
    ASSERT_EQ(left_point.size(), 1U);
    EXPECT_NEAR(point[0].low, left_point[0].low, 1e-6);
    // A tenth more light everywhere is a tenth more in each row.
    EXPECT_NEAR(value_of(point[0].form, std::vector<double>(basis.size(), 0.1)),
                value_of(left_point[0].form, std::vector<double>(left_basis.size(), 0.1)), 1e-6);
}

} // namespace
} // namespace fernlicht
