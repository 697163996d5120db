#include "metrics/display/scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tbb/parallel_for.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr double degrees_a_radian = 180.0 / std::numbers::pi;
constexpr double haze_from_deg = 0.1, haze_to_deg = 30.0, haze_counted_from_deg = 2.5; // the last: ASTM D1003
constexpr int max_points = 4; // of the lattice on which a cell's veil is computed, to a side

/// Light of a cell: what it sends to the eye, and the direction of its centre.
struct ScatterCell {
    glm::vec3 lx{0.0F};
    glm::vec3 towards{0.0F};
};

/// Cells of one size, 2^level pixels.
using ScatterLevel = Image<ScatterCell>;

float weight(const glm::vec3& rgb) { return 0.2126F * rgb.x + 0.7152F * rgb.y + 0.0722F * rgb.z; }

/// Eye, pixels and their directions.
struct PictureRays {
    PictureRays(int w, int h, double vertical_fov_rad)
        : width(w), height(h), step(2.0 * std::tan(0.5 * vertical_fov_rad) / h), middle_x(0.5 * (w - 1)), middle_y(0.5 * (h - 1)) {}
    glm::vec3 towards(double x, double y) const {
        return glm::vec3(glm::normalize(glm::dvec3((x - middle_x) * step, (middle_y - y) * step, 1.0)));
    }
    /// step^2 cos^3
    double solid_angle_sr(int x, int y) const {
        const double u = (x - middle_x) * step, v = (y - middle_y) * step, q = 1.0 + u * u + v * v;
        return step * step / (q * std::sqrt(q));
    }
    int width, height;
    double step, middle_x, middle_y;
};

ScatterLevel finest(const Image<glm::vec3>& light, const PictureRays& rays) {
    ScatterLevel level(light.width(), light.height());
    tbb::parallel_for(0, light.height(), [&](int y) {
        for (int x = 0; x < light.width(); ++x)
            level.at(x, y) = {light.at(x, y) * static_cast<float>(rays.solid_angle_sr(x, y)), rays.towards(x, y)};
    });
    return level;
}

ScatterLevel coarser(const ScatterLevel& fine) {
    ScatterLevel level((fine.width() + 1) / 2, (fine.height() + 1) / 2);
    tbb::parallel_for(0, level.height(), [&](int y) {
        for (int x = 0; x < level.width(); ++x) {
            ScatterCell& cell = level.at(x, y);
            glm::vec3 centre(0.0F), middle(0.0F);
            for (int k = 2 * y; k < std::min(2 * y + 2, fine.height()); ++k)
                for (int i = 2 * x; i < std::min(2 * x + 2, fine.width()); ++i) {
                    const ScatterCell& part = fine.at(i, k);
                    cell.lx += part.lx;
                    centre += weight(part.lx) * part.towards;
                    middle += part.towards;
                }
            cell.towards = glm::normalize(glm::dot(centre, centre) > 0.0F ? centre : middle);
        }
    });
    return level;
}

/// f by the chord between two directions, c = 2 sin(theta / 2).
class ChordScatter {
  public:
    explicit ChordScatter(const ScatterFunction& f)
        : cube_(static_cast<float>(f.per_cube)), square_(static_cast<float>(f.per_square)), degree_(static_cast<float>(f.per_degree)),
          constant_(static_cast<float>(f.constant)), least2_(chord2(f.from_deg)), most2_(chord2(f.to_deg)) {}
    /// For 1 lx across its own direction: with cos(theta), as the eye that looks aside gets less of it.
    float operator()(const glm::vec3& from, const glm::vec3& to) const {
        const glm::vec3 apart = to - from;
        const float c2 = std::max(glm::dot(apart, apart), 1.0e-12F), c = std::sqrt(c2);
        // 2 asin(c / 2) = c (1 + c^2/24 + 3 c^4/640 + 5 c^6/7168 ...), within 1e-3 up to 90 degrees
        const float theta = static_cast<float>(degrees_a_radian) * c * (1.0F + c2 * (1.0F / 24.0F + c2 * (3.0F / 640.0F + c2 * (1.4e-3F))));
        const float inverse = 1.0F / theta, f = constant_ + inverse * (degree_ + inverse * (square_ + inverse * cube_));
        const float cosine = std::max(1.0F - 0.5F * c2, 0.0F);
        return c2 >= least2_ && c2 <= most2_ ? f * cosine : 0.0F;
    }

