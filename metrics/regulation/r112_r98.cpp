// UN R112 classes A and B and UN R98 class D, passing and driving beams: tables 8 and 5 of the 00 series of UN R149, which took them over.
// Candela, right-hand traffic.
#include "metrics/regulation/rows.h"

namespace fernlicht {
namespace {

const char* const edition_ab = "UN R112, 01 series = UN R149, 00 series (ECE/TRANS/WP.29/2018/158/Rev.1) with supplements 1 to 10";
const char* const edition_d = "UN R98 = UN R149, 00 series (ECE/TRANS/WP.29/2018/158/Rev.1) with supplements 1 to 10, class D";
const char* const two_sources = "two published transcriptions, of R149 and of R112 in the EU's Official Journal of 2014, agree";
const char* const one_source = "one published transcription of the text";
const char* const two_prints = "one published transcription of the text, held by its maker against India's AIS-199 (draft of 2024) as well";

void add_signs(Regulation& r) {
    r.rows.push_back(sum_of("B1 + B2 + B3", signs_4u, at_least(190)));
    r.rows.push_back(sum_of("B4 + B5 + B6", signs_2u, at_least(375)));
    r.rows.push_back(point("B7", -8, 0, at_least(65)));
    r.rows.push_back(point("B8", -4, 0, at_least(125)));
}

Regulation passing(const char* id, const char* title, bool d) {
    Regulation r = un_table(id, title, d ? edition_d : edition_ab, d ? two_prints : two_sources);
    r.sureness = d ? Sureness::two_prints : Sureness::two_sources;
    r.aim = AimRule::automatic;
    r.re_aim = {0.5, 0.75, 0.25};
    r.rows = {point("B50L", -3.43, 0.57, at_most(350)), zone("zone III", zone_3, at_most(625))};
    return r;
}

Regulation passing_ab(bool b) {
    const auto of = [b](double class_a, double class_b) { return b ? class_b : class_a; };
    Regulation r = passing(b ? "r112-b" : "r112-a", b ? "UN R112, passing beam class B (HC)" : "UN R112, passing beam class A (C)", false);
    r.rows.push_back(point("BR", 2.5, 1.0, at_most(1750)));
    r.rows.push_back(point("50R", 1.72, -0.86, at_least(of(5100, 10100))));
    r.rows.push_back(point("75R", 1.15, -0.57, at_least(of(5100, 10100))));
    if (b)
        r.rows.push_back(point("50V", 0, -0.86, at_least(5100)));
    r.rows.push_back(noted(point("50L", -3.43, -0.86, at_most(13200)), "18 500 cd for LED modules with control gear: not encoded"));
    r.rows.push_back(point("75L", -3.43, -0.57, at_most(10600)));
    r.rows.push_back(point("25L", -9, -1.72, at_least(of(1250, 1700))));
    r.rows.push_back(point("25R", 9, -1.72, at_least(of(1250, 1700))));
    r.rows.push_back(zone("zone IV", rectangle(-5.15, 5.15, -1.72, -0.86), at_least(of(1700, 2500))));
    const std::vector<Direction> zone_1 = rectangle(-9, 9, -4, -1.72);
    if (b)
        r.rows.push_back(noted(at_most_of(zone("zone I", zone_1, {}), "50R", 2.0), "the text says less than, taken as at most"));
    else
        r.rows.push_back(zone("zone I", zone_1, at_most(17600)));
    add_signs(r);
    r.notes = {"limits in cd at 13.2 V; the older ones in lux at 12 V are another edition and not encoded"};
    return r;
}

Regulation passing_d() {
    Regulation r = passing("r98-d", "UN R98, passing beam class D (DC)", true);
    r.rows.push_back(point("C-D", 2.5, 1.0, at_most(1750)));
    r.rows.push_back(point("50R", 1.72, -0.86, at_least(12500)));
    r.rows.push_back(point("75R", 1.15, -0.57, at_least(12500)));
    r.rows.push_back(point("50V", 0, -0.86, at_least(7500)));
    r.rows.push_back(point("50L", -3.43, -0.86, at_most(18480)));
    r.rows.push_back(point("25L1", -3.43, -1.72, at_most(18800)));
    r.rows.push_back(point("25L2", -9, -1.72, at_least(2500)));
    r.rows.push_back(point("25R1", 9, -1.72, at_least(2500)));
    r.rows.push_back(point("25L3", -15, -1.72, at_least(1250)));
    r.rows.push_back(point("25R2", 15, -1.72, at_least(1250)));
    r.rows.push_back(point("15L", -20, -2.86, at_least(625)));
    r.rows.push_back(point("15R", 20, -2.86, at_least(625)));
    r.rows.push_back(segment("segment I A-B", -5.15, 5.15, -0.86, at_least(3750)));
    r.rows.push_back(zone("segment III and under", rectangle(-9.37, 8.5, -90, -4.29), at_most(12500)));
    r.rows.push_back(noted(brightest("Imax R", rectangle(0, 90, -1.72, 90), at_most(43800)),
                           "above 1.72 D as the table says; a figure of the text shades it only above 1.72 U"));
    r.rows.push_back(brightest("Imax L", rectangle(-90, 0, -90, 90), at_most(31300)));
    add_signs(r);
    return r;
}

Regulation driving(const char* id, const char* title, bool d, double imax, double at_2_5, double at_5) {
    Regulation r = un_table(id, title, d ? edition_d : edition_ab, one_source);
    r.aim = AimRule::maximum;
    r.rows = {brightest("Imax", everywhere, between(imax, 215000)),
              at_least_of(point("HV", 0, 0, {}), "Imax", 0.8),
              point("H-2.5L", -2.5, 0, at_least(at_2_5)),
              point("H-2.5R", 2.5, 0, at_least(at_2_5)),
              point("H-5L", -5, 0, at_least(at_5)),
              point("H-5R", 5, 0, at_least(at_5))};
    r.aim_note = "aimed by its own maximum, as a lamp with a driving beam alone; `--aim-by PASSING` keeps the passing beam's aim";
    return r;
}

} // namespace

std::vector<Regulation> r112_and_r98_regulations() {
    return {passing_ab(false),
            passing_ab(true),
            passing_d(),
            driving("r112-driving-a", "UN R112, driving beam class A (R)", false, 27000, 13500, 3400),
            driving("r112-driving-b", "UN R112, driving beam class B (HR)", false, 40500, 20300, 5100),
            driving("r98-driving-d", "UN R98, driving beam class D (DR)", true, 43800, 25000, 6250)};
}

} // namespace fernlicht
