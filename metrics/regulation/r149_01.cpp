// UN R149, 01 series: passing beams of classes C and V (table 6), driving beams (table 5), and the lines of the adaptive driving beam, as
// far as they are known. Candela, right-hand traffic.
#include "metrics/regulation/rows.h"

namespace fernlicht {
namespace {

const char* const r149_edition = "UN R149, 01 series (ECE/TRANS/WP.29/2022/93, corrected by WP.29/1166 par. 143, supplements 1 to 7)";
const char* const r149_source = "one published transcription of the text";

Regulation passing(bool c) {
    // Class C, then class V.
    const auto of = [c](double class_c, double class_v) { return c ? class_c : class_v; };
    Regulation r =
        un_table(c ? "r149-c" : "r149-v", c ? "UN R149, passing beam class C" : "UN R149, passing beam class V", r149_edition, r149_source);
    r.aim = AimRule::automatic;
    r.re_aim = {0.75, 0.75, 0.25};
    r.pairs = true;
    r.rows.push_back(zone("zone III", zone_3, at_most(625)));
    if (c) {
        r.rows.push_back(sure(sum_of("S50LL + S50 + S50RR", signs_4u, at_least(190)), Sureness::two_prints)); // and Taiwan's item 92-1
        r.rows.push_back(sum_of("S100LL + S100 + S100RR", signs_2u, at_least(375)));
    }
    r.rows.push_back(point("BR", 2.5, 1.0, at_most(1750)));
    r.rows.push_back(segment("segment BLL", -20, -8, 0.57, at_most(625)));
    r.rows.push_back(point("B50L", -3.43, 0.57, at_most(350)));
    r.rows.push_back(point("P", -7, 0, at_least(63)));
    if (c)
        r.rows.push_back(sure(point("75R", 1.15, -0.57, at_least(12100)), Sureness::two_prints)); // and Taiwan's item 92-1
    r.rows.push_back(point("50L", -3.43, -0.86, between(of(5000, 3550), 37000)));
    r.rows.push_back(point("50V", 0, -0.86, at_least(5100)));
    r.rows.push_back(point("50R", 1.72, -0.86, at_least(of(10100, 5100))));
    r.rows.push_back(segment("segment 50", -6.84, 6.84, -0.86, at_least(of(2540, 1800))));
    r.rows.push_back(segment("segment 40LL", -14, -9, -1.07, at_least(of(850, 600))));
    r.rows.push_back(point("40L", -9, -1.07, at_least(of(2800, 1950))));
    r.rows.push_back(point("40R", 9, -1.07, at_least(of(2800, 1950))));
    r.rows.push_back(segment("segment 40RR", 9, 14, -1.07, at_least(of(850, 600))));
    r.rows.push_back(point("25V", 0, -1.72, at_least(of(2500, 1750))));
    r.rows.push_back(segment("segment 25L", -16, -9, -1.72, at_least(of(1180, 825))));
    r.rows.push_back(segment("segment 25", -9, 9, -1.72, at_least(of(1700, 1200))));
    r.rows.push_back(segment("segment 25R", 9, 16, -1.72, at_least(of(1180, 825))));
    r.rows.push_back(segment("segment 15", -20, 20, -2.86, at_least(of(425, 300))));
    r.rows.push_back(segment("segment 10", -4.5, 2, -4, at_least(of(500, 350))));
    r.rows.push_back(at_most_of(zone("segment 10 and below", rectangle(-4.5, 2, -90, -4), {}), c ? "50R" : "25V", 0.8));
    if (!c)
        r.rows.push_back(brightest("Imax", everywhere, at_most(44100)));
    // Footnote a of table 6: each lamp of a matched pair gives at least half of the minimum.
    r.rows.push_back(scoped(point("50L, each lamp of a pair", -3.43, -0.86, at_least(of(2500, 1775))), Scope::each_of_two));
    if (c)
        r.rows.push_back(scoped(point("50V, each lamp of a pair", 0, -0.86, at_least(2550)), Scope::each_of_two));
    r.notes = {"the text gives no step along segments: sampled closer than the receiver is wide",
               "not checked: the flux rule (1000 lm, or 400 and 200 lm in two zones), run-up and conformity of production"};
    return r;
}

struct Driving {
    const char *id, *title;
    double at_2u, at_12, at_9, at_6, at_3, hv, imax; ///< 0: no row
};

Regulation driving(const Driving& d) {
    Regulation r = un_table(d.id, d.title, r149_edition, r149_source);
    r.aim = AimRule::maximum;
    r.re_aim = {1.0, 1.0, 0.5};
    r.row_re_aim_deg = 0.25; // 5.1.3
    r.pairs = true;
    const auto both_sides = [&](double h, const char* left, const char* right, double least) {
        if (least <= 0.0)
            return;
        // Held against a second print of table 5 (a collection of clauses), which at hand ends before the right one at 12 degrees.
        r.rows.push_back(sure(point(left, -h, 0, at_least(least)), Sureness::two_sources));
        r.rows.push_back(sure(point(right, h, 0, at_least(least)), h < 12.0 ? Sureness::two_sources : Sureness::one_source));
    };
    r.rows.push_back(brightest("Imax", everywhere, at_least(d.imax)));
    r.rows.push_back(
        scoped(noted(brightest("Imax, each lamp", everywhere, at_most(215000)), "in no direction more, of any lamp"), Scope::each_side));
    if (d.hv > 0.0)
        r.rows.push_back(sure(point("HV", 0, 0, at_least(d.hv)), Sureness::two_sources));
    else {
        r.rows.push_back(sure(at_least_of(point("HV", 0, 0, {}), "Imax", 0.8), Sureness::two_sources));
        r.rows.push_back(scoped(point("HV, each lamp of a pair", 0, 0, at_least(0.4 * d.imax)), Scope::each_of_two));
    }
    if (d.at_2u > 0.0)
        r.rows.push_back(point("2U-V", 0, 2, at_least(d.at_2u)));
    both_sides(3, "H-3L", "H-3R", d.at_3);
    both_sides(6, "H-6L", "H-6R", d.at_6);
    both_sides(9, "H-9L", "H-9R", d.at_9);
    both_sides(12, "H-12L", "H-12R", d.at_12);
    r.aim_note =
        "aimed by its own maximum, as a driving beam that can be adjusted by itself; `--aim-by PASSING` keeps the passing beam's aim";
    return r;
}

/// R149's first text says that it took R123 over without a change of its requirements; how the 01 series has these lines was not at hand.
Regulation adaptive_by_r149(const AdaptiveLine& line) {
    Regulation r = un_table("r149-adb-" + line.id, "UN R149, adaptive driving beam, " + line.title,
                            "UN R149, 00 series (ECE/TRANS/WP.29/2018/158/Rev.1), which took over UN R123",
                            "UN R123's table 7 by one published transcription; R149's introduction has it taken over without a change");
    r.sureness = Sureness::inferred;
    r.half_sum = r.pairs = true;
    r.rows = line.rows;
    r.notes = {"one state of the adaptation, and the file is the beam in that state",
               "whether the 01 series or a supplement changed the line is not known here, nor what R149 asks below the cut-off: of part B "
               "of R123's table see r123-adb-" +
                   line.id};
    r.aim_note = "not aimed by itself: it keeps the aim of the driving beam";
    return r;
}

} // namespace

std::vector<Regulation> r149_regulations() {
    std::vector<Regulation> all{
        passing(true),
        passing(false),
        driving({"r149-driving-a", "UN R149, driving beam class A (R)", 1000, 600, 2000, 3400, 12000, 0, 27000}),
        driving({"r149-driving-b", "UN R149, driving beam class B (HR)", 1700, 1500, 3400, 5000, 17500, 0, 40000}),
        driving({"r149-driving-ra", "UN R149, auxiliary driving beam class RA", 0, 0, 0, 0, 0, 0, 10000}),
        driving({"r149-driving-bs", "UN R149, driving beam class BS", 0, 0, 0, 2500, 9000, 16000, 20000}),
        driving({"r149-driving-cs", "UN R149, secondary driving beam class CS", 1000, 0, 0, 3400, 12000, 20000, 27000}),
        driving({"r149-driving-ds", "UN R149, secondary driving beam class DS", 1700, 0, 0, 5000, 17500, 30000, 40000}),
    };
    for (const AdaptiveLine& line : adaptive_lines())
        all.push_back(adaptive_by_r149(line));
    return all;
}

} // namespace fernlicht
