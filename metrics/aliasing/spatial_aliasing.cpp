#include "metrics/aliasing/spatial_aliasing.h"

#include "metrics/aliasing/block_fit.h"
#include "metrics/aliasing/contrast_sensitivity.h"
#include "metrics/aliasing/fourier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr std::size_t side = static_cast<std::size_t>(block_side_px), band_count = 4, part_count = 4;
constexpr int hop_px = block_side_px / 2, blur_reach_px = 3, fold_reach_px = 1;
constexpr std::array<double, band_count + 1> band_edges{1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 0.75};
/// What a coefficient of 1 costs, as a share of the energy that is to be explained: a blur (coefficients of about 1 beside "sharp") keeps
/// 0.3 % of its energy unexplained at most, and content of a twentieth of the amplitude cannot be blown up to explain the rest.
constexpr double blur_ridge = 3e-3;
constexpr double fold_ridge = 1e-3;

/// Mean squares: plain, of contrast, of multiples of the threshold.
struct Squares {
    double plain = 0.0, contrast = 0.0, visible = 0.0;

    void add(const Squares& other, double weight = 1.0) {
        plain += weight * other.plain;
        contrast += weight * other.contrast;
        visible += weight * other.visible;
    }
};

enum Part { aliasing, folded, rest, lost };

struct BlockResult {
    std::array<std::array<Squares, band_count>, part_count> bands{};
    Block aliasing, folded;
    double luminance_cdm2 = least_seen_cdm2;
};

std::size_t band_of(std::size_t bin) {
    const double f = std::hypot(bin_frequency(bin % side, side), bin_frequency(bin / side, side));
    const auto above = std::upper_bound(band_edges.begin(), band_edges.end(), f);
    return static_cast<std::size_t>(above - band_edges.begin()) - 1; // below the first edge: the largest number there is
}

std::array<Squares, band_count> squares_of(const Block& block, double luminance_cdm2, double pixels_per_degree) {
    static const double energy = [] {
        double sum = 0.0;
        for (const double w : block_window())
            sum += w * w;
        return sum * static_cast<double>(side * side);
    }();
    std::vector<std::complex<double>> values(block.size());
    for (std::size_t i = 0; i < block.size(); ++i)
        values[i] = block_window()[i] * block[i];
    fourier_transform(values, side);
    std::array<Squares, band_count> bands{};
    for (std::size_t bin = 0; bin < values.size(); ++bin) {
        const std::size_t band = band_of(bin);
        if (band >= band_count)
            continue;
        const double f = std::hypot(bin_frequency(bin % side, side), bin_frequency(bin / side, side));
        const double square = std::norm(values[bin]) / energy, contrast = square / (luminance_cdm2 * luminance_cdm2);
        const double sensitivity = still_contrast_sensitivity(f * pixels_per_degree, luminance_cdm2);
        bands[band].add({square, contrast, 2.0 * contrast * sensitivity * sensitivity}); // a sine's modulation^2 is twice its mean square
    }
    return bands;
}

double rms_of(const Block& block) {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double w = block_window()[i] * block_window()[i];
        sum += w * block[i] * block[i];
        weight += w;
    }
    return std::sqrt(sum / weight);
}

double mean_of(const Block& block) {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        sum += block_window()[i] * block[i];
        weight += block_window()[i];
    }
    return sum / weight;
}

Block difference(const Block& a, const Block& b, double b_factor = 1.0) {
    Block out = a;
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] -= b_factor * b[i];
    return out;
}

BlockResult measure_block(const Image<double>& tested, const BandSplit& split, int left, int top, double pixels_per_degree) {
    Block target = block_at(tested, left, top), ideal = block_at(split.ideal, left, top);
    const double tested_mean = mean_of(target), ideal_mean = mean_of(ideal);
    BlockResult result;
    const double luminance = result.luminance_cdm2 = std::max({rms_of(target), rms_of(ideal), least_seen_cdm2});
    const double gain = tested_mean > 0.0 && ideal_mean > 0.0 ? tested_mean / ideal_mean : 1.0;
    remove_slope(target);
    remove_slope(ideal);
    const auto shifts = [&](const Image<double>& picture, int reach) {
        std::vector<Block> parts = symmetric_shifts(picture, left, top, reach);
        for (Block& part : parts)
            remove_slope(part);
        return parts;
    };
    // Sharp costs nothing: what is looked for is how the filter differs from none.
    const Block away = difference(target, ideal, gain);
    const double unit = 1.0 / (gain * gain); // a coefficient is one of the reference, as bright as it is
    const Block filtered = nearest_combination(away, shifts(split.ideal, blur_reach_px), blur_ridge * unit * energy_of(target));
    result.aliasing = difference(away, filtered);
    result.folded =
        nearest_combination(result.aliasing, shifts(split.folded, fold_reach_px), fold_ridge * unit * energy_of(result.aliasing));
    result.bands[aliasing] = squares_of(result.aliasing, luminance, pixels_per_degree);
    result.bands[folded] = squares_of(result.folded, luminance, pixels_per_degree);
    result.bands[rest] = squares_of(difference(result.aliasing, result.folded), luminance, pixels_per_degree);
    result.bands[lost] = squares_of(filtered, luminance, pixels_per_degree);
    return result;
}

