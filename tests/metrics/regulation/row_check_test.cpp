// What a row's verdict, margin and reason say, on lamps that are worked out by hand.
#include "metrics/regulation/regulation_check.h"
#include "metrics/regulation/rows.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

CandelaTable constant(double cd, double h_deg = 60.0, double v_deg = 30.0) {
    CandelaTable t;
    t.h_deg = {-h_deg, 0.0, h_deg};
    t.v_deg = {-v_deg, 0.0, v_deg};
    t.cd.assign(9, cd);
    return t;
}

Regulation table_of(std::vector<RegulationRow> rows) {
    Regulation r;
    r.id = "test";
    r.receiver = un_receiver;
    r.rows = std::move(rows);
    return r;
}

RowResult only_row(const RegulationRow& row, const CandelaTable& lamp, double re_aim_deg = 0.0) {
    Regulation r = table_of({row});
    r.row_re_aim_deg = re_aim_deg;
    return check_rows(r, {{&lamp, {}}}).front();
}

TEST(RowCheck, MarginIsRelativeToTheNearerLimit) {
    const CandelaTable t = constant(1000.0);
    EXPECT_NEAR(only_row(point("a", 1, 1, at_least(800)), t).margin, 0.25, 1e-12);
    EXPECT_NEAR(only_row(point("a", 1, 1, at_most(800)), t).margin, -0.25, 1e-12);
    EXPECT_NEAR(only_row(point("a", 1, 1, between(800, 1100)), t).margin, 1.0 - 1000.0 / 1100.0, 1e-12);
    EXPECT_NEAR(only_row(sum_of("a", {{0, 0}, {1, 1}, {2, 2}}, at_least(6000)), t).margin, -0.5, 1e-12);
    EXPECT_EQ(only_row(point("a", 1, 1, between(1000, 1000)), t).verdict, RowVerdict::pass); // exactly at both limits
    EXPECT_EQ(only_row(zone("a", zone_3, at_most(1000)), t).verdict, RowVerdict::pass);
    EXPECT_EQ(only_row(zone("a", zone_3, at_most(999.99)), t).verdict, RowVerdict::fail);
}

TEST(RowCheck, NoDataIsNoDarkness) {
    const CandelaTable t = constant(1000.0, 10.0, 5.0);
    const RowResult least = only_row(segment("a", -14, -9, -1.07, at_least(850)), t);
    EXPECT_EQ(least.verdict, RowVerdict::not_measured);
    EXPECT_THAT(least.reason, HasSubstr("reaches beyond the file's angles"));
    EXPECT_EQ(only_row(point("a", 15, 0, at_least(1)), t).reason, "outside the file's angles");
    EXPECT_EQ(only_row(sum_of("a", {{0, 0}, {15, 0}}, at_least(1)), t).verdict, RowVerdict::not_measured);
    const RowResult most = only_row(segment("a", -14, -9, -1.07, at_most(2000)), t);
    EXPECT_EQ(most.verdict, RowVerdict::pass);
    EXPECT_THAT(most.note, HasSubstr("judged by what is inside"));
    EXPECT_EQ(only_row(point("a", 15, 0, at_most(350)), t).verdict, RowVerdict::not_measured);
    EXPECT_EQ(verdict_of({least, most}), RowVerdict::not_measured);
    const RowResult broken = only_row(point("a", 1, 0, at_most(350)), t);
    EXPECT_EQ(verdict_of({least, broken}), RowVerdict::fail);
}

// 0.8 x 1000 = 800 cd asked at a row that has 1000; at a lamp without light there is no ratio.
TEST(RowCheck, RatiosReferToWhatWasFound) {
    const Regulation r = table_of({brightest("Imax", everywhere, {}), at_least_of(point("HV", 0, 0, {}), "Imax", 0.8),
                                   at_most_of(zone("low", rectangle(-1, 1, -2, -1), {}), "HV", 2.0)});
    const CandelaTable lit = constant(1000.0), dark = constant(0.0);
    const std::vector<RowResult> rows = check_rows(r, {{&lit, {}}});
    EXPECT_NEAR(rows[1].limits.min_cd, 800.0, 1e-9);
    EXPECT_NEAR(rows[1].margin, 0.25, 1e-9);
    EXPECT_NEAR(rows[2].limits.max_cd, 2000.0, 1e-9);
    EXPECT_NEAR(rows[2].margin, 0.5, 1e-9);
    EXPECT_EQ(check_rows(r, {{&dark, {}}})[1].reason, "Imax is 0 cd");
}

