#include "runner/experiments/accuracy/edge_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fernlicht {
namespace {

constexpr int square_px = 16, beside_px = 2;

std::optional<EdgePixels> edge_pixel(const Image<std::uint8_t>& mixed, int x, int y) {
    if (const std::uint8_t marks = mixed.at(x, y))
        return (marks & several_surfaces) != 0 ? EdgePixels::surfaces : EdgePixels::shadow;
    for (int v = std::max(0, y - beside_px); v <= std::min(mixed.height() - 1, y + beside_px); ++v)
        for (int u = std::max(0, x - beside_px); u <= std::min(mixed.width() - 1, x + beside_px); ++u)
            if (mixed.at(u, v) != 0)
                return EdgePixels::beside;
    return std::nullopt;
}

} // namespace

void EdgeErrorFold::add(const Image<float>& tested, const Image<float>& ray, const ReferenceImage& areas) {
    for (int y = 0; y < tested.height(); ++y)
        for (int x = 0; x < tested.width(); ++x) {
            const std::optional<EdgePixels> of = edge_pixel(areas.mixed, x, y);
            if (!of)
                continue;
            const auto lux = [&](const Image<float>& image) { return static_cast<double>(image.at(x, y)); };
            const double right = lux(areas.illuminance_lx.mean), error = lux(tested) - right;
            for (Kind* const kind : {&kinds_[*of], &kinds_[EdgePixels::all]}) {
                ++kind->pixels;
                kind->absolute += std::abs(error);
                if (right >= floor_lx_) {
                    ++kind->lit;
                    kind->shares += error / right;
                }
                Sums& square = kind->squares[{pictures_, y / square_px, x / square_px}];
                square.error += error;
                square.beyond_ray += lux(tested) - lux(ray);
                square.right += right;
            }
        }
    ++pictures_;
}

LightAtEdges EdgeErrorFold::error_of(EdgePixels pixels) const {
    const auto found = kinds_.find(pixels);
    if (found == kinds_.end())
        return {};
    const Kind& kind = found->second;
    Sums all;
    for (const auto& [place, square] : kind.squares) {
        all.error += square.error;
        all.beyond_ray += square.beyond_ray;
        all.right += square.right;
    }
    LightAtEdges e{.pixels = kind.pixels};
    if (all.right <= 0.0)
        return e;
    e.mean = all.error / all.right;
    e.beyond_ray = all.beyond_ray / all.right;
    double scatter = 0.0, ray_scatter = 0.0; // of a quotient of sums over independent squares (Cochran 1977, section 2.11)
    for (const auto& [place, square] : kind.squares) {
        scatter += std::pow(square.error - e.mean * square.right, 2);
        ray_scatter += std::pow(square.beyond_ray - e.beyond_ray * square.right, 2);
    }
    e.mean_standard_error = std::sqrt(scatter) / all.right;
    e.beyond_ray_standard_error = std::sqrt(ray_scatter) / all.right;
    e.absolute = kind.absolute / all.right;
    e.mean_of_shares = kind.lit > 0 ? kind.shares / static_cast<double>(kind.lit) : 0.0;
    return e;
}

EdgeRow EdgeErrorFold::finish() const {
    return {way_, error_of(EdgePixels::shadow), error_of(EdgePixels::surfaces), error_of(EdgePixels::beside), error_of(EdgePixels::all)};
}

} // namespace fernlicht