AliasingPart part_of(const Squares& sum, double weight) {
    return {std::sqrt(sum.plain / weight), 100.0 * std::sqrt(sum.contrast / weight), std::sqrt(sum.visible / weight)};
}

/// The part of the squared window that lies on the picture: what is mirrored beyond an edge counts once.
double share_inside(int left, int top, const Image<double>& picture) {
    double inside = 0.0, all = 0.0;
    for (int y = 0; y < block_side_px; ++y)
        for (int x = 0; x < block_side_px; ++x) {
            const double w = block_window()[static_cast<std::size_t>(y * block_side_px + x)];
            all += w * w;
            if (left + x >= 0 && top + y >= 0 && left + x < picture.width() && top + y < picture.height())
                inside += w * w;
        }
    return inside / all;
}

Image<double> checked_doubles(const Image<float>& tested, const BandSplit& split, double pixels_per_degree) {
    if (tested.width() != split.ideal.width() || tested.height() != split.ideal.height() ||
        std::min(tested.width(), tested.height()) < block_side_px || !(pixels_per_degree > 0.0) || !std::isfinite(pixels_per_degree))
        throw std::invalid_argument(
            fmt::format("the aliasing of {}x{} pixels cannot be measured against a reference for {}x{} at {} pixels "
                        "per degree",
                        tested.width(), tested.height(), split.ideal.width(), split.ideal.height(), pixels_per_degree));
    Image<double> values(tested.width(), tested.height());
    for (std::size_t i = 0; i < values.size(); ++i) {
        values.pixels()[i] = static_cast<double>(tested.pixels()[i]);
        if (!std::isfinite(values.pixels()[i]))
            throw std::invalid_argument(fmt::format("the tested picture's value {} is {}", i, values.pixels()[i]));
    }
    return values;
}

void blend(Image<double>& picture, const Block& block, int left, int top) {
    for (int y = 0; y < block_side_px; ++y)
        for (int x = 0; x < block_side_px; ++x)
            if (left + x >= 0 && top + y >= 0 && left + x < picture.width() && top + y < picture.height()) {
                const auto i = static_cast<std::size_t>(y * block_side_px + x);
                picture.at(left + x, top + y) += block_window()[i] * block_window()[i] * block[i];
            }
}

} // namespace

SpatialAliasing measure_spatial_aliasing(const Image<float>& tested, const BandSplit& split, double pixels_per_degree) {
    const Image<double> picture = checked_doubles(tested, split, pixels_per_degree);
    const int columns = (picture.width() - 1) / hop_px + 2, rows = (picture.height() - 1) / hop_px + 2;
    std::vector<BlockResult> blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const auto left_of = [&](std::size_t i) { return (static_cast<int>(i) % columns - 1) * hop_px; };
    const auto top_of = [&](std::size_t i) { return (static_cast<int>(i) / columns - 1) * hop_px; };
    oneapi::tbb::parallel_for(std::size_t{0}, blocks.size(),
                              [&](std::size_t i) { blocks[i] = measure_block(picture, split, left_of(i), top_of(i), pixels_per_degree); });
    SpatialAliasing result;
    result.aliasing_picture = result.folded_picture = result.level_picture = Image<double>(picture.width(), picture.height());
    std::array<std::array<Squares, band_count>, part_count> bands{};
    double worst = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        double visible = 0.0;
        const double share = share_inside(left_of(i), top_of(i), picture);
        weight += share;
        for (std::size_t b = 0; b < band_count; ++b) {
            for (std::size_t part = 0; part < part_count; ++part)
                bands[part][b].add(blocks[i].bands[part][b], share);
            visible += blocks[i].bands[aliasing][b].visible;
        }
        if (visible > worst) {
            worst = visible;
            result.worst_x = std::clamp(left_of(i) + hop_px, 0, picture.width() - 1);
            result.worst_y = std::clamp(top_of(i) + hop_px, 0, picture.height() - 1);
        }
        blend(result.aliasing_picture, blocks[i].aliasing, left_of(i), top_of(i));
        blend(result.folded_picture, blocks[i].folded, left_of(i), top_of(i));
        blend(result.level_picture, Block(side * side, blocks[i].luminance_cdm2), left_of(i), top_of(i));
    }
    result.worst_visible = std::sqrt(worst);
    std::array<Squares, part_count> sums{};
    for (std::size_t b = 0; b < band_count; ++b) {
        for (std::size_t part = 0; part < part_count; ++part)
            sums[part].add(bands[part][b]);
        result.bands.push_back({band_edges[b], band_edges[b + 1], part_of(bands[aliasing][b], weight), part_of(bands[lost][b], weight)});
    }
    result.aliasing = part_of(sums[aliasing], weight);
    result.folded = part_of(sums[folded], weight);
    result.rest = part_of(sums[rest], weight);
    result.lost = part_of(sums[lost], weight);
    return result;
}

} // namespace fernlicht
