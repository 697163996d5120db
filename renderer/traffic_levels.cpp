#include "renderer/traffic_levels.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr int max_steps = 32, texels_a_row = 4, texels_a_column = 32;
constexpr double slack_rad = 1e-4; // what the GPU's angles may differ, many times over
constexpr double max_apart = 0.2;
constexpr double float_sums = 1.000001; // differences are taken in float

std::size_t index_of(int i) { return static_cast<std::size_t>(i); }

} // namespace

TrafficShare traffic_share(double most, double merging, double least, bool pair, bool interpolated) {
    TrafficShare share;
    double by_fragment = 1.0;
    if (interpolated) {
        const double vertex = std::clamp((4.0 * least - most) / least, 0.0, 1.0),
                     point = std::clamp((2.0 * least - most) / (0.5 * least), 0.0, 1.0);
        by_fragment = 1.0 - vertex;
        share.by_vertex = vertex * (1.0 - point);
        share.point = vertex * point;
    }
    const double each = pair ? std::clamp((merging - 2.0 * least) / (2.0 * least), 0.0, 1.0) : 0.0;
    share.each = by_fragment * each;
    share.merged = by_fragment * (1.0 - each);
    return share;
}

double traffic_error_lx(const TrafficShare& share, double most, double merging, double least) {
    return share.each * std::min(most, least) + share.merged * std::min(most, merging + least) + (share.by_vertex + share.point) * most;
}

TrafficBeam::TrafficBeam(const BeamTexture& beam)
    : h_first_(beam.h_first_rad), v_first_(beam.v_first_rad), h_step_(beam.h_step_rad), v_step_(beam.v_step_rad),
      columns_((beam.width + texels_a_column - 1) / texels_a_column), rows_(index_of((beam.height + texels_a_row - 1) / texels_a_row)),
      max_of_cell_(rows_.size() * index_of(columns_), 0.0F) {
    const int margin = 2 * max_steps + 1;
    const std::size_t stride = index_of(beam.width + 2 * margin);
    std::vector<float> padded(index_of(texels_a_row + 2) * stride, 0.0F), worst(stride);
    for (int r = 0; r < static_cast<int>(rows_.size()); ++r) {
        Row& one = rows_[index_of(r)];
        one.second_cd.assign(index_of(max_steps + 1), 0.0F);
        // What is interpolated between two rows belongs to both.
        const int bottom = std::max(0, texels_a_row * r - 1), top = std::min(beam.height - 1, texels_a_row * (r + 1));
        for (int y = bottom; y <= top; ++y) {
            const auto cd = [&](int x, int v) { return beam.cd[index_of(v) * index_of(beam.width) + index_of(x)]; };
            for (int x = 0; x < beam.width; ++x) {
                padded[index_of(y - bottom) * stride + index_of(x + margin)] = cd(x, y);
                if (y + 1 < beam.height)
                    one.up = std::max(one.up, std::abs(cd(x, y + 1) - cd(x, y)));
                if (x + 1 < beam.width)
                    one.across = std::max(one.across, std::abs(cd(x + 1, y) - cd(x, y)));
                if (x == 0 || y == 0 || x + 1 == beam.width || y + 1 == beam.height)
                    one.edge = std::max(one.edge, cd(x, y));
                for (int column = std::max(0, (x - 1) / texels_a_column); column <= x / texels_a_column; ++column) {
                    float& most = max_of_cell_[index_of(r) * index_of(columns_) + index_of(column)];
                    most = std::max(most, cd(x, y));
                }
            }
        }
        for (std::size_t n = 1; n <= index_of(max_steps); ++n) {
            worst.assign(stride, 0.0F); // by column: no maximum waits for another
            for (int y = bottom; y <= top; ++y) {
                const float* const at = padded.data() + index_of(y - bottom) * stride;
                for (std::size_t x = n; x < stride - n - 1; ++x) {
                    const float whole = std::abs(at[x - n] + at[x + n] - 2.0F * at[x]);
                    const float half = std::abs(at[x - n] + at[x + n + 1] - at[x] - at[x + 1]);
                    const float more = whole > half ? whole : half;
                    worst[x] = worst[x] > more ? worst[x] : more;
                }
            }
            one.second_cd[n] = *std::max_element(worst.begin(), worst.end());
        }
        for (std::size_t n = 1; n < one.second_cd.size(); ++n)
            one.second_cd[n] = std::max(one.second_cd[n], one.second_cd[n - 1]);
    }
    if (!max_of_cell_.empty())
        most_ = static_cast<double>(*std::max_element(max_of_cell_.begin(), max_of_cell_.end()));
}

std::pair<int, int> TrafficBeam::rows_of(double v_from_rad, double v_to_rad) const {
    const double size = texels_a_row * v_step_;
    const auto row = [&](double v_rad) {
        return static_cast<int>(std::clamp(std::floor((v_rad - v_first_) / size), -1.0, static_cast<double>(rows_.size())));
    };
    return {std::max(0, row(v_from_rad)), std::min(static_cast<int>(rows_.size()) - 1, row(v_to_rad))};
}

double TrafficBeam::max_cd(const BeamWindow& w) const {
    const auto [low, high] = rows_of(w.v_from_rad - slack_rad, w.v_to_rad + slack_rad);
    const double size = texels_a_column * h_step_;
    const auto column = [&](double h_rad) {
        return static_cast<int>(std::clamp(std::floor((h_rad - h_first_) / size), -1.0, static_cast<double>(columns_)));
    };
    const int left = std::max(0, column(w.h_from_rad - slack_rad)), right = std::min(columns_ - 1, column(w.h_to_rad + slack_rad));
    float most = 0.0F;
    for (int row = low; row <= high; ++row)
        for (int k = left; k <= right; ++k)
            most = std::max(most, max_of_cell_[index_of(row) * index_of(columns_) + index_of(k)]);
    return static_cast<double>(most);
}

double TrafficBeam::merging_lx(double apart, double apart_up, const BeamWindow& w, double lx_a_cd, double max_lx) const {
    const double v = std::max(std::abs(w.v_from_rad), std::abs(w.v_to_rad)), steps = std::ceil(apart / (std::cos(v) * h_step_));
    if (apart > max_apart || !(std::cos(v) > 0.1) || !(steps <= max_steps))
        return 2.0 * max_lx;
    const double tilt = apart_up + apart * std::sin(v) + apart * apart; // change of V from the middle to a lamp
    const auto [low, high] = rows_of(w.v_from_rad - tilt - slack_rad, w.v_to_rad + tilt + slack_rad);
    double cd = 0.0;
    for (int k = low; k <= high; ++k) {
        const Row& row = rows_[index_of(k)];
        cd = std::max(cd, 0.5 * static_cast<double>(row.second_cd[static_cast<std::size_t>(steps)]) + static_cast<double>(row.edge) +
                              static_cast<double>(row.up) / v_step_ * tilt +
                              3.5 * static_cast<double>(row.across) / h_step_ * apart * apart);
    }
    return std::min(2.0 * max_lx, float_sums * cd * lx_a_cd + 6.0 * apart * apart * max_lx);
}

} // namespace fernlicht
