// What a row's verdict, margin and reason say, on lamps that are worked out by hand.
#include "metrics/regulation/regulation_check.h"
#include "metrics/regulation/rows.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/errors.h"
#include "tests/lamps.h"
#include "tests/metrics/regulation/generated_lamp.h"
#include "tests/trial.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <map>
#include <set>

namespace fernlicht {
namespace {

using generated::Lamp;
using testing::HasSubstr, testing::IsEmpty, testing::IsSupersetOf;

CandelaTable constant(double cd, double h_deg = 60.0, double v_deg = 30.0) {
    CandelaTable t{.h_deg = {-h_deg, 0.0, h_deg}, .v_deg = {-v_deg, 0.0, v_deg}};
    t.cd.assign(9, cd);
    return t;
}

Regulation table_of(std::vector<RegulationRow> rows) { return {.id = "test", .receiver = un_receiver, .rows = std::move(rows)}; }

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
    const CandelaTable t =
        tests::table_of(tests::steps(-10.0, 10.0, 0.1), {-5, 0, 5}, [](double h, double) { return h > 0.55 ? 5000.0 : 100.0; });
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
    EXPECT_EQ(regulation_ids().size(), 66u);
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
    for (const auto& [id, name, min_cd] :
         {std::tuple("r149-c", "75R", 12100.0), std::tuple("r112-b", "75R", 10100.0), std::tuple("r123-w", "Imax", 29530.0),
          std::tuple("r123-c-bending-left", "turn to the left", 2500.0), std::tuple("fmvss108-lb3m", "0.5D-1.5R", 8000.0),
          std::tuple("fmvss108-lb4v-vol", "2.5D-12L", 1000.0)})
        EXPECT_EQ(row(id, name).limits.min_cd, min_cd) << id;
    for (const auto& [id, name, max_cd] :
         {std::tuple("r112-a", "zone I", 17600.0), std::tuple("r98-d", "Imax R", 43800.0), std::tuple("r123-e3", "B50L", 350.0),
          std::tuple("r123-adb-oncoming-50m", "line 1", 625.0), std::tuple("r149-adb-oncoming-200m", "line 3", 5450.0),
          std::tuple("r149-adb-preceding-100m", "line 5, beyond 0.5 R", 7000.0), std::tuple("fmvss108-ub2", "4D-V", 12000.0)})
        EXPECT_EQ(row(id, name).limits.max_cd, max_cd) << id;
    EXPECT_EQ(row("r149-v", "segment 10 and below").ratio_of, "25V"); // corrected by WP.29/1166
}

TEST(Regulations, SayOfEachRowHowSureItIs) {
    const CandelaTable even = tests::even_table(600.0);
    const auto known_by = [&](const std::string& id, const std::string& name) {
        return std::string(in_words(check_rows(regulation(id), {{&even, {}}}, {name}).at(0).sureness));
    };
    EXPECT_EQ(known_by("r149-c", "75R"), "two prints, one reader");
    EXPECT_EQ(known_by("r149-c", "P"), "one source");
    EXPECT_EQ(known_by("r112-b", "75R"), "two sources");
    EXPECT_EQ(known_by("r149-driving-b", "H-3L"), "two sources");
    EXPECT_EQ(known_by("r149-driving-b", "Imax"), "one source");
    EXPECT_EQ(known_by("r123-c", "P"), "one source");
    EXPECT_EQ(known_by("r149-adb-oncoming-50m", "line 1"), "inferred, not read");
    const std::vector<RegulationRow>&a = regulation("r149-adb-preceding-50m").rows, &b = regulation("r123-adb-preceding-50m").rows;
    ASSERT_EQ(a.size(), 2u) << "lines alone";
    EXPECT_EQ(b.size(), 7u);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_TRUE(a[i].id == b[i].id && a[i].limits.max_cd == b[i].limits.max_cd && a[i].places == b[i].places) << a[i].id;
}

/// Every twelfth file with every seventh table, 3 s; all files with all tables where FERNLICHT_EVERY_LAMP is set, some minutes.
TEST(Regulations, GoThroughLampFilesOfOthers) {
    const std::filesystem::path folder = std::filesystem::path(FERNLICHT_SHARED_DATA) / "lamps";
    if (!std::filesystem::is_directory(folder))
        GTEST_SKIP() << "no " << folder;
    const auto files = tests::files_below(folder, {".ies", ".IES", ".ldt"});
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

// Every row of every table: a lamp that meets all of them by one part in a hundred passes, and one that is changed at one row's place
// breaks this row, and no other that asks less there.

std::set<std::string> broken(const std::vector<RowResult>& rows) {
    std::set<std::string> ids;
    for (const RowResult& row : rows)
        if (row.verdict == RowVerdict::fail)
            ids.insert(row.id);
    return ids;
}

/// Places of a row at which it can be broken.
std::vector<Direction> places_of(const RegulationRow& row) {
    if (row.kind == RowKind::point || row.kind == RowKind::sum)
        return {row.places.front()};
    std::vector<Direction> places;
    if (row.kind == RowKind::segment) {
        for (int i = 0; i <= 60; ++i) {
            const double share = (i % 2 ? 60 - i : i) / 60.0;
            const Direction a = row.places[0], b = row.places[1];
            places.push_back({a.h_deg + (b.h_deg - a.h_deg) * share, a.v_deg + (b.v_deg - a.v_deg) * share});
        }
    } else
        for (double v = 10.3; v >= -5.0; v -= 0.15)
            for (double h = -20.0; h <= 20.0; h += 0.35)
                if (generated::inside(row.places, {h, v}))
                    places.push_back({h, v});
    std::erase_if(places, [](Direction d) { return std::abs(d.h_deg) > 20.2 || d.v_deg > 10.4 || d.v_deg < -5.0; });
    return places;
}

/// What a change to `cd` at a place breaks, by the rows' own geometry; nullopt: it touches another row in part.
std::optional<std::set<std::string>> expected(const Regulation& r, const Lamp& lamp, Direction at, double cd, bool lower) {
    std::set<std::string> ids;
    for (const RegulationRow& row : r.rows) {
        if (!lower && !row.ratio_of.empty() && row.ratio_is_minimum && row.ratio * cd > generated::above * *lamp.minimum(row))
            ids.insert(row.id); // a new maximum asks more of HV
        if (row.scope == Scope::each_of_two || !lamp.reaches(row, at))
            continue;
        const auto min = lamp.minimum(row), max = lamp.maximum(row);
        bool breaks = lower ? row.kind != RowKind::brightest && row.kind != RowKind::sum && min && cd < *min : max && cd > *max;
        if (row.kind == RowKind::sum && lower) // two places keep their share
            breaks = min && cd + generated::above * *min * 2.0 / 3.0 < *min;
        if (!breaks)
            continue;
        if (!generated::concerns(row, at, 1e-9, 1e-9))
            return std::nullopt;
        ids.insert(row.id);
    }
    return ids;
}

/// The place where a change breaks fewest rows.
std::optional<std::pair<Direction, std::set<std::string>>> best_place(const Regulation& r, const Lamp& lamp, const RegulationRow& row,
                                                                      double cd, bool lower) {
    std::optional<std::pair<Direction, std::set<std::string>>> best;
    for (const Direction at : places_of(row)) {
        const auto ids = expected(r, lamp, at, cd, lower);
        if (ids && ids->contains(row.id) && (!best || ids->size() < best->second.size()))
            best.emplace(at, *ids);
        if (best && best->second.size() == 1)
            break;
    }
    return best;
}

class EveryRow : public testing::TestWithParam<std::string> {};

TEST_P(EveryRow, IsBrokenAtItsPlaceAlone) {
    Regulation r = regulation(GetParam());
    r.row_re_aim_deg = 0.0; // tried by itself below
    const Lamp lamp(r);
    const auto check = [&](const CandelaTable& table) { return check_rows(r, {{&table, {}}}); };
    const std::vector<RowResult> base = check(lamp.table);
    for (const RowResult& row : base)
        EXPECT_EQ(row.verdict, RowVerdict::pass) << row.id << " " << row.found << " " << row.margin << " " << row.reason;
    for (const RegulationRow& row : r.rows) {
        if (row.scope == Scope::each_of_two)
            continue;
        for (const bool lower : {true, false}) {
            const auto limit = lower ? lamp.minimum(row) : lamp.maximum(row);
            if (!limit)
                continue;
            if (lower && row.kind == RowKind::brightest) { // dark everywhere: this row among others
                CandelaTable dim = lamp.table;
                for (double& cd : dim.cd)
                    cd = std::min(cd, generated::just_below * *limit);
                EXPECT_THAT(broken(check(dim)), testing::Contains(row.id));
                continue;
            }
            const double cd = row.kind == RowKind::sum ? generated::just_below * *limit - generated::above * *limit * 2.0 / 3.0
                                                       : (lower ? generated::just_below : generated::just_above) * *limit;
            const auto place = best_place(r, lamp, row, cd, lower);
            ASSERT_TRUE(place) << r.id << " " << row.id << (lower ? " min" : " max");
            const CandelaTable changed = lamp.changed(place->first, cd, lower);
            std::vector<std::string> near; // no other row sees the change
            for (const RegulationRow& other : r.rows)
                if (lamp.reaches(other, place->first) || !other.ratio_of.empty())
                    near.push_back(other.id);
            EXPECT_EQ(broken(check_rows(r, {{&changed, {}}}, near)), place->second)
                << r.id << " " << row.id << " at " << place->first.h_deg << ", " << place->first.v_deg << (lower ? " min" : " max");
            EXPECT_LE(place->second.size(), 2u) << r.id << " " << row.id; // two where another row holds there by the same limit or a ratio
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Tables, EveryRow, testing::ValuesIn(regulation_ids()), [](const testing::TestParamInfo<std::string>& table) {
    std::string name = table.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

// Our own lamps against the rows of their regulations, as docs/regulations.md lists them.

const CandelaTable& table(const std::string& name) {
    static std::map<std::string, CandelaTable> tables;
    auto [it, added] = tables.try_emplace(name);
    if (added)
        it->second = read_lamp(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/lamps" /
                               (name.ends_with(".yaml") ? name : name + ".ies"))
                         .table;
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

TEST(ShippedLamps, MeetTheRowsTheyAreBuiltToWithTheMarginsThatAreDocumented) {
    for (const auto& [lamp, id] : {std::pair{"halogen-low", "r112-b"},
                                   {"xenon-low", "r98-d"},
                                   {"halogen-high", "r112-driving-b"},
                                   {"xenon-high", "r98-driving-d"},
                                   {"led-low", "r149-c"},
                                   {"led-high", "r149-driving-b"},
                                   {"matrix-84.yaml", "r149-driving-b"},
                                   {"pixels-16384.yaml", "r149-driving-b"}}) {
        const RegulationCheck check = check_regulation(regulation(id), {table(lamp)});
        EXPECT_EQ(check.verdict, RowVerdict::pass) << lamp;
        EXPECT_FALSE(check.was_re_aimed) << lamp; // as first aimed
        EXPECT_EQ(check_regulation(regulation(id), {table(lamp)}, {.aim = AimRule::automatic}).verdict, RowVerdict::pass) << lamp;
    }
    EXPECT_TRUE(broken(sum(table("led-high"), table("laser-spot")), "r149-driving-b").empty()) << "the booster beside its high beam";
    // Read off the shipped files by `fernlicht lamp FILE --picture`, and from docs/lamps.md: B50L 248 cd, 75R 26 % above its minimum.
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
    EXPECT_THAT(broken(low, "r112-b", as_is), testing::ElementsAre("cut-off sharpness G", "cut-off linearity"))
        << "which are not measured then";
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