// A ramp of 1000 cd a degree: 0.25 degrees of re-aim are worth 250 cd, of which the least that passes is taken.
TEST(RowCheck, ARowMayBeMeasuredOffItsPlaceWhereTheTableSaysSo) {
    CandelaTable t = constant(0.0);
    for (std::size_t v = 0; v < 3; ++v)
        t.at(v, 0) = 0.0, t.at(v, 1) = 60000.0, t.at(v, 2) = 120000.0;
    const RegulationRow row = point("a", 3, 0, at_least(63200)); // 63 000 cd there
    EXPECT_EQ(only_row(row, t).verdict, RowVerdict::fail);
    const RowResult turned = only_row(row, t, 0.25);
    EXPECT_EQ(turned.verdict, RowVerdict::pass);
    EXPECT_NEAR(turned.re_aimed.h_deg, 0.2, 1e-9);
    EXPECT_NEAR(turned.found, 63200.0, 1e-6);
    EXPECT_EQ(only_row(point("a", 3, 0, at_least(63300)), t, 0.25).verdict, RowVerdict::fail);
    EXPECT_EQ(only_row(point("a", 3, 0, at_least(62900)), t, 0.25).re_aimed, Direction{}); // passes where it belongs
}

TEST(RowCheck, TwoLampsAreHalvedAndEachHeldToItsOwnRows) {
    const Regulation r = table_of({point("both", 0, 0, at_least(1400)), scoped(point("each", 0, 0, at_least(1200)), Scope::each_side),
                                   scoped(point("either", 0, 0, at_least(1900)), Scope::either_side),
                                   scoped(point("of two", 0, 0, at_least(900)), Scope::each_of_two)});
    const CandelaTable a = constant(1000.0), b = constant(2000.0);
    const std::vector<RowResult> rows = check_rows(r, {{&a, {}}, {&b, {}}});
    EXPECT_NEAR(rows[0].found, 1500.0, 1e-9);
    EXPECT_EQ(rows[1].verdict, RowVerdict::fail);
    EXPECT_THAT(rows[1].lamps, testing::ElementsAre(0));
    EXPECT_EQ(rows[2].verdict, RowVerdict::pass);
    EXPECT_THAT(rows[2].lamps, testing::ElementsAre(1));
    EXPECT_NEAR(rows[3].found, 1000.0, 1e-9);
    EXPECT_EQ(check_rows(r, {{&b, {}}}).size(), 3u); // no row of two lamps
}

TEST(RegulationCheck, ReAimKeepsWithinTheAllowanceAndSaysSo) {
    // A lamp that is lit right of 0.6 R: turned to the left by 0.6 or more it lights HV. Allowed are 0.75 of R149, not the 0.5 of R112.
    CandelaTable t;
    for (int i = -100; i <= 100; ++i)
        t.h_deg.push_back(i * 0.1);
    t.v_deg = {-5, 0, 5};
    for (int j = 0; j < 3; ++j)
        for (const double h : t.h_deg)
            t.cd.push_back(h > 0.55 ? 5000.0 : 100.0);
    Regulation r = table_of({point("HV", 0, 0, at_least(4000)), point("dark", -1, 0, at_most(200))});
    r.aim = AimRule::maximum; // its middle would put the light on HV at once: as-is is asked below by a rule that finds nothing
    r.re_aim = {0.75, 0.75, 0.25};
    const CheckOptions by_edge{.aim = AimRule::cut_off};
    const RegulationCheck turned = check_regulation(r, {t}, by_edge);
    EXPECT_TRUE(turned.was_re_aimed);
    EXPECT_LE(turned.re_aimed.h_deg, -0.5);
    EXPECT_GE(turned.re_aimed.h_deg, -0.75);
    r.re_aim = {0.5, 0.75, 0.25};
    EXPECT_FALSE(check_regulation(r, {t}, by_edge).was_re_aimed);
    r.re_aim = {0.75, 0.75, 0.25};
    EXPECT_FALSE(check_regulation(r, {t}, {.aim = AimRule::cut_off, .re_aim = false}).was_re_aimed);
}

