#include "renderer/projected_beam.h"

#include "scenarios/light/light.h"
#include "scenarios/photometry.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr TangentWindow widest;
constexpr double narrowest_tangent = 1e-3;
constexpr double cd_per_lx = 625.0; // E_m at 25 m
constexpr double near_m = 0.1;
constexpr int max_texels = 16384;
constexpr std::size_t max_error_samples = 4'000'000;

double tangent(double angle_deg) { return std::tan(radians(std::clamp(angle_deg, -89.9, 89.9))); }

/// y / z at an angle V seen under H.
double height_tangent(double h_deg, double v_deg) { return tangent(v_deg) / std::cos(radians(h_deg)); }

bool is_lit(const CandelaTable& table, std::size_t v, std::size_t h) {
    const bool gap = !table.gaps.empty() && table.gaps[v * (table.h_deg.size() - 1) + h] != 0;
    return !gap && (table.at(v, h) > 0.0 || table.at(v, h + 1) > 0.0 || table.at(v + 1, h) > 0.0 || table.at(v + 1, h + 1) > 0.0);
}

double texel_lx(const ProjectedBeam& beam, std::size_t index) {
    return beam.steps.empty() ? static_cast<double>(beam.lx[index])
                              : beam.steps[index] / static_cast<double>(largest_step(beam.bits)) * beam.scale_lx;
}

void quantise(ProjectedBeam& beam) {
    beam.steps.reserve(beam.lx.size());
    for (const float lx : beam.lx)
        beam.steps.push_back(
            beam.scale_lx > 0.0 ? static_cast<std::uint16_t>(std::lround(static_cast<double>(lx) / beam.scale_lx * largest_step(beam.bits)))
                                : std::uint16_t{0});
}

struct WorstError {
    double error_lx = 0.0, largest_lx = 0.0;
};

WorstError worse_of(const WorstError& a, const WorstError& b) {
    return {std::max(a.error_lx, b.error_lx), std::max(a.largest_lx, b.largest_lx)};
}

/// Over the window in quarters of a texel; large textures in halves, and with rows left out.
double worst_error_of_peak(const ProjectedBeam& beam, const std::function<double(double, double)>& illuminance_lx) {
    const TangentWindow& window = beam.window;
    const auto width = static_cast<std::size_t>(beam.width), height = static_cast<std::size_t>(beam.height);
    const std::size_t parts = width * height * 16 <= max_error_samples ? 4 : 2;
    const std::size_t row_step = 1 + width * height * parts * parts / (max_error_samples + 1);
    std::vector<WorstError> of_row((height * parts + row_step - 1) / row_step);
    oneapi::tbb::parallel_for(std::size_t{0}, of_row.size(), [&](std::size_t row) {
        const double t = static_cast<double>(row * row_step) / static_cast<double>(height * parts);
        const double y = window.bottom + (window.top - window.bottom) * t;
        for (std::size_t column = 0; column < width * parts; ++column) {
            const double s = static_cast<double>(column) / static_cast<double>(width * parts);
            const double truth = illuminance_lx(window.left + (window.right - window.left) * s, y);
            of_row[row] = worse_of(of_row[row], {std::abs(projected_lx(beam, s, t) - truth), truth});
        }
    });
    WorstError worst;
    for (const WorstError& row : of_row)
        worst = worse_of(worst, row);
    return worst.largest_lx > 0.0 ? worst.error_lx / worst.largest_lx : 0.0;
}

/// P of an infinite frustum in OpenGL's convention, -1..1; its last row is q in terms of x, y, z and 1.
glm::dmat4 biased(const TangentWindow& w, const glm::dvec4& last_row) {
    glm::dmat4 projection(0.0);
    projection[0][0] = 2.0 / (w.right - w.left);
    projection[2][0] = -(w.right + w.left) / (w.right - w.left);
    projection[1][1] = 2.0 / (w.top - w.bottom);
    projection[2][1] = -(w.top + w.bottom) / (w.top - w.bottom);
    projection[2][2] = 1.0;
    projection[3][2] = -2.0 * near_m;
    for (int column = 0; column < 4; ++column)
        projection[column][3] = last_row[column];
    glm::dmat4 bias(0.5); // [-1, 1] to [0, 1]
    bias[3] = {0.5, 0.5, 0.5, 1.0};
    return bias * projection;
}

