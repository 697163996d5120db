#include "scenarios/lamps/goniometer.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// A stored plane, or its mirror image, at an H.
struct PlacedPlane {
    double h_deg;
    std::size_t plane;
};

/// Within (-180, 180].
double wrapped(double angle) {
    const double r = std::remainder(angle, 360.0);
    return r <= -180.0 + 1e-9 ? 180.0 : r + 0.0; // no negative zero
}

std::vector<double> images(double c, PlaneSymmetry symmetry) {
    switch (symmetry) {
    case PlaneSymmetry::about_c0_c180:
        return {c, -c};
    case PlaneSymmetry::about_c90_c270:
        return {c, 180.0 - c};
    case PlaneSymmetry::quadrants:
        return {c, -c, 180.0 - c, 180.0 + c};
    default:
        return {c};
    }
}

double largest_difference(const MeasuredGrid& planes, std::size_t a, std::size_t b) {
    double worst = 0.0;
    for (std::size_t g = 0; g < planes.v_deg.size(); ++g)
        worst = std::max(worst, std::abs(planes.cd[g * planes.h_deg.size() + a] - planes.cd[g * planes.h_deg.size() + b]));
    return worst;
}

/// All planes round the turn by ascending H; a direction that is stored twice (0 and 360) is taken once.
std::vector<PlacedPlane> placed(const MeasuredGrid& planes, PlaneSymmetry symmetry, double forward_c_deg, Notes* notes) {
    std::vector<PlacedPlane> all;
    for (std::size_t i = 0; i < planes.h_deg.size(); ++i)
        for (const double c : images(planes.h_deg[i], symmetry))
            all.push_back({wrapped(forward_c_deg - c), i});
    std::stable_sort(all.begin(), all.end(), [](const PlacedPlane& a, const PlacedPlane& b) { return a.h_deg < b.h_deg; });
    std::vector<PlacedPlane> out;
    for (const PlacedPlane& p : all) {
        if (out.empty() || p.h_deg - out.back().h_deg > 1e-9) {
            out.push_back(p);
            continue;
        }
        const std::size_t kept = out.back().plane;
        if (const double cd = largest_difference(planes, kept, p.plane); notes && cd > 0.0)
            notes->push_back(fmt::format("Planes C {} and C {} are one direction but differ by up to {} cd: the first is taken.",
                                         planes.h_deg[kept], planes.h_deg[p.plane], cd));
    }
    return out;
}

/// What the listed planes leave of the turn between the last and the first; 0 when that is no more than 1.5 of their steps.
double hole_deg(const MeasuredGrid& planes, PlaneSymmetry symmetry) {
    if (symmetry != PlaneSymmetry::none)
        return 0.0;
    const std::vector<double>& c = planes.h_deg;
    double step = 0.0;
    for (std::size_t i = 1; i < c.size(); ++i)
        step = std::max(step, c[i] - c[i - 1]);
    const double hole = 360.0 - (c.back() - c.front());
    return hole > 1.5 * step + 1e-9 ? hole : 0.0;
}

/// Marks the cells between the last plane and the first.
void mark_hole(CandelaTable& table, const MeasuredGrid& planes, double forward_c_deg, double hole) {
    const double middle = forward_c_deg - planes.h_deg.back() - hole / 2.0;
    const std::size_t columns = table.h_deg.size() - 1, rows = table.v_deg.size() - 1;
    table.gaps.assign(rows * columns, 0);
    for (std::size_t x = 0; x < columns; ++x)
        if (std::abs(std::remainder((table.h_deg[x] + table.h_deg[x + 1]) / 2.0 - middle, 360.0)) < hole / 2.0)
            for (std::size_t y = 0; y < rows; ++y)
                table.gaps[y * columns + x] = 1;
}

