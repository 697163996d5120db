#include "runner/experiments/regulation/regulation_result.h"

#include "runner/findings/plots/isocandela.h"

#include <fmt/format.h>
#include <limits>

namespace fernlicht {

plots::Figure cut_off_figure(const CutOffFound& measured) {
    const auto& [lamp, options, mirrored, c, elbow] = measured;
    const double sign = mirrored ? -1.0 : 1.0;
    const double middle = c.level.inflection_deg.value_or(-0.5);
    constexpr double beside_deg = 6.0, below_deg = 2.0, above_deg = 3.0;
    plots::Figure f = plots::isocandela_diagram(lamp.table, lamp.name,
                                                plots::AngleWindow{-beside_deg, beside_deg, middle - below_deg, middle + above_deg});
    const auto place = [](std::optional<double> value, double uncertainty, const std::string& reason) {
        return value ? fmt::format("{:.2f} ± {:.2f}°", *value, uncertainty) : "not measured (" + reason + ")";
    };
    std::optional<double> kink = c.kink_h_deg, elbow_h;
    if (kink)
        kink = sign * *kink;
    if (elbow.at)
        elbow_h = sign * elbow.at->h_deg;
    f.subtitle = fmt::format("elbow at H {}; kink by 1, 2 and 3 degrees at H {}", place(elbow_h, elbow.uncertainty.h_deg, elbow.reason),
                             place(kink, c.kink_uncertainty_deg, c.kink_reason));
    const plots::Colour edge{255, 255, 255}, fitted{240, 130, 0}, scanned{235, 235, 235}, inflection{255, 90, 170};
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    const plots::Point apart{gap, gap}; // between dots that no line connects
    plots::Series columns{.name = "edge of each column", .colour = edge, .width_px = 1.2, .markers = true};
    for (const EdgePoint& p : elbow.points)
        if (p.used)
            columns.points.insert(columns.points.end(), {{sign * p.h_deg, p.v_deg}, apart});
    f.series.push_back(columns);
    if (elbow.at) {
        plots::Series fit{.name = "fit: level, rise, shoulder", .colour = fitted, .width_px = 2.5};
        const double from = elbow.points.front().h_deg, to = elbow.points.back().h_deg;
        for (const double h : {from, elbow.at->h_deg, elbow.rise_to_h_deg.value_or(to), to})
            fit.points.push_back({sign * h, elbow.edge_deg(h)});
        f.series.push_back(fit);
        f.notes.push_back({elbow_h.value(), elbow.at->v_deg, "elbow", {255, 255, 255}, true});
    }
    plots::Series scans{.name = "scans", .colour = scanned, .width_px = 1.0, .dash = "3 3"};
    plots::Series found{.name = "their inflections", .colour = inflection, .width_px = 2.0, .markers = true};
    for (const CutOffScan* scan : {&c.level_outer, &c.level, &c.level_inner, &c.rise[0], &c.rise[1], &c.rise[2]}) {
        const double h = sign * scan->at_deg;
        for (const double v : {middle - below_deg, middle + above_deg, gap})
            scans.points.push_back({h, v});
        if (scan->inflection_deg)
            found.points.insert(found.points.end(), {{h, *scan->inflection_deg}, apart});
    }
    if (c.level.inflection_deg) {
        scans.points.push_back({-5.0, c.shoulder.at_deg});
        scans.points.push_back({5.0, c.shoulder.at_deg});
        if (c.shoulder.inflection_deg)
            found.points.push_back({sign * *c.shoulder.inflection_deg, c.shoulder.at_deg});
    }
    f.series.push_back(scans);
    f.series.push_back(found);
    return f;
}

} // namespace fernlicht