TEST(Regulations, AreWellFormed) {
    EXPECT_EQ(regulation_ids().size(), 60u);
    for (const Regulation& r : regulations()) {
        EXPECT_FALSE(r.title.empty() || r.edition.empty() || r.source.empty() || r.rows.empty()) << r.id;
        std::vector<std::string> ids;
        for (const RegulationRow& row : r.rows) {
            ids.push_back(row.id);
            EXPECT_LE(row.limits.min_cd, row.limits.max_cd) << r.id << row.id;
            EXPECT_TRUE(row.limits.min_cd > 0.0 || !std::isinf(row.limits.max_cd) || !row.ratio_of.empty()) << r.id << row.id;
            const auto referred = [&](const RegulationRow& other) { return other.id == row.ratio_of; };
            EXPECT_TRUE(row.ratio_of.empty() || std::any_of(r.rows.begin(), r.rows.end(), referred)) << row.id;
        }
        std::sort(ids.begin(), ids.end());
        EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end()) << r.id; // a row is named once
    }
    EXPECT_THROW(regulation("r149"), InputError);
}

// Spot checks against the texts' transcriptions, digit by digit.
TEST(Regulations, HaveTheDigitsOfTheirTexts) {
    const auto row = [](const std::string& id, const std::string& name) {
        const Regulation& r = regulation(id);
        return *std::find_if(r.rows.begin(), r.rows.end(), [&](const RegulationRow& one) { return one.id == name; });
    };
    EXPECT_EQ(row("r149-c", "75R").limits.min_cd, 12100.0);
    EXPECT_EQ(row("r149-v", "segment 10 and below").ratio_of, "25V"); // corrected by WP.29/1166
    EXPECT_EQ(row("r112-b", "75R").limits.min_cd, 10100.0);
    EXPECT_EQ(row("r112-a", "zone I").limits.max_cd, 17600.0);
    EXPECT_EQ(row("r98-d", "Imax R").limits.max_cd, 43800.0);
    EXPECT_EQ(row("r123-w", "Imax").limits.min_cd, 29530.0);
    EXPECT_EQ(row("r123-e3", "B50L").limits.max_cd, 350.0);
    EXPECT_EQ(row("r123-c-bending-left", "turn to the left").limits.min_cd, 2500.0);
    EXPECT_EQ(row("r123-adb-oncoming-50m", "line 1").limits.max_cd, 625.0);
    EXPECT_EQ(row("fmvss108-lb3m", "0.5D-1.5R").limits.min_cd, 8000.0);
    EXPECT_EQ(row("fmvss108-lb4v-vol", "2.5D-12L").limits.min_cd, 1000.0);
    EXPECT_EQ(row("fmvss108-ub2", "4D-V").limits.max_cd, 12000.0);
}

/// Every twelfth file with every seventh table, 3 s; all files with all tables where FERNLICHT_EVERY_LAMP is set, some minutes.
TEST(Regulations, GoThroughLampFilesOfOthers) {
    const std::filesystem::path folder = std::filesystem::path(FERNLICHT_SHARED_DATA) / "lamps";
    if (!std::filesystem::is_directory(folder))
        GTEST_SKIP() << "no " << folder;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".ies" || entry.path().extension() == ".IES" || entry.path().extension() == ".ldt")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::size_t read = 0;
    const bool every = std::getenv("FERNLICHT_EVERY_LAMP") != nullptr;
    for (std::size_t i = 0; i < files.size(); i += every ? 1 : 12) {
        LampFile lamp;
        try {
            lamp = read_lamp(files[i]);
        } catch (const InputError&) { // some are there to be refused
            continue;
        }
        ++read;
        for (std::size_t k = every ? 0 : i % 7; k < regulations().size(); k += every ? 1 : 7) {
            const RegulationCheck check = check_regulation(regulations()[k], {lamp.table}, {.aim = std::nullopt, .re_aim = false});
            for (const RowResult& row : check.rows) {
                EXPECT_TRUE(std::isfinite(row.found) && std::isfinite(row.margin) && row.found >= 0.0)
                    << files[i] << regulations()[k].id << row.id;
                EXPECT_EQ(row.verdict == RowVerdict::not_measured, !row.reason.empty()) << files[i] << row.id;
            }
        }
    }
    EXPECT_GT(read, 0u);
}

} // namespace
} // namespace fernlicht
