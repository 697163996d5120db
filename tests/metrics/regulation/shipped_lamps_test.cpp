// Our own lamps against the rows of their regulations, as docs/regulations.md lists them.
#include "metrics/regulation/regulation_check.h"
#include "scenarios/lamps/lamp_file.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <iostream>
#include <map>

namespace fernlicht {
namespace {

using testing::IsEmpty;
using testing::IsSupersetOf;

const CandelaTable& table(const std::string& name) {
    static std::map<std::string, CandelaTable> tables;
    auto [it, added] = tables.try_emplace(name);
    if (added)
        it->second = read_lamp(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/lamps" / (name + ".ies")).table;
    return it->second;
}

std::vector<std::string> broken(const CandelaTable& lamp, const std::string& id, const CheckOptions& options = {}) {
    std::vector<std::string> names;
    for (const RowResult& row : check_regulation(regulation(id), {lamp}, options).rows)
        if (row.verdict != RowVerdict::pass)
            names.push_back(row.id);
    return names;
}

const RowResult& row(const RegulationCheck& check, const std::string& id) {
    return *std::find_if(check.rows.begin(), check.rows.end(), [&](const RowResult& r) { return r.id == id; });
}

TEST(ShippedLamps, MeetTheRowsTheyAreBuiltTo) {
    for (const auto& [lamp, id] : {std::pair{"halogen-low", "r112-b"},
                                   {"xenon-low", "r98-d"},
                                   {"halogen-high", "r112-driving-b"},
                                   {"xenon-high", "r98-driving-d"}}) {
        const RegulationCheck check = check_regulation(regulation(id), {table(lamp)});
        EXPECT_EQ(check.verdict, RowVerdict::pass) << lamp;
        EXPECT_FALSE(check.was_re_aimed) << lamp; // as first aimed
        for (const RowResult& r : check.rows)
            std::cout << "    " << lamp << " " << r.id << ": " << r.found << " " << r.unit << ", margin " << 100.0 * r.margin << " %\n";
    }
}

// Read off the shipped files by `fernlicht lamp FILE --picture`, and from docs/lamps.md: B50L 248 cd, 75R 26 % above its minimum.
TEST(ShippedLamps, HaveTheMarginsThatAreDocumented) {
    const RegulationCheck halogen = check_regulation(regulation("r112-b"), {table("halogen-low")});
    EXPECT_NEAR(row(halogen, "B50L").margin, 0.29, 0.01);
    EXPECT_NEAR(row(halogen, "75R").margin, 0.265, 0.02);
    const RegulationCheck xenon = check_regulation(regulation("r98-d"), {table("xenon-low")});
    EXPECT_NEAR(row(xenon, "Imax R").margin, 0.07, 0.01);
    EXPECT_NEAR(row(xenon, "Imax L").margin, 0.08, 0.01);
}

TEST(ShippedLamps, AreAimedAsTheyCome) {
    for (const char* lamp : {"halogen-low", "xenon-low"}) {
        const Aim aim = aim_of(table(lamp), AimRule::cut_off);
        EXPECT_TRUE(aim.found);
        EXPECT_NEAR(aim.turned.h_deg, 0.0, 0.05) << lamp;
        EXPECT_NEAR(aim.turned.v_deg, 0.0, 0.03) << lamp;
        EXPECT_NEAR(*aim.cut_off->rise_angle_deg, 15.0, 1.5) << lamp;
    }
}

TEST(ShippedLamps, ThatAreWrongBreakRows) {
    const CandelaTable& low = table("halogen-low");
    const CheckOptions as_is{.aim = AimRule::as_is};
    EXPECT_THAT(broken(low, "r112-b", as_is), IsEmpty());
    EXPECT_THAT(broken(mirrored(low), "r112-b", as_is), IsSupersetOf({"75R", "75L", "50L"}));
    EXPECT_THAT(broken(scaled(low, 0.3), "r112-b"), IsSupersetOf({"75R", "50R", "25L", "25R", "zone IV"}));
    EXPECT_THAT(broken(scaled(low, 1.5), "r112-b"), testing::Contains("B50L"));
    CandelaTable raised = low; // aimed at the horizon in place of 1 % down
    for (double& v : raised.v_deg)
        v += 0.57;
    EXPECT_THAT(broken(raised, "r112-b", as_is), testing::Contains("zone III"));
    EXPECT_THAT(broken(raised, "r112-b"), IsEmpty()); // the procedure brings it down again
}

TEST(ShippedLamps, MirroredMeetTheSameRowsOnTheLeft) {
    for (const auto& [lamp, id] : {std::pair{"halogen-low", "r149-c"}, {"xenon-low", "r98-d"}, {"halogen-low", "r123-c"}}) {
        const RegulationCheck right = check_regulation(regulation(id), {table(lamp)});
        const RegulationCheck left =
            check_regulation(regulation(id), {mirrored(table(lamp))}, {.aim = std::nullopt, .left_hand_traffic = true});
        ASSERT_EQ(right.rows.size(), left.rows.size());
        for (std::size_t i = 0; i < right.rows.size(); ++i) {
            EXPECT_EQ(left.rows[i].id, mirrored_name(right.rows[i].id));
            EXPECT_EQ(left.rows[i].verdict, right.rows[i].verdict);
            EXPECT_EQ(left.rows[i].found, right.rows[i].found) << right.rows[i].id; // to the bit
            EXPECT_EQ(left.rows[i].margin, right.rows[i].margin);
            EXPECT_EQ(left.rows[i].where.h_deg, 0.0 - right.rows[i].where.h_deg);
        }
    }
}

} // namespace
} // namespace fernlicht
