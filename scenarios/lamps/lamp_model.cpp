// The figures of our own lamps. Chosen by hand so that the sampled tables meet their regulation rows with the margins of production lamps
// and have the flux and the maxima of common ones; tests/scenarios/lamps/lamp_model_test.cpp holds them to that.
#include "scenarios/lamps/lamp_model.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double edge_h_deg = 52.0, edge_top_deg = 16.0, edge_bottom_deg = -21.0;

/// Over how much of H the kink is rounded: sharp in the edge, which images one shield or filament, soft in the light under it.
constexpr double edge_kink_deg = 0.1, body_kink_deg = 0.8;

/// Bell with longer tails than a Gaussian, as scatter in lens and reflector gives them: (1 + x2 / 8)^-4.
double bell(double x) {
    const double y = 1.0 + x * x / 8.0;
    return 1.0 / (y * y * y * y);
}

/// 1 inside, 0 from the edge on, level at both ends.
double fade(double distance_to_edge, double over) {
    const double t = std::clamp(distance_to_edge / over, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double part_cd(const BeamPart& p, double h, double v, double level_deg, double line_deg) {
    const double upper = level_deg + p.follows_rise * (line_deg - level_deg);
    const double x = h - p.h_deg, depth = upper - v - p.depth_deg;
    return p.peak_cd * bell(x / (x < 0.0 ? p.left_deg : p.right_deg)) * bell(depth / (depth < 0.0 ? p.above_deg : p.below_deg));
}

struct Stretch {
    double to, step;
};

/// An axis from `from` on in stretches of even steps; each value is computed from whole steps, so that it is exact in print.
std::vector<double> axis(double from, std::initializer_list<Stretch> stretches) {
    std::vector<double> values{from};
    for (const Stretch& s : stretches) {
        const double start = values.back();
        const long steps = std::lround((s.to - start) / s.step);
        for (long i = 1; i <= steps; ++i)
            values.push_back(std::round((start + static_cast<double>(i) * s.step) * 1000.0) / 1000.0 + 0.0); // never -0
    }
    return values;
}

CandelaTable axes_of(const LampModel& model) {
    CandelaTable table;
    if (model.cut_off) {
        table.h_deg =
            axis(-52.0, {{-20.0, 2.0}, {-10.0, 1.0}, {-4.0, 0.5}, {-1.0, 0.25}, {2.0, 0.1}, {9.0, 0.2}, {30.0, 0.5}, {52.0, 2.0}});
        table.v_deg = axis(-21.0, {{-8.0, 1.0}, {-4.0, 0.5}, {-2.0, 0.2}, {2.0, 0.05}, {4.0, 0.2}, {8.0, 0.5}, {16.0, 1.0}});
    } else {
        table.h_deg = axis(-52.0, {{-20.0, 2.0}, {-10.0, 1.0}, {-4.0, 0.5}, {4.0, 0.2}, {10.0, 0.5}, {20.0, 1.0}, {52.0, 2.0}});
        table.v_deg = axis(-21.0, {{-8.0, 1.0}, {-4.0, 0.5}, {4.0, 0.2}, {8.0, 0.5}, {16.0, 1.0}});
    }
    return table;
}

} // namespace

double CutOff::line_deg(double h_deg, double kink_deg) const {
    constexpr double flattening_deg = 0.25;
    const double x = (h_deg - kink_h_deg) / kink_deg;
    // Only the images of the bulb's end reach the rising sector; beside it the edge sinks back to the level that the wide light has.
    const double beyond = std::max(h_deg - rise_ends_h_deg, 0.0) / rise_ends_h_deg;
    const double rise = bell(beyond) * rise_slope * kink_deg * (x > 30.0 ? x : std::log1p(std::exp(x)));
    const double room = top_deg - level_deg;
    return level_deg + room - flattening_deg * std::log1p(std::exp((room - rise) / flattening_deg));
}

double CutOff::glow(double h_deg, double v_deg) const {
    return glow_cd * bell(h_deg / glow_h_deg) * bell(std::max(v_deg - level_deg, 0.0) / glow_v_deg);
}

double model_intensity_cd(const LampModel& model, double h, double v) {
    const double level = model.cut_off ? model.cut_off->level_deg : 0.0;
    const double body = model.cut_off ? model.cut_off->line_deg(h, body_kink_deg) : 0.0;
    double cd = 0.0;
    for (const BeamPart& part : model.parts)
        cd += part_cd(part, h, v, level, body);
    if (model.cut_off) {
        const double line = model.cut_off->line_deg(h, edge_kink_deg);
        // A logistic step between beam and glow in log intensity: its inflection lies on the cut-off line whatever the levels.
        const double share = 1.0 / (1.0 + std::exp((v - line) / model.cut_off->softness_deg));
        cd = std::pow(cd, share) * std::pow(model.cut_off->glow(h, v), 1.0 - share);
    }
    return cd * fade(edge_h_deg - std::abs(h), 16.0) * fade(edge_top_deg - v, 8.0) * fade(v - edge_bottom_deg, 9.0);
}

LampFile lamp_of_model(const LampModel& model) {
    LampFile lamp{.name = model.title, .format = "model " + model.name, .table = axes_of(model)};
    for (const double v : lamp.table.v_deg)
        for (const double h : lamp.table.h_deg)
            lamp.table.cd.push_back(std::round(model_intensity_cd(model, h, v) * 10.0) / 10.0);
    lamp.labels = {
        {"TEST", "fernlicht lamp model " + model.name + ": a model, not a measurement"},
        {"TESTLAB", "none"},
        {"ISSUEDATE", "2026"},
        {"MANUFAC", "fernlicht"},
        {"OTHER", model.meets},
        {"OTHER", model.cut_off ? "right-hand traffic; as on the goniometer in regulation aim: cut-off at 0.57 D" : "axis at HV"}};
    return lamp;
}

const std::vector<LampModel>& lamp_models() {
    constexpr double tan_15_deg = 0.2679491924311227;
    // Parts: cd, H, widths left and right, depth, widths above and below, how they follow the rise. Cut-off: level, kink, slope, where the
    // rise ends, top, softness, glow in cd and its widths.
    static const std::vector<LampModel> models{{"halogen-low",
                                                "halogen low beam (model)",
                                                "UN R112 class B passing beam rows, right-hand traffic",
                                                {{15000, 1.6, 2.4, 2.6, 0.65, 0.9, 0.7, 1.0},
                                                 {8000, 0.6, 6.5, 7.0, 0.9, 1.2, 1.1, 0.5},
                                                 {2600, 0.0, 16.0, 17.0, 1.8, 1.8, 2.4, 0.0},
                                                 {900, 0.0, 20.0, 21.0, 6.0, 3.0, 4.5, 0.0}},
                                                CutOff{-0.57, 0.0, tan_15_deg, 7.0, 1.0, 0.16, 270.0, 13.0, 3.5}},
                                               {"halogen-high",
                                                "halogen high beam (model)",
                                                "UN R112 class B driving beam rows",
                                                {{38000, 0.0, 2.3, 2.3, 0.0, 1.1, 1.2, 0.0},
                                                 {11000, 0.0, 5.0, 5.0, 0.2, 1.5, 1.8, 0.0},
                                                 {2200, 0.0, 14.0, 14.0, 1.2, 2.6, 3.2, 0.0},
                                                 {500, 0.0, 18.0, 18.0, 5.0, 4.0, 4.5, 0.0}},
                                                std::nullopt},
                                               {"xenon-low",
                                                "xenon low beam (model)",
                                                "UN R98 (R149 00 series class D) passing beam rows, right-hand traffic",
                                                {{27000, 2.2, 1.8, 2.8, 0.6, 0.9, 0.75, 1.0},
                                                 {11500, 1.2, 7.0, 8.0, 0.9, 1.2, 1.1, 0.5},
                                                 {5800, 0.0, 20.0, 21.0, 1.8, 1.8, 2.4, 0.0},
                                                 {1700, 0.0, 24.0, 25.0, 6.0, 3.0, 4.5, 0.0}},
                                                CutOff{-0.57, 0.0, tan_15_deg, 7.0, 1.05, 0.125, 270.0, 14.0, 3.5}},
                                               {"xenon-high",
                                                "xenon high beam (model)",
                                                "UN R98 (R149 00 series class D) driving beam rows",
                                                {{68000, 0.0, 2.4, 2.4, 0.0, 1.1, 1.2, 0.0},
                                                 {19000, 0.0, 5.0, 5.0, 0.2, 1.6, 1.9, 0.0},
                                                 {3500, 0.0, 17.0, 17.0, 1.2, 2.6, 3.2, 0.0},
                                                 {800, 0.0, 22.0, 22.0, 5.0, 4.0, 4.5, 0.0}},
                                                std::nullopt},
                                               {"led-low",
                                                "LED low beam (model)",
                                                "UN R149 01 series class C passing beam rows, right-hand traffic",
                                                {{25000, 1.9, 2.2, 3.2, 0.6, 0.9, 0.8, 1.0},
                                                 {13000, 0.8, 8.0, 9.0, 0.9, 1.2, 1.2, 0.5},
                                                 {6500, 0.0, 22.0, 23.0, 1.9, 1.9, 2.6, 0.0},
                                                 {1500, 0.0, 26.0, 27.0, 6.0, 3.0, 4.5, 0.0}},
                                                CutOff{-0.57, 0.0, tan_15_deg, 7.0, 1.05, 0.12, 260.0, 16.0, 3.5}},
                                               {"led-high",
                                                "LED high beam (model)",
                                                "UN R149 01 series class B driving beam rows",
                                                {{52000, 0.0, 2.8, 2.8, 0.0, 1.2, 1.3, 0.0},
                                                 {18000, 0.0, 6.5, 6.5, 0.3, 1.8, 2.0, 0.0},
                                                 {4500, 0.0, 18.0, 18.0, 1.0, 2.8, 3.2, 0.0},
                                                 {900, 0.0, 23.0, 23.0, 5.0, 4.0, 4.5, 0.0}},
                                                std::nullopt},
                                               {"laser-spot",
                                                "laser spot booster of an LED high beam (model)",
                                                "UN R149 01 series class B driving beam rows together with led-high",
                                                {{110000, 0.0, 1.3, 1.3, 0.0, 1.0, 1.0, 0.0}},
                                                std::nullopt}};
    return models;
}

} // namespace fernlicht