  private:
    static float chord2(double theta_deg) {
        const double chord = 2.0 * std::sin(0.5 * theta_deg / degrees_a_radian);
        return static_cast<float>(chord * chord);
    }
    float cube_, square_, degree_, constant_, least2_, most2_;
};

/// The veil of the cells of one level that are near enough to be looked at on it and too far for the next finer one.
class LevelVeil {
  public:
    LevelVeil(const std::vector<ScatterLevel>& levels, std::size_t k, const PictureRays& rays, const ChordScatter& f, int near_cells)
        : level_(levels[k]), coarsest_(k + 1 == levels.size()), size_(1 << k), points_(std::min(size_, max_points)),
          near_(k == 0 ? -1 : near_cells), far_(near_cells), rays_(rays), f_(f) {}

    /// Adds it for all pixels below the cell x, y.
    void add(int x, int y, Image<glm::vec3>& veil) const {
        std::array<glm::vec3, max_points * max_points> sums{}, towards{};
        const double step = points_ > 1 ? static_cast<double>(size_ - 1) / (points_ - 1) : 0.0;
        for (int k = 0; k < points_; ++k)
            for (int i = 0; i < points_; ++i)
                towards[index(i, k)] = rays_.towards(x * size_ + i * step, y * size_ + k * step);
        for_cells(x, y, [&](const ScatterCell& cell) {
            for (int n = 0; n < points_ * points_; ++n)
                sums[static_cast<std::size_t>(n)] += f_(cell.towards, towards[static_cast<std::size_t>(n)]) * cell.lx;
        });
        const int last_x = std::min((x + 1) * size_, veil.width()), last_y = std::min((y + 1) * size_, veil.height());
        for (int py = y * size_; py < last_y; ++py)
            for (int px = x * size_; px < last_x; ++px)
                veil.at(px, py) += points_ == size_ ? sums[index(px - x * size_, py - y * size_)]
                                                    : between(sums, (px - x * size_) / step, (py - y * size_) / step);
    }

  private:
    std::size_t index(int i, int k) const { return static_cast<std::size_t>(k * points_ + i); }

    /// Children of the neighbourhood of the cell's parent, without the cell's own neighbourhood.
    template <class Visit> void for_cells(int x, int y, Visit visit) const {
        const int first_x = coarsest_ ? 0 : std::max(2 * (x / 2 - far_), 0), first_y = coarsest_ ? 0 : std::max(2 * (y / 2 - far_), 0);
        const int last_x = coarsest_ ? level_.width() - 1 : std::min(2 * (x / 2 + far_) + 1, level_.width() - 1);
        const int last_y = coarsest_ ? level_.height() - 1 : std::min(2 * (y / 2 + far_) + 1, level_.height() - 1);
        for (int k = first_y; k <= last_y; ++k)
            for (int i = first_x; i <= last_x; ++i)
                if (std::max(std::abs(i - x), std::abs(k - y)) > near_ && level_.at(i, k).lx != glm::vec3(0.0F))
                    visit(level_.at(i, k));
    }

    glm::vec3 between(const std::array<glm::vec3, max_points * max_points>& sums, double at_x, double at_y) const {
        const int i = std::min(static_cast<int>(at_x), points_ - 2), k = std::min(static_cast<int>(at_y), points_ - 2);
        const auto u = static_cast<float>(at_x - i), v = static_cast<float>(at_y - k);
        return (1.0F - v) * ((1.0F - u) * sums[index(i, k)] + u * sums[index(i + 1, k)]) +
               v * ((1.0F - u) * sums[index(i, k + 1)] + u * sums[index(i + 1, k + 1)]);
    }

