// Which rows an area of the beam meets, listed by hand from the two tables.
#include "metrics/regulation/fmvss108_adaptive.h"

#include "metrics/regulation/row_check.h"
#include "scenarios/values/errors.h"
#include "tests/lamps.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre;

std::vector<std::string> ids_of(const Regulation& r, const std::string& beginning) {
    std::vector<std::string> ids;
    for (const RegulationRow& row : r.rows)
        if (row.id.starts_with(beginning))
            ids.push_back(row.id.substr(beginning.size()));
    return ids;
}

const RegulationRow& row_named(const Regulation& r, const std::string& id) {
    return *std::find_if(r.rows.begin(), r.rows.end(), [&](const RegulationRow& row) { return row.id == id; });
}

TEST(AdaptiveInTheLaboratory, ItsAreasMeetTheRowsOfTheirTables) {
    const Regulation r = fmvss108_adaptive({-5.0, -1.0, -1.0, 2.0}, "fmvss108-lb2v-vol", "fmvss108-ub2");
    EXPECT_THAT(ids_of(r, "dimmed "), ElementsAre("2U-4L", "1U, 1.5L to L", "0.5U, 1.5L to L", "H-4L", "0.86D-3.5L"));
    const RegulationRow& line = row_named(r, "dimmed 1U, 1.5L to L");
    EXPECT_THAT(line.places, ElementsAre(Direction{-5.0, 1.0}, Direction{-1.5, 1.0})) << "cut at 5 L";
    EXPECT_EQ(line.limits.max_cd, 700.0);
    // Within a degree of the area, or on the border of that, lie 2U-V, 1U-3L, H-V, H-3L, H-6L and 1.5D-V.
    EXPECT_THAT(ids_of(r, "undimmed "), ElementsAre("1U-3R", "H-3R", "H-6R", "H-9L", "H-9R", "H-12L", "H-12R", "1.5D-9L", "1.5D-9R",
                                                    "2.5D-V", "2.5D-12L", "2.5D-12R", "4D-V"));
    const RegulationRow& transition = row_named(r, "transition zone");
    EXPECT_EQ(transition.limits.max_cd, 75000.0);
    EXPECT_THAT(transition.places,
                ElementsAre(Direction{-6, -2}, Direction{0, -2}, Direction{0, 3}, Direction{-6, 3}, Direction{-6, -2}, Direction{-5, -1},
                            Direction{-5, 2}, Direction{-1, 2}, Direction{-1, -1}, Direction{-5, -1}));
    EXPECT_EQ(r.sureness, Sureness::two_prints);
}

TEST(AdaptiveInTheLaboratory, TheZoneHighUpIsCutToAnAreaThatReachesThere) {
    const Regulation r = fmvss108_adaptive({-2.0, 2.0, 5.0, 15.0}, "fmvss108-lb2m", "fmvss108-ub1");
    EXPECT_THAT(row_named(r, "dimmed 10U-90U, 90L-90R").places,
                ElementsAre(Direction{-2, 10}, Direction{2, 10}, Direction{2, 15}, Direction{-2, 15}));
    EXPECT_THAT(ids_of(r, "undimmed "), testing::Contains("H-V"));
    EXPECT_EQ(row_named(r, "transition zone").limits.max_cd, 70000.0);
}

TEST(AdaptiveInTheLaboratory, TheGreatestIntensityOfTheTransitionZoneHoldsInItAlone) {
    const Regulation r = fmvss108_adaptive({-5.0, -1.0, -1.0, 2.0}, "fmvss108-lb2v-vol", "fmvss108-ub2");
    const auto verdict = [&](double spot_h_deg) {
        const CandelaTable beam = tests::table_of(tests::steps(-12, 12, 0.5), tests::steps(-6, 6, 0.5), [&](double h, double v) {
            return std::hypot(h - spot_h_deg, v - 0.5) < 0.6 ? 90000.0 : 1000.0;
        });
        return check_rows(r, {{&beam, {}}}, {"transition zone"}).front().verdict;
    };
    EXPECT_EQ(verdict(-3.0), RowVerdict::pass) << "in the dimmed area, which has limits of its own";
    EXPECT_EQ(verdict(-5.5), RowVerdict::fail);
    EXPECT_EQ(verdict(-0.5), RowVerdict::fail);
    EXPECT_EQ(verdict(1.5), RowVerdict::pass) << "undimmed";
}

TEST(AdaptiveInTheLaboratory, RefusesTablesInTheWrongPlace) {
    EXPECT_THROW(fmvss108_adaptive({-5, -1, -1, 2}, "fmvss108-ub2", "fmvss108-lb2v-vol"), InputError);
    EXPECT_THROW(fmvss108_adaptive({-5, -1, -1, 2}, "r149-c", "fmvss108-ub2"), InputError);
}

TEST(SparingState, DarkensThePixelsThatMeetTheOther) {
    PixelRaster raster{.columns = 40, .rows = 1, .field = {-20, 20, -5, 5}, .cd = std::vector<double>(40, 1000.0)};
    PixelParts parts;
    parts.raster.push_back(raster);
    const PixelLamp lamp(std::move(parts));
    OtherUser other{.ahead_m = 50.0, .left_m = 3.5};
    const LampPlace from{.position_m = {0.0, 0.45, 0.65}};
    // atan((3.5 +- 0.9 - 0.45) / 50): 4.517 and 2.462 degrees to the left.
    const auto state = sparing_state(lamp, other, from, 0.0);
    ASSERT_TRUE(state);
    EXPECT_NEAR(state->spared.left_deg, -4.5169, 1e-3);
    EXPECT_NEAR(state->spared.right_deg, -2.4622, 1e-3);
    EXPECT_EQ(std::count(state->levels.begin(), state->levels.end(), 0.0F), 3); // -5 to -2
    EXPECT_EQ(state->levels[15], 0.0F);
    EXPECT_EQ(state->levels[18], 1.0F);
    const auto wider = sparing_state(lamp, other, from, 0.7); // -5.217 to -1.762
    EXPECT_EQ(std::count(wider->levels.begin(), wider->levels.end(), 0.0F), 5);
    EXPECT_EQ(wider->spared, state->spared) << "the margin belongs to the transition";
    other.left_m = 60.0;
    EXPECT_FALSE(sparing_state(lamp, other, from, 0.7)) << "beside the beam";
    other.ahead_m = -1.0;
    EXPECT_FALSE(sparing_state(lamp, other, from, 0.7)) << "behind the lamp";
}

} // namespace
} // namespace fernlicht
