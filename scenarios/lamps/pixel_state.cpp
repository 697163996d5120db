#include "scenarios/lamps/pixel_state.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double same_edge_deg = 1e-6;

/// H between all edges of the boxes.
std::vector<std::pair<double, double>> cut_at_edges(const std::vector<PixelSegment>& segments) {
    std::vector<double> edges;
    for (const PixelSegment& segment : segments)
        edges.insert(edges.end(), {segment.lights.left_deg, segment.lights.right_deg});
    std::ranges::sort(edges);
    std::vector<std::pair<double, double>> parts;
    for (const double edge : edges)
        if (parts.empty() || edge > parts.back().first + same_edge_deg) {
            if (!parts.empty())
                parts.back().second = edge;
            parts.emplace_back(edge, edge);
        }
    if (parts.size() > 1)
        parts.pop_back(); // nothing follows the last edge
    return parts;
}

double solid_angle(const AngleBox& box) {
    return radians(box.right_deg - box.left_deg) * (std::sin(radians(box.top_deg)) - std::sin(radians(box.bottom_deg)));
}

} // namespace

PixelStates::PixelStates(std::shared_ptr<const PixelLamp> lamp) : lamp_(std::move(lamp)), dead_(lamp_->count(), false) {
    const PixelParts& parts = lamp_->parts();
    for (const std::size_t pixel : parts.dead)
        dead_[pixel] = true;
    if (parts.raster.empty()) {
        columns_deg_ = cut_at_edges(parts.segments);
        for (const PixelSegment& segment : parts.segments)
            flux_lm_.push_back(flux_lm(segment.table));
    } else {
        const PixelRaster& raster = parts.raster.front();
        const auto columns = static_cast<std::size_t>(raster.columns);
        merged_ = (columns + most_columns - 1) / most_columns;
        for (std::size_t i = 0; i < columns; i += merged_)
            columns_deg_.emplace_back(lamp_->lights(i).left_deg, lamp_->lights(std::min(i + merged_, columns) - 1).right_deg);
        for (std::size_t i = 0; i < lamp_->count(); ++i)
            flux_lm_.push_back(raster.cd[i] * solid_angle(lamp_->lights(i)));
    }
    for (const CandelaTable& base : parts.base)
        base_lm_ += flux_lm(base);
    full_lm_ = base_lm_;
    for (std::size_t i = 0; i < flux_lm_.size(); ++i)
        full_lm_ += flux_lm_[i] = dead_[i] ? 0.0 : flux_lm_[i];
}

PixelState PixelStates::of(std::span<const float> levels) const {
    PixelState state;
    const double exponent = lamp_->answer().exponent;
    double lm = base_lm_;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const auto level = static_cast<double>(levels[i]);
        state.lit += level > 0.0 && !dead_[i] ? 1U : 0U;
        lm += level == 1.0 ? flux_lm_[i] : level > 0.0 ? flux_lm_[i] * std::pow(level, exponent) : 0.0;
    }
    state.flux = full_lm_ > 0.0 ? lm / full_lm_ : 0.0;
    state.columns = column_means(levels);
    add_dark_boxes(levels, state);
    return state;
}

std::vector<float> PixelStates::column_means(std::span<const float> levels) const {
    std::vector<double> sum(columns_deg_.size()), count(columns_deg_.size());
    if (lamp_->parts().raster.empty()) {
        for (std::size_t column = 0; column < columns_deg_.size(); ++column)
            for (std::size_t i = 0; i < levels.size(); ++i) {
                const double middle = 0.5 * (columns_deg_[column].first + columns_deg_[column].second);
                const AngleBox& box = lamp_->parts().segments[i].lights;
                if (middle >= box.left_deg && middle <= box.right_deg) {
                    sum[column] += static_cast<double>(levels[i]);
                    count[column] += 1.0;
                }
            }
    } else {
        const auto width = static_cast<std::size_t>(lamp_->parts().raster.front().columns);
        for (std::size_t i = 0; i < levels.size(); ++i) {
            sum[i % width / merged_] += static_cast<double>(levels[i]);
            count[i % width / merged_] += 1.0;
        }
    }
    std::vector<float> means;
    for (std::size_t column = 0; column < sum.size(); ++column)
        means.push_back(static_cast<float>(sum[column] / count[column])); // 0 / 0: none
    return means;
}

void PixelStates::add_dark_boxes(std::span<const float> levels, PixelState& state) const {
    const auto add = [&](const AngleBox& box) {
        if (state.dark.size() < most_dark_boxes)
            state.dark.push_back(box);
        else
            ++state.more_dark;
    };
    if (lamp_->parts().raster.empty()) {
        for (std::size_t i = 0; i < levels.size(); ++i)
            if (levels[i] == 0.0F)
                add(lamp_->lights(i));
        return;
    }
    const auto width = static_cast<std::size_t>(lamp_->parts().raster.front().columns), rows = levels.size() / width;
    std::vector<bool> left(levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
        left[i] = levels[i] == 0.0F;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < width; ++column) {
            if (!left[row * width + column])
                continue;
            std::size_t end = column;
            while (end < width && left[row * width + end])
                ++end;
            const auto all_left = [&](std::size_t below) {
                for (std::size_t i = column; i < end; ++i)
                    if (!left[below * width + i])
                        return false;
                return true;
            };
            std::size_t bottom = row;
            for (; bottom < rows && all_left(bottom); ++bottom)
                for (std::size_t i = column; i < end; ++i)
                    left[bottom * width + i] = false;
            const AngleBox first = lamp_->lights(row * width + column), last = lamp_->lights((bottom - 1) * width + end - 1);
            add({first.left_deg, last.right_deg, last.bottom_deg, first.top_deg});
        }
}

} // namespace fernlicht