constexpr double exact_at_m = 25.0;
constexpr int window_steps = 32; // along each edge of a lamp's window

bool is_on(const LitLamp& lamp) { return lamp.intensity_factor > 0.0; }

glm::dvec3 unit_or_refuse(const glm::dvec3& sum, const char* axes) {
    if (glm::length(sum) < 1e-6)
        throw InputError({{}, 0, 0, "lamps"}, std::string("found lamps whose ") + axes + " cancel",
                         "lamps that can be merged into one beam");
    return glm::normalize(sum);
}

/// In the frame of `pose` the point 25 m from it that lies in `direction` from `lamp`. Lamps stand nearer than 25 m to their middle.
glm::dvec3 point_at_distance(const Pose& pose, const Pose& lamp, const glm::dvec3& direction) {
    const glm::dvec3 from = to_local(pose, lamp.position_m);
    const glm::dvec3 along = glm::normalize(direction * pose.axes);
    const double half = glm::dot(from, along);
    const double root = half * half + exact_at_m * exact_at_m - glm::dot(from, from);
    return from + along * (std::sqrt(std::max(root, 0.0)) - half);
}

/// `window` widened to the tangents of what the lamp's own window sees at 25 m.
void widen(TangentWindow& window, const Pose& pose, const LitLamp& lamp) {
    const TangentWindow own = lit_window(lamp.file->table);
    for (int i = 0; i <= window_steps; ++i)
        for (int k = 0; k <= window_steps; ++k) {
            const double x = own.left + (own.right - own.left) * i / window_steps;
            const double y = own.bottom + (own.top - own.bottom) * k / window_steps;
            const glm::dvec3 p = point_at_distance(pose, lamp.pose, lamp.pose.forward() - lamp.pose.left() * x + lamp.pose.up() * y);
            if (p.x <= 0.0)
                continue;
            window.left = std::min(window.left, -p.y / p.x);
            window.right = std::max(window.right, -p.y / p.x);
            window.bottom = std::min(window.bottom, p.z / p.x);
            window.top = std::max(window.top, p.z / p.x);
        }
}

TangentWindow window_of(std::span<const LitLamp> lamps, const Pose& pose) {
    const TangentWindow widest;
    TangentWindow window{widest.right, widest.left, widest.top, widest.bottom}; // nothing yet
    for (const LitLamp& lamp : lamps)
        if (is_on(lamp) && peak_of(lamp.file->table).cd > 0.0)
            widen(window, pose, lamp);
    window = {std::max(window.left, widest.left), std::min(window.right, widest.right), std::max(window.bottom, widest.bottom),
              std::min(window.top, widest.top)};
    return window.left < window.right && window.bottom < window.top ? window : widest;
}

} // namespace

TangentWindow lit_window(const CandelaTable& table) {
    TangentWindow w{widest.right, widest.left, widest.top, widest.bottom}; // nothing yet
    for (std::size_t v = 0; v + 1 < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < table.h_deg.size(); ++h) {
            const double from = std::max(table.h_deg[h], degrees(std::atan(widest.left)));
            const double to = std::min(table.h_deg[h + 1], degrees(std::atan(widest.right)));
            if (from >= to || !is_lit(table, v, h))
                continue;
            w.left = std::min(w.left, tangent(from));
            w.right = std::max(w.right, tangent(to));
            for (const double at : {from, to, std::clamp(0.0, from, to)}) { // y / z of one V is extreme at these
                w.bottom = std::min(w.bottom, height_tangent(at, table.v_deg[v]));
                w.top = std::max(w.top, height_tangent(at, table.v_deg[v + 1]));
            }
        }
    w = {std::max(w.left, widest.left), std::min(w.right, widest.right), std::max(w.bottom, widest.bottom), std::min(w.top, widest.top)};
    if (w.left >= w.right || w.bottom >= w.top)
        return widest;
    w.right = std::max(w.right, w.left + narrowest_tangent);
    w.top = std::max(w.top, w.bottom + narrowest_tangent);
    return w;
}

