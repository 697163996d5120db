// UN R123: the driving beam (6.3.2) and the adaptive driving beam's lines (annex 3, table 7). Candela for half the sum of both sides.
#include "metrics/regulation/rows.h"

namespace fernlicht {
namespace {

Regulation made(std::string id, std::string title) {
    Regulation r;
    r.id = std::move(id);
    r.title = std::move(title);
    r.edition = "UN R123, E/ECE/324/Rev.2/Add.122/Rev.2 with amendments 1 to 9 (02 series, supplement 2)";
    r.source = "one published transcription of the text";
    r.receiver = un_receiver;
    r.half_sum = r.pairs = true;
    return r;
}

Regulation driving() {
    Regulation r = made("r123-driving", "UN R123, driving beam");
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

/// One state of adaptation. `rows` are its line of part A; part B holds where no passing beam stays on.
Regulation adaptive(const std::string& id, const std::string& title, std::vector<RegulationRow> rows, bool mirrors = true) {
    Regulation r = made("r123-adb-" + id, "UN R123, adaptive driving beam, " + title);
    r.aim = AimRule::as_is;
    r.mirrors = mirrors;
    r.rows = std::move(rows);
    const char* const note = "part B: not asked where a passing beam stays on";
    for (const RegulationRow& row :
         {point("50R", 1.72, -0.86, at_least(5100)), point("50V", 0, -0.86, at_least(5100)), point("50L", -3.43, -0.86, at_least(2550)),
          point("25LL", -16, -1.72, at_least(1180)), point("25RR", 11, -1.72, at_least(1180))})
        r.rows.push_back(noted(row, note));
    r.notes = {"one state of the adaptation, and the file is the beam in that state; it keeps the aim of the driving beam"};
    return r;
}

} // namespace

std::vector<Regulation> r123_driving_regulations() {
    return {driving(),
            adaptive("oncoming-50m", "oncoming vehicle at 50 m", {segment("line 1", -4.8, -2, 0.57, at_most(625))}),
            adaptive("oncoming-100m", "oncoming vehicle at 100 m", {segment("line 2", -2.4, -1, 0.30, at_most(1750))}),
            adaptive("oncoming-200m", "oncoming vehicle at 200 m", {segment("line 3", -1.2, -0.5, 0.15, at_most(5450))}),
            adaptive("preceding-50m", "preceding vehicle at 50 m",
                     {segment("line 4", -1.7, 1, 0.30, at_most(1850)), segment("line 4, beyond 1 R", 1, 1.7, 0.30, at_most(2500))}),
            adaptive("preceding-100m", "preceding vehicle at 100 m",
                     {segment("line 5", -0.9, 0.5, 0.15, at_most(5300)), segment("line 5, beyond 0.5 R", 0.5, 0.9, 0.15, at_most(7000))}),
            adaptive("preceding-200m", "preceding vehicle at 200 m", {segment("line 6", -0.45, 0.45, 0.10, at_most(16000))})};
}

} // namespace fernlicht