/// The table round the luminaire's own axis, C = forward_c_deg at H = 0.
CandelaTable about_vertical(const MeasuredGrid& planes, PlaneSymmetry symmetry, double forward_c_deg, BetweenSamples rule, Notes* notes) {
    CandelaTable table;
    table.rule = rule;
    for (const double gamma : planes.v_deg)
        table.v_deg.push_back(gamma - 90.0);
    const std::size_t stored = planes.h_deg.size();
    const std::vector<PlacedPlane> turn = placed(planes, symmetry, forward_c_deg, notes);
    if (symmetry == PlaneSymmetry::rotational || turn.size() == 1) { // one plane listed as C 0 and 360 is one too
        table.h_deg = {-180.0, 180.0};
        for (std::size_t g = 0; g < planes.v_deg.size(); ++g)
            table.cd.insert(table.cd.end(), 2, planes.cd[g * stored]);
        return table;
    }
    // The axis runs from -180 to 180: the plane at 180, interpolated if there is none, stands at both ends.
    const double first = turn.front().h_deg, last = turn.back().h_deg;
    const double fraction = (180.0 - last) / (first + 360.0 - last);
    table.h_deg.push_back(-180.0);
    for (const PlacedPlane& p : turn)
        table.h_deg.push_back(p.h_deg);
    if (last < 180.0)
        table.h_deg.push_back(180.0);
    for (std::size_t g = 0; g < planes.v_deg.size(); ++g) {
        const auto at = [&](const PlacedPlane& p) { return planes.cd[g * stored + p.plane]; };
        const double seam = at(turn.back()) * (1.0 - fraction) + at(turn.front()) * fraction;
        table.cd.push_back(seam);
        for (const PlacedPlane& p : turn)
            table.cd.push_back(at(p));
        if (last < 180.0)
            table.cd.push_back(seam);
    }
    if (const double hole = hole_deg(planes, symmetry); hole > 0.0) {
        mark_hole(table, planes, forward_c_deg, hole);
        if (notes)
            notes->push_back(fmt::format("The C planes leave {} degrees of the turn open: no data there.", hole));
    }
    return table;
}

/// Integral of I times the unit vector (x right, y up, z forward) over that of I, by steps of at most 3 degrees within each cell: 0 for
/// light to all sides, length 1 for a ray.
glm::dvec3 mean_direction(const CandelaTable& table) {
    glm::dvec3 sum(0.0);
    double total = 0.0;
    const auto parts = [](double width) { return static_cast<int>(std::ceil(width / 3.0)); };
    for (std::size_t y = 0; y + 1 < table.v_deg.size(); ++y)
        for (std::size_t x = 0; x + 1 < table.h_deg.size(); ++x) {
            const double width = table.h_deg[x + 1] - table.h_deg[x], height = table.v_deg[y + 1] - table.v_deg[y];
            const int nh = parts(width), nv = parts(height);
            for (int j = 0; j < nv; ++j)
                for (int i = 0; i < nh; ++i) {
                    const double h = table.h_deg[x] + width * (i + 0.5) / nh, v = table.v_deg[y] + height * (j + 0.5) / nv;
                    const double light = intensity_cd(table, h, v) * std::cos(radians(v)) * width * height / (nh * nv);
                    sum += light * direction_of(h, v);
                    total += light;
                }
        }
    return total > 0.0 ? sum / total : sum;
}

} // namespace

void from_c_planes(const MeasuredGrid& planes, PlaneSymmetry symmetry, const LampReadOptions& options, LampFile& lamp) {
    Notes& notes = lamp.notes;
    CandelaTable table = about_vertical(planes, symmetry, 0.0, options.rule, &notes);
    mark_padding(table, notes);
    const glm::dvec3 mean = mean_direction(table);
    const double from_nadir_deg = degrees(std::atan2(std::hypot(mean.x, mean.z), -mean.y));
    constexpr double nowhere = 1e-3; // shorter than this, the mean is rounding and asymmetry in the last digits
    TypeCAxis axis = options.type_c_axis;
    if (axis == TypeCAxis::automatic) {
        const bool to_all_sides = glm::length(mean) < nowhere;
        axis = !to_all_sides && from_nadir_deg < 45.0 ? TypeCAxis::nadir : TypeCAxis::horizontal;
        notes.push_back(to_all_sides
                            ? "The light has no mean direction: gamma 90 is taken as the horizon."
                            : fmt::format("The light's mean direction lies {:.0f} degrees from gamma 0: {}.", from_nadir_deg,
                                          axis == TypeCAxis::nadir ? "gamma 0 is taken as forward" : "gamma 90 is taken as the horizon"));
    }
    if (axis == TypeCAxis::nadir) {
        bring_onto_goniometer(std::move(table), beam_along_nadir(), lamp);
        return;
    }
    const bool sideways = std::hypot(mean.x, mean.z) > nowhere; // H of the mean is -C of the mean
    const double forward_c_deg = sideways ? std::remainder(90.0 * std::round(degrees(std::atan2(-mean.x, mean.z)) / 90.0), 360.0) : 0.0;
    notes.push_back(fmt::format("Plane C {} is taken as forward.", std::lround(forward_c_deg + 360.0) % 360));
    if (forward_c_deg != 0.0) {
        table = about_vertical(planes, symmetry, forward_c_deg, options.rule, nullptr);
        Notes said_already;
        mark_padding(table, said_already);
    }
    lamp.table = std::move(table);
}

} // namespace fernlicht
