// UN R123, adaptive front-lighting systems: passing beams of classes C, V, E (and its data sets 1 to 3) and W, their bending modes, the
// traffic-change function (annex 3, tables 1 to 6), the driving beam (6.3.2) and the adaptive driving beam's lines (annex 3, table 7).
// Candela for half the sum of both sides, right-hand traffic.
#include "metrics/regulation/rows.h"

#include <array>
#include <optional>
#include <string_view>

namespace fernlicht {
namespace {

Regulation of_both_sides(std::string id, const std::string& title) {
    Regulation r = un_table(std::move(id), "UN R123, " + title,
                            "UN R123, E/ECE/324/Rev.2/Add.122/Rev.2 with amendments 1 to 9 (02 series, supplement 2)",
                            "one published transcription of the text");
    r.half_sum = r.pairs = true;
    return r;
}

/// A row of table 1 with its limits for the classes C, V, E and W. No value: no row.
struct ClassRow {
    RegulationRow row;
    std::array<std::optional<Limits>, 4> of;
};

const std::vector<ClassRow>& table_1() {
    constexpr auto no = std::nullopt;
    static const std::vector<Direction> zone_3b{{-8, 1}, {-8, 4}, {8, 4}, {8, 2}, {6, 1.5}, {1.5, 1.5}, {-0.5, 0.34}, {-4, 0.34}};
    static const std::vector<ClassRow> lines{
        {point("B50L", -3.43, 0.57, {}), {between(50, 350), between(50, 350), between(50, 625), between(50, 625)}},
        {point("HV", 0, 0, {}), {between(50, 625), between(50, 625), at_least(50), at_least(50)}},
        {point("BR", 2.5, 1.0, {}), {between(50, 1750), between(50, 880), between(50, 1750), between(50, 2650)}},
        {segment("segment BRR", 8, 20, 0.57, {}), {between(50, 3550), at_most(880), at_most(3550), at_most(5300)}},
        {segment("segment BLL", -20, -8, 0.57, {}), {between(50, 625), at_most(880), at_most(880), at_most(880)}},
        {point("P", -7, 0, {}), {at_least(63), no, no, at_least(63)}},
        {zone("zone III a", zone_3, {}), {at_most(625), at_most(625), no, no}},
        {zone("zone III b", zone_3b, {}), {no, no, at_most(880), at_most(880)}},
        {sum_of("S50LL + S50 + S50RR", signs_4u, {}), {at_least(190), no, at_least(190), at_least(190)}},
        {sum_of("S100LL + S100 + S100RR", signs_2u, {}), {at_least(375), no, at_least(375), at_least(375)}},
        {point("50R", 1.72, -0.86, {}), {no, at_least(5100), no, no}},
        {point("75R", 1.15, -0.57, {}), {at_least(10100), no, at_least(15200), at_least(20300)}},
        {point("50V", 0, -0.86, {}), {at_least(5100), at_least(5100), at_least(10100), at_least(10100)}},
        {point("50L", -3.43, -0.86, {}), {between(3550, 13200), between(3550, 13200), at_least(6800), between(6800, 26400)}},
        {point("25LL", -16, -1.72, {}), {at_least(1180), at_least(845), at_least(1180), at_least(3400)}},
        {point("25RR", 11, -1.72, {}), {at_least(1180), at_least(845), at_least(1180), at_least(3400)}},
        {zone("segment 20 and below", rectangle(-3.5, 0, -90, -2), {}), {no, no, no, at_most(17600)}},
        {zone("segment 10 and below", rectangle(-4.5, 2, -90, -4), {}), {at_most(12300), at_most(12300), at_most(12300), at_most(7100)}},
        {brightest("Imax", everywhere, {}), {between(16900, 44100), between(8400, 44100), between(16900, 79300), between(29530, 70500)}},
    };
    return lines;
}

/// What stands in for rows of a class, by their ids; no value: the row falls away.
using Changes = std::vector<std::pair<std::string, std::optional<Limits>>>;

/// Part B of table 1 stands in for lines 1, 2, 7, 13 and 18.
Changes bending(std::optional<Limits> b50l, std::optional<Limits> hv, double at_50l_min, Limits imax) {
    return {{"B50L", b50l}, {"HV", hv}, {"zone III a", at_most(880)}, {"50L", at_least(at_50l_min)}, {"Imax", imax}};
}

/// Table 6 stands in for the maxima of lines 1 and 18.
Changes data_set(double b50l_max, double imax_max) { return {{"B50L", between(50, b50l_max)}, {"Imax", between(16900, imax_max)}}; }

std::vector<Direction> segment_imax(char letter) {
    if (letter == 'V')
        return rectangle(-90, 90, -1.72, -0.3); // no bounds in H are printed
    return rectangle(-0.5, 3, -1.72, letter == 'E' ? -0.1 : -0.3);
}

void add_class_w(Regulation& r) { // table 4, item 4.1
    r.rows.push_back(segment("segment E", -20, 20, 10, at_most(175)));
    for (const auto& [id, h] : {std::pair{"segment F1", -10.0}, {"segment F2", 0.0}, {"segment F3", 10.0}}) {
        RegulationRow row = segment(id, h, h, 10, at_most(175));
        row.places = {{h, 10}, {h, 60}};
        r.rows.push_back(row);
    }
}

enum class Bend { none, some, left, right };

Regulation passing_beam(std::string id, const std::string& title, char letter, const Changes& changes = {}, Bend turn = Bend::none) {
    Regulation r = of_both_sides(std::move(id), "passing beam class " + title);
    const bool aimed = letter == 'C' && turn == Bend::none;
    r.aim = aimed ? AimRule::automatic : AimRule::as_is;
    if (aimed)
        r.re_aim = {0.5, 0.75, 0.25};
    else
        r.aim_note = "not aimed by itself: it keeps the aim of class C in the neutral state; `--aim-by CLASS_C` takes it over";
    for (const auto& [row, of] : table_1()) {
        std::optional<Limits> limits = of[std::string_view("CVEW").find(letter)];
        for (const auto& [changed, by] : changes)
            limits = limits && row.id == changed ? by : limits;
        if (!limits)
            continue;
        r.rows.push_back(row);
        r.rows.back().limits = *limits;
    }
    const Limits imax = r.rows.back().limits;
    if (letter == 'W')
        add_class_w(r);
    if (turn == Bend::none) // bending modes have no such rule
        r.rows.push_back(brightest("segment Imax", segment_imax(letter), imax));
    if (turn == Bend::left || turn == Bend::right) {
        const bool left = turn == Bend::left;
        r.rows.push_back(noted(scoped(brightest(left ? "turn to the left" : "turn to the right",
                                                rectangle(left ? -45 : 10, left ? -10 : 45, -2, 0), at_least(2500)),
                                      Scope::either_side),
                               "of one side, in one direction at least, at the smallest turn radius"));
    }
    if (letter == 'C') // footnote 4: each side, and of a segment at least one point
        for (const RegulationRow& row : std::vector<RegulationRow>(r.rows.begin(), r.rows.begin() + 5)) {
            RegulationRow side = row;
            side.id += ", each side";
            side.limits = at_least(50);
            side.scope = Scope::each_of_two;
            if (side.kind == RowKind::segment)
                side.kind = RowKind::brightest;
            r.rows.push_back(side);
        }
    if (letter != 'V')
        r.rows.push_back(scoped(point("50V, each side", 0, -0.86, at_least(2500)), Scope::each_side));
    return r;
}

Regulation traffic_change() {
    Regulation r = of_both_sides("r123-traffic-change", "traffic-change function");
    r.rows = {point("0.86D-1.72L", -1.72, -0.86, at_least(2500)), point("0.57U-3.43R", 3.43, 0.57, at_most(880))};
    r.notes = {"a system for right-hand traffic, driven on the left with its aim unchanged"};
    return r;
}

Regulation driving_beam() {
    Regulation r = of_both_sides("r123-driving", "driving beam");
    r.aim = AimRule::maximum;
    r.re_aim = {1.0, 1.0, 0.5};
    r.rows = {
        brightest("Imax", everywhere, at_least(40500)),
        scoped(noted(brightest("Imax, each side", everywhere, at_most(215000)), "in no direction more, of any side"), Scope::each_side),
        at_least_of(point("HV", 0, 0, {}), "Imax", 0.8),
        point("H-2.5L", -2.5, 0, at_least(20300)),
        point("H-2.5R", 2.5, 0, at_least(20300)),
        point("H-5L", -5, 0, at_least(5100)),
        point("H-5R", 5, 0, at_least(5100)),
        scoped(point("HV, each side", 0, 0, at_least(16200)), Scope::each_side)};
    return r;
}

/// One state of adaptation: its line of part A; part B holds where no passing beam stays on.
Regulation adaptive(const AdaptiveLine& line) {
    Regulation r = of_both_sides("r123-adb-" + line.id, "adaptive driving beam, " + line.title);
    r.rows = line.rows;
    const char* const note = "part B: not asked where a passing beam stays on";
    for (const RegulationRow& row :
         {point("50R", 1.72, -0.86, at_least(5100)), point("50V", 0, -0.86, at_least(5100)), point("50L", -3.43, -0.86, at_least(2550)),
          point("25LL", -16, -1.72, at_least(1180)), point("25RR", 11, -1.72, at_least(1180))})
        r.rows.push_back(noted(row, note));
    r.notes = {"one state of the adaptation, and the file is the beam in that state"};
    r.aim_note = "not aimed by itself: it keeps the aim of the driving beam";
    return r;
}

} // namespace

const std::vector<AdaptiveLine>& adaptive_lines() {
    static const std::vector<AdaptiveLine> lines{
        {"oncoming-50m", "oncoming vehicle at 50 m", {segment("line 1", -4.8, -2, 0.57, at_most(625))}},
        {"oncoming-100m", "oncoming vehicle at 100 m", {segment("line 2", -2.4, -1, 0.30, at_most(1750))}},
        {"oncoming-200m", "oncoming vehicle at 200 m", {segment("line 3", -1.2, -0.5, 0.15, at_most(5450))}},
        {"preceding-50m",
         "preceding vehicle at 50 m",
         {segment("line 4", -1.7, 1, 0.30, at_most(1850)), segment("line 4, beyond 1 R", 1, 1.7, 0.30, at_most(2500))}},
        {"preceding-100m",
         "preceding vehicle at 100 m",
         {segment("line 5", -0.9, 0.5, 0.15, at_most(5300)), segment("line 5, beyond 0.5 R", 0.5, 0.9, 0.15, at_most(7000))}},
        {"preceding-200m", "preceding vehicle at 200 m", {segment("line 6", -0.45, 0.45, 0.10, at_most(16000))}}};
    return lines;
}

std::vector<Regulation> r123_regulations() {
    std::vector<Regulation> all{passing_beam("r123-c", "C (basic)", 'C'),
                                passing_beam("r123-v", "V (town)", 'V'),
                                passing_beam("r123-e", "E (motorway)", 'E'),
                                passing_beam("r123-e1", "E, data set E1", 'E', data_set(530, 70500)),
                                passing_beam("r123-e2", "E, data set E2", 'E', data_set(440, 61700)),
                                passing_beam("r123-e3", "E, data set E3", 'E', data_set(350, 52900)),
                                passing_beam("r123-w", "W (adverse weather)", 'W')};
    const auto add_bending = [&](const std::string& id, char letter, const Changes& changes) {
        const std::string what = std::string(1, letter) + ", bending";
        all.push_back(passing_beam(id, what, letter, changes, Bend::some));
        all.push_back(passing_beam(id + "-left", what + ", smallest radius to the left", letter, changes, Bend::left));
        all.push_back(passing_beam(id + "-right", what + ", smallest radius to the right", letter, changes, Bend::right));
    };
    add_bending("r123-c-bending", 'C', bending(between(50, 530), between(50, 880), 1700, between(10100, 44100)));
    add_bending("r123-v-bending", 'V', bending(at_most(530), at_most(880), 1700, between(5100, 44100)));
    add_bending("r123-e-bending", 'E', bending({}, {}, 3400, between(10100, 79300)));
    add_bending("r123-w-bending", 'W', bending(at_most(790), {}, 3400, between(20300, 70500)));
    all.push_back(traffic_change());
    all.push_back(driving_beam());
    for (const AdaptiveLine& line : adaptive_lines())
        all.push_back(adaptive(line));
    return all;
}

} // namespace fernlicht