ProjectedBeam sampled_beam(const TangentWindow& window, const BeamTexels& texels,
                           const std::function<double(double, double)>& illuminance_lx) {
    const int width = texels.width, height = texels.height;
    if (width < 1 || height < 1 || width > max_texels || height > max_texels)
        throw std::invalid_argument(fmt::format("projected beam: {} x {} texels, expected 1 to {} each way", width, height, max_texels));
    ProjectedBeam beam;
    beam.width = width;
    beam.height = height;
    beam.window = window;
    beam.lx.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    oneapi::tbb::parallel_for(0, height, [&](int row) {
        const double y = window.bottom + (window.top - window.bottom) * (row + 0.5) / height;
        for (int column = 0; column < width; ++column) {
            const double x = window.left + (window.right - window.left) * (column + 0.5) / width;
            beam.lx[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] =
                static_cast<float>(illuminance_lx(x, y));
        }
    });
    beam.scale_lx = static_cast<double>(*std::ranges::max_element(beam.lx));
    if (texels.bits < 32) {
        beam.bits = texels.bits;
        quantise(beam);
        beam.lx.clear();
    }
    beam.worst_error_of_peak = worst_error_of_peak(beam, illuminance_lx);
    return beam;
}

ProjectedBeam make_projected_beam(const CandelaTable& table, const BeamTexels& texels) {
    const auto illuminance_lx = [&](double x, double y) {
        const glm::dvec2 angles = photometry::goniometer_angles({x, y, 1.0});
        return intensity_cd(table, degrees(angles.x), degrees(angles.y)) / cd_per_lx;
    };
    return sampled_beam(lit_window(table), texels, illuminance_lx);
}

double projected_lx(const ProjectedBeam& beam, double s, double t) {
    if (!(s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0))
        return 0.0;
    const double x = std::clamp(s * beam.width - 0.5, 0.0, beam.width - 1.0), y = std::clamp(t * beam.height - 0.5, 0.0, beam.height - 1.0);
    const auto left = static_cast<std::size_t>(x), lower = static_cast<std::size_t>(y), width = static_cast<std::size_t>(beam.width);
    const std::size_t right = std::min(left + 1, width - 1), upper = std::min(lower + 1, static_cast<std::size_t>(beam.height) - 1);
    return photometry::bilinear(texel_lx(beam, lower * width + left), texel_lx(beam, lower * width + right),
                                texel_lx(beam, upper * width + left), texel_lx(beam, upper * width + right),
                                {x - static_cast<double>(left), y - static_cast<double>(lower)});
}

glm::dmat4 texture_from_lamp(const TangentWindow& window) { return biased(window, {0.0, 0.0, 1.0, 0.0}); }

glm::dmat4 texture_from_lamp_as_printed(const TangentWindow& window) { return biased(window, {0.0, 0.0, 1.0, 1.0}); }

std::vector<LitLamp> shining_in(const Pose& pose, std::span<const LitLamp> lamps) {
    std::vector<LitLamp> on;
    for (const LitLamp& lamp : lamps)
        if (is_on(lamp)) {
            on.push_back(lamp);
            on.back().pose = {to_local(pose, lamp.pose.position_m), glm::transpose(pose.axes) * lamp.pose.axes};
        }
    return on;
}

Pose merged_pose(std::span<const LitLamp> lamps) {
    glm::dvec3 position(0.0), forward(0.0), up(0.0);
    int count = 0;
    for (const LitLamp& lamp : lamps) {
        if (!is_on(lamp))
            continue;
        ++count;
        position += (lamp.pose.position_m - position) / static_cast<double>(count);
        forward += lamp.pose.forward();
        up += lamp.pose.up();
    }
    if (count == 0)
        return {};
    Pose pose;
    pose.position_m = position;
    pose.axes[0] = unit_or_refuse(forward, "axes");
    pose.axes[1] = unit_or_refuse(glm::cross(up, pose.axes[0]), "upward axes");
    pose.axes[2] = glm::cross(pose.axes[0], pose.axes[1]);
    return pose;
}

ProjectedBeam make_merged_beam(std::span<const LitLamp> lamps, const BeamTexels& texels) {
    const Pose pose = merged_pose(lamps);
    Moment moment;
    moment.lamps = shining_in(pose, lamps); // where no map's millions of metres cost digits
    const TangentWindow window = window_of(moment.lamps, {});
    return sampled_beam(window, texels, [&](double x, double y) {
        return target_illuminance_lx(moment, exact_at_m * glm::normalize(glm::dvec3(1.0, -x, y)));
    });
}

} // namespace fernlicht
