#include "metrics/aliasing/jaggedness.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

constexpr double around_px = 32.0;
constexpr std::size_t fewest_points = 16;

struct Deviation {
    double x = 0.0, y = 0.0; ///< pixels, centres at .5
    double across_px = 0.0;
};

/// Where a straight line of samples at first, first + step ... crosses the level, as a coordinate; nullopt where it does not.
std::optional<double> crossing(double a, double b, double level, double at_a, double step) {
    if ((a < level) == (b < level))
        return std::nullopt;
    return at_a + step * (level - a) / (b - a);
}

/// The reference's crossing nearest to `at` along a row or a column of its samples, that rises as the tested one does.
std::optional<double> nearest_crossing(const Image<float>& reference, int k, double level, bool along_x, double at, double beside,
                                       bool rises, double search_px) {
    const int count = along_x ? reference.width() : reference.height(), lines = along_x ? reference.height() : reference.width();
    // The centre of a pixel lies between two lines of samples when k is even.
    const int line = std::clamp(static_cast<int>(std::lround(beside * k - 0.5)), 0, lines - 1);
    const auto value = [&](int i) { return static_cast<double>(along_x ? reference.at(i, line) : reference.at(line, i)); };
    const int first = std::max(0, static_cast<int>(std::floor((at - search_px) * k - 0.5)));
    const int last = std::min(count - 1, static_cast<int>(std::ceil((at + search_px) * k - 0.5)));
    std::optional<double> nearest;
    for (int i = first; i < last; ++i) {
        const auto found = crossing(value(i), value(i + 1), level, (i + 0.5) / k, 1.0 / k);
        if (found && (value(i) < level) == rises && std::abs(*found - at) <= search_px &&
            (!nearest || std::abs(*found - at) < std::abs(*nearest - at)))
            nearest = found;
    }
    return nearest;
}

/// How the picture rises about (x, y): under the derivative of a Gaussian of 2 pixels, which finds the direction of a step and not that of
/// its stairs (Canny 1986). In no particular unit.
std::pair<double, double> gradient(const Image<float>& picture, int x, int y) {
    constexpr int reach = 5;
    double along_x = 0.0, along_y = 0.0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const double value =
                static_cast<double>(picture.at(std::clamp(x + dx, 0, picture.width() - 1), std::clamp(y + dy, 0, picture.height() - 1)));
            const double weighted = value * std::exp(-0.125 * (dx * dx + dy * dy));
            along_x += dx * weighted;
            along_y += dy * weighted;
        }
    return {along_x, along_y};
}

void add_crossings(const Image<float>& tested, const Image<float>& reference, int k, double level, bool along_x, double search_px,
                   const Image<std::uint8_t>& where, std::vector<Deviation>& deviations, Jaggedness& found) {
    for (int y = 0; y + (along_x ? 0 : 1) < tested.height(); ++y)
        for (int x = 0; x + (along_x ? 1 : 0) < tested.width(); ++x) {
            const double a = static_cast<double>(tested.at(x, y));
            const double b = static_cast<double>(along_x ? tested.at(x + 1, y) : tested.at(x, y + 1));
            const auto at = crossing(a, b, level, (along_x ? x : y) + 0.5, 1.0);
            if (!at || (!where.empty() && (where.at(x, y) == 0 || (along_x ? where.at(x + 1, y) : where.at(x, y + 1)) == 0)))
                continue;
            const auto [first_x, first_y] = gradient(tested, x, y);
            const auto [second_x, second_y] = gradient(tested, along_x ? x + 1 : x, along_x ? y : y + 1);
            const double gx = std::abs(first_x + second_x), gy = std::abs(first_y + second_y);
            if (along_x ? gx < gy : gy <= gx)
                continue; // the other direction takes this piece of the line
            const double beside = (along_x ? y : x) + 0.5;
            const auto expected = nearest_crossing(reference, k, level, along_x, *at, beside, a < level, search_px);
            if (!expected) {
                ++found.without;
                continue;
            }
            const double cosine = (along_x ? gx : gy) / std::hypot(gx, gy);
            deviations.push_back({along_x ? *at : beside, along_x ? beside : *at, (*at - *expected) * cosine});
        }
}

/// Each less the mean of those within around_px.
std::vector<double> without_slow(const std::vector<Deviation>& deviations) {
    std::vector<double> fast;
    for (const Deviation& one : deviations) {
        double sum = 0.0;
        std::size_t count = 0;
        for (const Deviation& other : deviations)
            if (std::abs(other.x - one.x) <= around_px && std::abs(other.y - one.y) <= around_px) {
                sum += other.across_px;
                ++count;
            }
        fast.push_back(one.across_px - sum / static_cast<double>(count));
    }
    return fast;
}

struct Piece {
    double points = 0.0, squares = 0.0;
};

/// Of the root of `mean`, a ratio of sums over pieces (Cochran 1977, Sampling Techniques, 6.4): neighbouring points go up and down
/// together.
double standard_error(const std::map<std::pair<int, int>, Piece>& pieces, double mean, std::size_t points) {
    if (pieces.size() < 2 || !(mean > 0.0))
        return 0.0;
    double spread = 0.0;
    for (const auto& [place, piece] : pieces)
        spread += (piece.squares - mean * piece.points) * (piece.squares - mean * piece.points);
    const double count = static_cast<double>(pieces.size());
    return std::sqrt(count / (count - 1.0) * spread) / static_cast<double>(points) / (2.0 * std::sqrt(mean));
}

} // namespace

std::optional<Jaggedness> measure_jaggedness(const Image<float>& tested, const Image<float>& reference, int k, double level,
                                             double search_px, const Image<std::uint8_t>& where) {
    if (k < 1 || (!where.empty() && (where.width() != tested.width() || where.height() != tested.height())) || tested.empty() ||
        reference.width() != k * tested.width() || reference.height() != k * tested.height() || !std::isfinite(level) || !(search_px > 0.0))
        throw std::invalid_argument(fmt::format("lines at {} in {}x{} pixels cannot be held against {}x{}, {} times as fine", level,
                                                tested.width(), tested.height(), reference.width(), reference.height(), k));
    Jaggedness found;
    std::vector<Deviation> deviations;
    add_crossings(tested, reference, k, level, true, search_px, where, deviations, found);
    add_crossings(tested, reference, k, level, false, search_px, where, deviations, found);
    if (deviations.size() < fewest_points)
        return std::nullopt;
    found.points = deviations.size();
    double squares = 0.0;
    std::map<std::pair<int, int>, Piece> pieces;
    const std::vector<double> fast = without_slow(deviations);
    for (std::size_t i = 0; i < fast.size(); ++i) {
        squares += fast[i] * fast[i];
        Piece& piece = pieces[{static_cast<int>(deviations[i].x / around_px), static_cast<int>(deviations[i].y / around_px)}];
        piece.points += 1.0;
        piece.squares += fast[i] * fast[i];
        found.worst_px = std::max(found.worst_px, std::abs(fast[i]));
    }
    const double mean = squares / static_cast<double>(found.points);
    found.rms_px = std::sqrt(mean);
    found.standard_error_px = standard_error(pieces, mean, found.points);
    return found;
}

} // namespace fernlicht
