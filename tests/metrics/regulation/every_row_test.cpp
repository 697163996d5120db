// Every row of every table: a lamp that meets all of them by one part in a hundred passes, and one that is changed at one row's place
// breaks this row, and no other that asks less there.
#include "tests/metrics/regulation/generated_lamp.h"

#include <gmock/gmock.h>
#include <set>

namespace fernlicht {
namespace {

using generated::Lamp;

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

} // namespace
} // namespace fernlicht
