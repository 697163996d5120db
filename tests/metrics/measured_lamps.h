// A beam as four kinds of file list it: samples on the file's own angles, each with noise of its own, rounded as such files are.
#pragma once

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/lamp_file.h"
#include "tests/lamps.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <random>

namespace fernlicht::measured {

enum class Kind { type_a, type_b, type_c, eulumdat };
inline constexpr Kind kinds[]{Kind::type_a, Kind::type_b, Kind::type_c, Kind::eulumdat};
inline const char* name_of(Kind kind) {
    static constexpr const char* names[]{"IES type A", "IES type B", "IES type C", "EULUMDAT"};
    return names[static_cast<int>(kind)];
}

struct Noise {
    double share = 0.0; ///< standard deviation of a sample
    unsigned seed = 1;
};

/// Without angles of its own, the kind's is that of H and V.
inline std::optional<AngleSystem> system_of(Kind kind) {
    if (kind == Kind::type_a)
        return std::nullopt;
    return kind == Kind::type_b ? type_b() : beam_along_nadir();
}

/// H 18 degrees to both sides and V from 7 D to 5 U; C planes ten steps apart (2.5 degrees at a quarter) over 20 degrees round the beam.
/// `cd(h, v)` in candela. The table on H and V is the beam without noise, every half degree: no file is resampled here.
inline LampFile lamp(Kind kind, double step_deg, const std::function<double(double, double)>& cd, const Noise& noise) {
    const std::optional<AngleSystem> system = system_of(kind);
    const bool planes = system && system->turns_about_beam;
    CandelaTable own;
    own.h_deg = planes ? tests::steps(-180.0, 180.0, 10.0 * step_deg) : tests::steps(-18.0, 18.0, step_deg);
    own.v_deg = planes ? tests::steps(-90.0, -70.0, step_deg) : tests::steps(-7.0, 5.0, step_deg);
    std::mt19937 random(noise.seed);
    std::normal_distribution<double> normal;
    for (const double v : own.v_deg)
        for (const double h : own.h_deg) {
            const TwoAngles d = system ? system->to_un(h, v) : TwoAngles{h, v};
            const double value = std::max(0.0, cd(d.h_deg, d.v_deg) * (1.0 + noise.share * normal(random)));
            own.cd.push_back(std::round(value * 10.0) / 10.0);
        }
    if (planes) // the last plane is the first
        for (std::size_t v = 0; v < own.v_deg.size(); ++v)
            own.at(v, own.h_deg.size() - 1) = own.at(v, 0);
    LampFile out;
    out.name = name_of(kind);
    if (!system) {
        out.table = own;
        return out;
    }
    out.table = tests::table_of(tests::steps(-18.0, 18.0, 0.5), tests::steps(-7.0, 5.0, 0.25), cd, own.rule);
    out.measured = MeasuredTable{own, *system};
    return out;
}

/// The lamp's own samples as a file of its kind.
inline std::string file_text(Kind kind, const LampFile& lamp) {
    const CandelaTable& own = lamp.measured ? lamp.measured->table : lamp.table;
    const bool planes = kind == Kind::type_c || kind == Kind::eulumdat;
    std::vector<double> first, second = own.v_deg;
    std::vector<std::size_t> column; // in the file's order: C planes turn the other way, and EULUMDAT leaves the last one out
    for (std::size_t x = 0; x < own.h_deg.size(); ++x)
        column.push_back(planes ? own.h_deg.size() - 1 - x : x);
    if (kind == Kind::eulumdat)
        column.pop_back();
    for (const std::size_t x : column)
        first.push_back(planes ? own.h_deg[column.front()] - own.h_deg[x] : own.h_deg[x]);
    if (planes) { // C 0 is H 0 of the table, whose first plane here is C -180
        const std::size_t half = (own.h_deg.size() - 1) / 2;
        for (std::size_t i = 0; i < column.size(); ++i)
            column[i] = (2 * half + own.h_deg.size() - 1 - half - i) % (own.h_deg.size() - 1);
        for (double& v : second)
            v += 90.0;
    }
    std::string text;
    if (kind == Kind::eulumdat) {
        text = fmt::format("ACME\n2\n0\n{}\n{}\n{}\n{}\nreport\nlow beam\n1\nlow.ldt\n2024\n", first.size(), first[1], second.size(),
                           second[1] - second[0]);
        text += "100\n100\n50\n100\n100\n0\n0\n0\n0\n90\n100\n1\n0\n1\n1\nLED\n1000\n4000\n80\n15\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n";
        text += fmt::format("{}\n{}\n", fmt::join(first, "\n"), fmt::join(second, "\n"));
    } else
        text = fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} {} 2 0 0 0\n1 1 0\n{}\n{}\n", second.size(), first.size(),
                           kind == Kind::type_a   ? 3
                           : kind == Kind::type_b ? 2
                                                  : 1,
                           fmt::join(second, " "), fmt::join(first, " "));
    for (const std::size_t x : column) {
        for (std::size_t y = 0; y < own.v_deg.size(); ++y)
            text += fmt::format("{}\n", own.at(y, x));
    }
    return text;
}

} // namespace fernlicht::measured