    const ScatterLevel& level_;
    bool coarsest_;
    int size_, points_, near_, far_;
    const PictureRays& rays_;
    const ChordScatter& f_;
};

/// What leaves a pixel in the middle of the picture for others, so that nothing is gained or lost: f falls so steeply that the sum over the
/// middles of near pixels is not its integral, and what is turned by less than a pixel stays in it.
double share_between_pixels(const ScatterFunction& function, double step) {
    constexpr int summed_px = 24;
    const double edge_deg = (summed_px + 0.5) * step * degrees_a_radian;
    ScatterFunction far = function;
    far.from_deg = std::max(function.from_deg, edge_deg * 2.0 / std::sqrt(std::numbers::pi)); // a circle of the square's area
    double share = far.share();
    for (int y = -summed_px; y <= summed_px; ++y)
        for (int x = -summed_px; x <= summed_px; ++x)
            if (const double tangent = step * std::hypot(x, y); tangent > 0.0) {
                const double cosine = 1.0 / std::hypot(1.0, tangent);
                share += function.at(std::atan(tangent) * degrees_a_radian) * step * step * std::pow(cosine, 4.0);
            }
    return share;
}

} // namespace

double ScatterFunction::at(double theta_deg) const {
    if (theta_deg < from_deg || theta_deg > to_deg)
        return 0.0;
    return constant + (per_degree + (per_square + per_cube / theta_deg) / theta_deg) / theta_deg;
}

double ScatterFunction::share() const {
    // In ln(theta), where f is smooth; Simpson.
    const double end = std::min(to_deg, 90.0), from_ln = std::log(from_deg), step = (std::log(end) - from_ln) / 4096.0;
    if (!(end > from_deg))
        return 0.0;
    double sum = 0.0;
    for (int i = 0; i <= 4096; ++i) {
        const double theta = i == 0 ? from_deg : i == 4096 ? end : std::exp(from_ln + i * step), rad = theta / degrees_a_radian;
        const double value = at(theta) * std::cos(rad) * 2.0 * std::numbers::pi * std::sin(rad) * rad;
        sum += (i == 0 || i == 4096 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * value;
    }
    return sum * step / 3.0;
}

ScatterFunction eye_scatter(const GlareEye& eye) {
    const double ageing = 1.0 + std::pow(eye.age_years / 62.5, 4.0), p = eye.pigmentation;
    return {10.0, 5.0 * ageing, 0.1 * p * ageing, 0.0025 * p, 0.1, 100.0};
}

ScatterFunction windscreen_scatter(double haze) {
    ScatterFunction unit{0.0, 1.0, 0.0, 0.0, haze_counted_from_deg, haze_to_deg};
    return {0.0, haze > 0.0 ? haze / unit.share() : 0.0, 0.0, 0.0, haze_from_deg, haze_to_deg};
}

Image<glm::vec3> scattered(const Image<glm::vec3>& light, double vertical_fov_rad, const ScatterFunction& function,
                           const ScatterOptions& options) {
    if (light.empty() || function.share() == 0.0)
        return light;
    const PictureRays rays(light.width(), light.height(), vertical_fov_rad);
    const double share = share_between_pixels(function, rays.step);
    std::vector<ScatterLevel> levels{finest(light, rays)};
    while (std::max(levels.back().width(), levels.back().height()) > 2 * options.near_cells + 1)
        levels.push_back(coarser(levels.back()));
    const ChordScatter f(function);
    Image<glm::vec3> veil(light.width(), light.height());
    for (std::size_t k = levels.size(); k-- > 0;) {
        const LevelVeil part(levels, k, rays, f, options.near_cells);
        tbb::parallel_for(0, levels[k].height(), [&](int y) {
            for (int x = 0; x < levels[k].width(); ++x)
                part.add(x, y, veil);
        });
    }
    const auto kept = static_cast<float>(1.0 - share);
    for (std::size_t i = 0; i < veil.size(); ++i)
        veil.pixels()[i] += kept * light.pixels()[i];
    return veil;
}

} // namespace fernlicht
