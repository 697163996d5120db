// UN R123, adaptive front-lighting systems: passing beams of classes C, V, E (and its data sets 1 to 3) and W, their bending modes, and the
// traffic-change function. Annex 3, tables 1 to 6. Candela for half the sum of both sides, right-hand traffic.
#include "metrics/regulation/rows.h"

#include <optional>

namespace fernlicht {
namespace {

const char* const edition = "UN R123, E/ECE/324/Rev.2/Add.122/Rev.2 with amendments 1 to 9 (02 series, supplement 2)";
const char* const source = "one published transcription of the text";

/// Table 1 of one class. No value: no row.
struct Values {
    std::optional<Limits> b50l, hv, br, brr, bll;
    bool p = false; ///< point P, 63 cd
    double zone_3_max = 0.0;
    bool signs = false;
    std::optional<Limits> at_50r, at_75r, at_50v, at_50l, at_25;
    double segment_20_max = 0.0; ///< 0: no row
    double segment_10_max = 0.0;
    Limits imax;
};

const Values class_c{.b50l = between(50, 350),
                     .hv = between(50, 625),
                     .br = between(50, 1750),
                     .brr = between(50, 3550),
                     .bll = between(50, 625),
                     .p = true,
                     .zone_3_max = 625,
                     .signs = true,
                     .at_50r = {},
                     .at_75r = at_least(10100),
                     .at_50v = at_least(5100),
                     .at_50l = between(3550, 13200),
                     .at_25 = at_least(1180),
                     .segment_10_max = 12300,
                     .imax = between(16900, 44100)};
const Values class_v{.b50l = between(50, 350),
                     .hv = between(50, 625),
                     .br = between(50, 880),
                     .brr = at_most(880),
                     .bll = at_most(880),
                     .zone_3_max = 625,
                     .at_50r = at_least(5100),
                     .at_75r = {},
                     .at_50v = at_least(5100),
                     .at_50l = between(3550, 13200),
                     .at_25 = at_least(845),
                     .segment_10_max = 12300,
                     .imax = between(8400, 44100)};
const Values class_e{.b50l = between(50, 625),
                     .hv = at_least(50),
                     .br = between(50, 1750),
                     .brr = at_most(3550),
                     .bll = at_most(880),
                     .zone_3_max = 880,
                     .signs = true,
                     .at_50r = {},
                     .at_75r = at_least(15200),
                     .at_50v = at_least(10100),
                     .at_50l = at_least(6800),
                     .at_25 = at_least(1180),
                     .segment_10_max = 12300,
                     .imax = between(16900, 79300)};
const Values class_w{.b50l = between(50, 625),
                     .hv = at_least(50),
                     .br = between(50, 2650),
                     .brr = at_most(5300),
                     .bll = at_most(880),
                     .p = true,
                     .zone_3_max = 880,
                     .signs = true,
                     .at_50r = {},
                     .at_75r = at_least(20300),
                     .at_50v = at_least(10100),
                     .at_50l = between(6800, 26400),
                     .at_25 = at_least(3400),
                     .segment_20_max = 17600,
                     .segment_10_max = 7100,
                     .imax = between(29530, 70500)};

/// Part B of table 1 stands in for lines 1, 2, 7, 13 and 18.
Values bending(Values values, std::optional<Limits> b50l, std::optional<Limits> hv, double at_50l_min, Limits imax) {
    values.b50l = b50l;
    values.hv = hv;
    values.zone_3_max = 880;
    values.at_50l = at_least(at_50l_min);
    values.imax = imax;
    return values;
}

/// Table 6 stands in for the maxima of lines 1 and 18.
Values data_set(double b50l_max, double imax_max) {
    Values values = class_e;
    values.b50l = between(50, b50l_max);
    values.imax = between(16900, imax_max);
    return values;
}

const std::vector<Direction> zone_3b{{-8, 1}, {-8, 4}, {8, 4}, {8, 2}, {6, 1.5}, {1.5, 1.5}, {-0.5, 0.34}, {-4, 0.34}};

std::vector<Direction> segment_imax(char letter) {
    if (letter == 'V')
        return rectangle(-90, 90, -1.72, -0.3); // no bounds in H are printed
    return rectangle(-0.5, 3, -1.72, letter == 'E' ? -0.1 : -0.3);
}

void add_table_1(Regulation& r, char letter, const Values& t) {
    const auto add = [&](const char* id, double h, double v, const std::optional<Limits>& limits) {
        if (limits)
            r.rows.push_back(point(id, h, v, *limits));
    };
    const bool a = letter == 'C' || letter == 'V';
    add("B50L", -3.43, 0.57, t.b50l);
    add("HV", 0, 0, t.hv);
    add("BR", 2.5, 1.0, t.br);
    r.rows.push_back(segment("segment BRR", 8, 20, 0.57, *t.brr));
    r.rows.push_back(segment("segment BLL", -20, -8, 0.57, *t.bll));
    if (t.p)
        r.rows.push_back(point("P", -7, 0, at_least(63)));
    r.rows.push_back(zone(a ? "zone III a" : "zone III b", a ? zone_3 : zone_3b, at_most(t.zone_3_max)));
    if (t.signs) {
        r.rows.push_back(sum_of("S50LL + S50 + S50RR", signs_4u, at_least(190)));
        r.rows.push_back(sum_of("S100LL + S100 + S100RR", signs_2u, at_least(375)));
    }
    add("50R", 1.72, -0.86, t.at_50r);
    add("75R", 1.15, -0.57, t.at_75r);
    add("50V", 0, -0.86, t.at_50v);
    add("50L", -3.43, -0.86, t.at_50l);
    add("25LL", -16, -1.72, t.at_25);
    add("25RR", 11, -1.72, t.at_25);
    if (t.segment_20_max > 0.0)
        r.rows.push_back(zone("segment 20 and below", rectangle(-3.5, 0, -90, -2), at_most(t.segment_20_max)));
    r.rows.push_back(zone("segment 10 and below", rectangle(-4.5, 2, -90, -4), at_most(t.segment_10_max)));
    r.rows.push_back(brightest("Imax", everywhere, t.imax));
}

void add_class_w(Regulation& r) { // table 4, item 4.1
    r.rows.push_back(segment("segment E", -20, 20, 10, at_most(175)));
    for (const auto& [id, h] : {std::pair{"segment F1", -10.0}, {"segment F2", 0.0}, {"segment F3", 10.0}}) {
        RegulationRow row = segment(id, h, h, 10, at_most(175));
        row.places = {{h, 10}, {h, 60}};
        r.rows.push_back(row);
    }
}

enum class Turn { none, some, left, right };

Regulation made(std::string id, std::string title, char letter, const Values& values, Turn turn = Turn::none) {
    Regulation r;
    r.id = std::move(id);
    r.title = std::move(title);
    r.edition = edition;
    r.source = source;
    r.receiver = un_receiver;
    r.half_sum = r.pairs = true;
    const bool aimed = letter == 'C' && turn == Turn::none;
    r.aim = aimed ? AimRule::automatic : AimRule::as_is;
    if (aimed)
        r.re_aim = {0.5, 0.75, 0.25};
    else
        r.notes.emplace_back("not aimed by itself: it keeps the aim of class C in the neutral state; `--aim-by CLASS_C` takes it over");
    add_table_1(r, letter, values);
    if (letter == 'W')
        add_class_w(r);
    if (turn == Turn::none) // bending modes have no such rule
        r.rows.push_back(brightest("segment Imax", segment_imax(letter), values.imax));
    if (turn == Turn::left || turn == Turn::right) {
        const bool left = turn == Turn::left;
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
    Regulation r;
    r.id = "r123-traffic-change";
    r.title = "UN R123, traffic-change function";
    r.edition = edition;
    r.source = source;
    r.receiver = un_receiver;
    r.half_sum = r.pairs = true;
    r.rows = {point("0.86D-1.72L", -1.72, -0.86, at_least(2500)), point("0.57U-3.43R", 3.43, 0.57, at_most(880))};
    r.notes = {"a system for right-hand traffic, driven on the left with its aim unchanged"};
    return r;
}

} // namespace

std::vector<Regulation> r123_passing_regulations() {
    const auto title = [](const std::string& what) { return "UN R123, passing beam class " + what; };
    std::vector<Regulation> all{made("r123-c", title("C (basic)"), 'C', class_c),
                                made("r123-v", title("V (town)"), 'V', class_v),
                                made("r123-e", title("E (motorway)"), 'E', class_e),
                                made("r123-e1", title("E, data set E1"), 'E', data_set(530, 70500)),
                                made("r123-e2", title("E, data set E2"), 'E', data_set(440, 61700)),
                                made("r123-e3", title("E, data set E3"), 'E', data_set(350, 52900)),
                                made("r123-w", title("W (adverse weather)"), 'W', class_w)};
    const auto add_bending = [&](const std::string& id, char letter, const Values& values) {
        const std::string what = std::string(1, letter) + ", bending";
        all.push_back(made(id, title(what), letter, values, Turn::some));
        all.push_back(made(id + "-left", title(what + ", smallest radius to the left"), letter, values, Turn::left));
        all.push_back(made(id + "-right", title(what + ", smallest radius to the right"), letter, values, Turn::right));
    };
    add_bending("r123-c-bending", 'C', bending(class_c, between(50, 530), between(50, 880), 1700, between(10100, 44100)));
    add_bending("r123-v-bending", 'V', bending(class_v, at_most(530), at_most(880), 1700, between(5100, 44100)));
    add_bending("r123-e-bending", 'E', bending(class_e, {}, {}, 3400, between(10100, 79300)));
    add_bending("r123-w-bending", 'W', bending(class_w, at_most(790), {}, 3400, between(20300, 70500)));
    all.push_back(traffic_change());
    return all;
}

} // namespace fernlicht
