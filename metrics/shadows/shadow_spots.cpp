#include "metrics/shadows/shadow_spots.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

constexpr double surely = 0.9;

enum class Sure : std::uint8_t { no, lit, shadowed };

/// Least of each row's runs of 2 n + 1, then of the columns': whether all around are the same.
Image<Sure> beyond_doubt(const Image<Sure>& truth, int n) {
    const auto agree = [&](const Image<Sure>& from, int step_x, int step_y) {
        Image<Sure> out(from.width(), from.height());
        for (int y = 0; y < from.height(); ++y)
            for (int x = 0; x < from.width(); ++x) {
                Sure here = from.at(x, y);
                for (int i = -n; i <= n && here != Sure::no; ++i) {
                    const int nx = std::clamp(x + i * step_x, 0, from.width() - 1), ny = std::clamp(y + i * step_y, 0, from.height() - 1);
                    here = from.at(nx, ny) == here ? here : Sure::no;
                }
                out.at(x, y) = here;
            }
        return out;
    };
    return agree(agree(truth, 1, 0), 0, 1);
}

/// Empties the spot that holds a pixel; its size.
std::size_t take_spot(Image<std::uint8_t>& wrong, int x, int y) {
    const std::uint8_t kind = wrong.at(x, y);
    std::vector<std::pair<int, int>> open{{x, y}};
    wrong.at(x, y) = 0;
    std::size_t size = 0;
    while (!open.empty()) {
        const auto [px, py] = open.back();
        open.pop_back();
        ++size;
        for (int ny = std::max(0, py - 1); ny <= std::min(wrong.height() - 1, py + 1); ++ny)
            for (int nx = std::max(0, px - 1); nx <= std::min(wrong.width() - 1, px + 1); ++nx)
                if (wrong.at(nx, ny) == kind) {
                    wrong.at(nx, ny) = 0;
                    open.emplace_back(nx, ny);
                }
    }
    return size;
}

} // namespace

ShadowSpots& ShadowSpots::operator+=(const ShadowSpots& other) {
    acne += other.acne;
    acne_px += other.acne_px;
    leaks += other.leaks;
    leaks_px += other.leaks_px;
    sure_px += other.sure_px;
    return *this;
}

ShadowSpots shadow_spots(const ShadowImages& images, int doubt_px, double floor_lx) {
    check_sizes(images);
    if (doubt_px < 0)
        throw std::invalid_argument("shadows: a distance in doubt below 0");
    const int width = images.true_lx.width(), height = images.true_lx.height();
    constexpr std::uint8_t dark = 1, lit = 2;
    Image<Sure> truth(width, height);
    Image<std::uint8_t> wrong(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (const auto degrees = shadow_degrees(images, x, y, floor_lx)) {
                truth.at(x, y) = degrees->truth >= surely ? Sure::shadowed : degrees->truth <= 1.0 - surely ? Sure::lit : Sure::no;
                const bool drawn_dark = degrees->drawn > 0.5;
                if (truth.at(x, y) == Sure::lit && drawn_dark)
                    wrong.at(x, y) = dark;
                if (truth.at(x, y) == Sure::shadowed && !drawn_dark)
                    wrong.at(x, y) = lit;
            }
    const Image<Sure> sure = beyond_doubt(truth, doubt_px);
    ShadowSpots found;
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        if (sure.pixels()[i] == Sure::no)
            wrong.pixels()[i] = 0;
        else
            ++found.sure_px;
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (const std::uint8_t kind = wrong.at(x, y); kind != 0) {
                const std::size_t size = take_spot(wrong, x, y);
                ++(kind == dark ? found.acne : found.leaks);
                (kind == dark ? found.acne_px : found.leaks_px) += size;
            }
    return found;
}

} // namespace fernlicht
