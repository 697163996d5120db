#include "metrics/seeing/homogeneity.h"

#include "metrics/glare/glare.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double window_ln = 0.25, window_m = 1.75;

void check(const LaneLight& light) {
    const std::size_t points = light.ahead_m.size() * light.offset_m.size();
    if (light.lx.size() != points || light.seen_at.size() != points || (!light.ahead_m.empty() && !(light.ahead_m.front() > 0.0)))
        throw std::invalid_argument("a lane's light of a wrong number of points, or beside the lamps");
}

void take(Gradient& largest, const LaneLight& light, std::size_t a, std::size_t b, double metres, double min_lx) {
    if (light.lx[a] < min_lx || light.lx[b] < min_lx)
        return;
    const double change = std::abs(std::log10(light.lx[b] / light.lx[a])), angle = angle_between_deg(light.seen_at[a], light.seen_at[b]);
    if (const double per_m = change / metres; per_m > largest.per_m) {
        largest.per_m = per_m;
        largest.per_m_between = {a, b};
    }
    if (angle > 0.0 && change / angle > largest.per_degree) {
        largest.per_degree = change / angle;
        largest.per_degree_between = {a, b};
    }
}

/// Sums of a least-squares plane z = a + b x + c y about the point itself; its value there is a.
struct PlaneSums {
    double n = 0.0, x = 0.0, y = 0.0, z = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0;
    void add(double px, double py, double pz) {
        n += 1.0;
        x += px;
        y += py;
        z += pz;
        xx += px * px;
        xy += px * py;
        yy += py * py;
        xz += px * pz;
        yz += py * pz;
    }
    /// nullopt: too few points, or all on a line.
    std::optional<double> at_origin() const {
        const double mx = x / n, my = y / n, mz = z / n;
        const double cxx = xx / n - mx * mx, cxy = xy / n - mx * my, cyy = yy / n - my * my;
        const double cxz = xz / n - mx * mz, cyz = yz / n - my * mz, determinant = cxx * cyy - cxy * cxy;
        if (n < 9.0 || determinant <= 1e-9 * cxx * cyy)
            return std::nullopt;
        return mz - (cxz * cyy - cyz * cxy) / determinant * mx - (cyz * cxx - cxz * cxy) / determinant * my;
    }
};

/// lg of the light over the smooth surface; nullopt where dark or not known.
std::vector<std::optional<double>> residuals(const LaneLight& light, double min_lx) {
    const std::size_t rows = light.ahead_m.size(), columns = light.offset_m.size();
    std::vector<double> lg(light.lx.size()), ln(rows);
    for (std::size_t i = 0; i < lg.size(); ++i)
        lg[i] = light.lx[i] >= min_lx ? std::log10(light.lx[i]) : 0.0;
    for (std::size_t r = 0; r < rows; ++r)
        ln[r] = std::log(light.ahead_m[r]);
    std::vector<std::optional<double>> result(light.lx.size());
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            if (light.lx[r * columns + c] < min_lx)
                continue;
            PlaneSums sums;
            for (std::size_t k = 0; k < rows; ++k) {
                if (std::abs(ln[k] - ln[r]) > window_ln)
                    continue;
                for (std::size_t m = 0; m < columns; ++m)
                    if (light.lx[k * columns + m] >= min_lx && std::abs(light.offset_m[m] - light.offset_m[c]) <= window_m)
                        sums.add(ln[k] - ln[r], light.offset_m[m] - light.offset_m[c], lg[k * columns + m]);
            }
            if (const std::optional<double> smooth = sums.at_origin())
                result[r * columns + c] = lg[r * columns + c] - *smooth;
        }
    return result;
}

Patches connected(const cv::Mat& inside, double row_m) {
    cv::Mat labels, stats, middles;
    Patches patches;
    patches.count = cv::connectedComponentsWithStats(inside, labels, stats, middles, 4) - 1; // the first is all that is outside
    for (int i = 1; i <= patches.count; ++i)
        patches.longest_m = std::max(patches.longest_m, stats.at<int>(i, cv::CC_STAT_HEIGHT) * row_m);
    return patches;
}

} // namespace

Gradients largest_gradients(const LaneLight& light, double min_lx) {
    check(light);
    Gradients gradients;
    const std::size_t rows = light.ahead_m.size(), columns = light.offset_m.size();
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            const std::size_t here = r * columns + c;
            if (r + 1 < rows)
                take(gradients.along, light, here, here + columns, light.ahead_m[r + 1] - light.ahead_m[r], min_lx);
            if (c + 1 < columns)
                take(gradients.across, light, here, here + 1, light.offset_m[c + 1] - light.offset_m[c], min_lx);
        }
    return gradients;
}

Unevenness patches(const LaneLight& light, double min_lx, double factor) {
    check(light);
    if (light.ahead_m.size() < 2 || light.offset_m.empty())
        return {};
    const double limit = std::log10(factor);
    cv::Mat_<std::uint8_t> dark(static_cast<int>(light.ahead_m.size()), static_cast<int>(light.offset_m.size())), bright = dark.clone();
    const std::vector<std::optional<double>> over = residuals(light, min_lx);
    std::ranges::transform(over, dark.begin(), [&](const auto& lg) { return lg && *lg < -limit ? 1 : 0; });
    std::ranges::transform(over, bright.begin(), [&](const auto& lg) { return lg && *lg > limit ? 1 : 0; });
    const double row_m = light.ahead_m[1] - light.ahead_m[0];
    return {connected(dark, row_m), connected(bright, row_m)};
}

namespace {

/// Mean of the lane between two distances, by trapezia cut at the ends: whether a row lies a rounding error within or without makes no
/// difference. Not measured where the grid does not reach.
Value mean_lx(const LaneLight& light, double from_m, double to_m) {
    check(light);
    const std::size_t columns = light.offset_m.size();
    if (light.ahead_m.empty() || columns == 0 || light.ahead_m.back() < to_m || light.ahead_m.front() > from_m)
        return Value::not_measured(fmt::format("the lane is not known from {:g} to {:g} m ahead", from_m, to_m));
    const auto row_mean = [&](std::size_t r) {
        double sum = 0.0;
        for (std::size_t c = 0; c < columns; ++c)
            sum += light.lx[r * columns + c];
        return sum / static_cast<double>(columns);
    };
    double integral = 0.0;
    for (std::size_t r = 1; r < light.ahead_m.size(); ++r) {
        const double a_m = light.ahead_m[r - 1], b_m = light.ahead_m[r];
        const double low_m = std::max(a_m, from_m), high_m = std::min(b_m, to_m);
        if (!(high_m > low_m))
            continue;
        const double a = row_mean(r - 1), slope = (row_mean(r) - a) / (b_m - a_m);
        integral += (a + slope * (0.5 * (low_m + high_m) - a_m)) * (high_m - low_m);
    }
    return integral / (to_m - from_m);
}

/// d mean_lx() / d lx.
std::vector<double> mean_shares(const LaneLight& light, double from_m, double to_m) {
    const std::size_t columns = light.offset_m.size();
    std::vector<double> of_row(light.ahead_m.size());
    for (std::size_t r = 1; r < of_row.size(); ++r) {
        const double a_m = light.ahead_m[r - 1], b_m = light.ahead_m[r];
        const double low_m = std::max(a_m, from_m), high_m = std::min(b_m, to_m);
        if (!(high_m > low_m))
            continue;
        const double way = (0.5 * (low_m + high_m) - a_m) / (b_m - a_m), length = (high_m - low_m) / (to_m - from_m);
        of_row[r - 1] += (1.0 - way) * length;
        of_row[r] += way * length;
    }
    std::vector<double> shares(light.lx.size());
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i] = of_row[i / columns] / static_cast<double>(columns);
    return shares;
}

constexpr double near_from_m = 5.0, near_to_m = 15.0, far_from_m = 40.0, far_to_m = 60.0;

} // namespace

Value foreground_lx(const LaneLight& light) { return mean_lx(light, near_from_m, near_to_m); }

Value foreground_ratio(const LaneLight& light) {
    const Value near_lx = foreground_lx(light), far_lx = mean_lx(light, far_from_m, far_to_m);
    if (!near_lx.measured() || !far_lx.measured())
        return near_lx.measured() ? far_lx : near_lx;
    if (!(*far_lx.number() > 0.0))
        return Value::not_measured("dark from 40 to 60 m ahead");
    return *near_lx.number() / *far_lx.number();
}

std::vector<double> foreground_shares(const LaneLight& light) { return mean_shares(light, near_from_m, near_to_m); }

std::vector<double> foreground_ratio_shares(const LaneLight& light) {
    const double near_lx = *foreground_lx(light).number(), far_lx = *mean_lx(light, far_from_m, far_to_m).number();
    std::vector<double> shares = foreground_shares(light);
    const std::vector<double> far_shares = mean_shares(light, far_from_m, far_to_m);
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i] = shares[i] / far_lx - near_lx / (far_lx * far_lx) * far_shares[i];
    return shares;
}

std::vector<double> uniformity_shares(const std::vector<double>& lx) {
    const double count = static_cast<double>(lx.size()), mean = std::accumulate(lx.begin(), lx.end(), 0.0) / count;
    const auto least = std::ranges::min_element(lx);
    std::vector<double> shares(lx.size(), -*least / (mean * mean * count));
    shares[static_cast<std::size_t>(least - lx.begin())] += 1.0 / mean;
    return shares;
}

Value uniformity(const std::vector<double>& lx) {
    if (lx.empty())
        return Value::not_measured("the lane is not there");
    const double mean = std::accumulate(lx.begin(), lx.end(), 0.0) / static_cast<double>(lx.size());
    return mean > 0.0 ? Value(*std::ranges::min_element(lx) / mean) : Value::not_measured("dark across the lane");
}

} // namespace fernlicht
