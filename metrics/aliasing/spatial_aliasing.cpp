#include "metrics/aliasing/spatial_aliasing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr int block_side_px = 32; // power of 2; neighbours overlap by half
constexpr std::size_t side = static_cast<std::size_t>(block_side_px), band_count = 4, part_count = 4;
constexpr int hop_px = block_side_px / 2, blur_reach_px = 3, fold_reach_px = 1;
constexpr std::array<double, band_count + 1> band_edges{1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 0.75};
/// What a coefficient of 1 costs, as a share of the energy that is to be explained: a blur (coefficients of about 1 beside "sharp") keeps
/// 0.3 % of its energy unexplained at most, and content of a twentieth of the amplitude cannot be blown up to explain the rest.
constexpr double blur_ridge = 3e-3;
constexpr double fold_ridge = 1e-3;

/// Values of a block, row after row.
using Block = std::vector<double>;

/// The block whose top left pixel is (left, top); beyond its edges the picture is mirrored. The picture is not empty.
Block block_at(const Image<double>& picture, int left, int top) {
    Block block;
    block.reserve(side * side);
    for (int y = 0; y < block_side_px; ++y)
        for (int x = 0; x < block_side_px; ++x)
            block.push_back(picture.at(mirrored(left + x, picture.width()), mirrored(top + y, picture.height())));
    return block;
}

/// sin(pi (x + 1/2) / side) along x times the same along y; the squares of those of half-overlapping blocks add to 1.
const Block& block_window() {
    static const Block window = [] {
        Block w;
        const auto along = [](int i) { return std::sin(std::numbers::pi * (i + 0.5) / block_side_px); };
        for (int y = 0; y < block_side_px; ++y)
            for (int x = 0; x < block_side_px; ++x)
                w.push_back(along(x) * along(y));
        return w;
    }();
    return window;
}

const Block& weights() {
    static const Block squares = [] {
        Block w = block_window();
        for (double& value : w)
            value *= value;
        return w;
    }();
    return squares;
}

double whole_weight() {
    static const double sum = std::accumulate(weights().begin(), weights().end(), 0.0);
    return sum;
}

double product(const Block& a, const Block& b) {
    const Block& w = weights();
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += w[i] * a[i] * b[i];
    return sum;
}

/// Sum of squares, weighted by the squared window.
double energy_of(const Block& block) { return product(block, block); }

/// Solves m c = b for a symmetric positive definite m, row after row, by Cholesky's decomposition; `m` and `b` are used up.
std::vector<double> solved(std::vector<double>& m, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = j; i < n; ++i) {
            double sum = m[i * n + j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= m[i * n + k] * m[j * n + k];
            m[i * n + j] = i == j ? std::sqrt(sum) : sum / m[j * n + j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            b[i] -= m[i * n + k] * b[k];
        b[i] /= m[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k)
            b[i] -= m[k * n + i] * b[k];
        b[i] /= m[i * n + i];
    }
    return std::move(b);
}

/// One value for each pair of points (dx, dy) and (-dx, -dy) with |dx|, |dy| <= reach: the mean of the picture at both. A filter made of
/// them is symmetric, so its transfer function is real: it blurs or sharpens and moves nothing.
std::vector<Block> symmetric_shifts(const Image<double>& picture, int left, int top, int reach) {
    std::vector<Block> shifts;
    for (int dy = 0; dy <= reach; ++dy)
        for (int dx = dy == 0 ? 0 : -reach; dx <= reach; ++dx) {
            Block both = block_at(picture, left + dx, top + dy);
            const Block other = block_at(picture, left - dx, top - dy);
            for (std::size_t i = 0; i < both.size(); ++i)
                both[i] = 0.5 * (both[i] + other[i]);
            shifts.push_back(std::move(both));
        }
    return shifts;
}

/// `block` less its level and slope, weighted by the squared window.
void remove_slope(Block& block) {
    // The weights are symmetric about the block's middle: level, slope along x and slope along y are orthogonal.
    const Block& w = weights();
    const auto from_middle = [](std::size_t place) { return static_cast<double>(place) - 0.5 * (block_side_px - 1); };
    double weight = 0.0, square = 0.0, level = 0.0, along_x = 0.0, along_y = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double x = from_middle(i % side), y = from_middle(i / side);
        weight += w[i];
        square += w[i] * x * x;
        level += w[i] * block[i];
        along_x += w[i] * x * block[i];
        along_y += w[i] * y * block[i];
    }
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double x = from_middle(i % side), y = from_middle(i / side);
        block[i] -= level / weight + (along_x * x + along_y * y) / square;
    }
}

/// The combination of `parts` nearest to `target`, both without slope, in squares weighted by the squared window. A coefficient of 1 costs
/// `price` (ridge regression, Hoerl and Kennard 1970), so that next to nothing is not blown up to explain something; 0 gives zeros.
Block nearest_combination(const Block& target, const std::vector<Block>& parts, double price) {
    Block nearest(target.size(), 0.0);
    if (energy_of(target) == 0.0 || price == 0.0)
        return nearest;
    const std::size_t n = parts.size();
    std::vector<double> m(n * n), b(n);
    // Parts may all but coincide, and their rounding errors (1e-16 of the largest) must not make the matrix indefinite.
    for (const Block& part : parts)
        price = std::max(price, 1e-12 * energy_of(part));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            m[i * n + j] = product(parts[i], parts[j]);
        m[i * n + i] += price;
        b[i] = product(target, parts[i]);
    }
    const std::vector<double> coefficients = solved(m, b);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < nearest.size(); ++i)
            nearest[i] += coefficients[j] * parts[j][i];
    return nearest;
}

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
    double luminance_cdm2 = min_seen_cdm2;
};

std::size_t band_of(std::size_t bin) {
    const double f = std::hypot(bin_frequency(bin % side, side), bin_frequency(bin / side, side));
    const auto above = std::upper_bound(band_edges.begin(), band_edges.end(), f);
    return static_cast<std::size_t>(above - band_edges.begin()) - 1; // below the first edge: the largest number there is
}

std::array<Squares, band_count> squares_of(const Block& block, double luminance_cdm2, double pixels_per_degree) {
    const double energy = whole_weight() * static_cast<double>(side * side);
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

double rms_of(const Block& block) { return std::sqrt(energy_of(block) / whole_weight()); }

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
    const double luminance = result.luminance_cdm2 = std::max({rms_of(target), rms_of(ideal), min_seen_cdm2});
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

/// Calls `visit(x, y, i)` for what of a block, its i-th value, lies on the picture.
template <class Visit> void for_inside(const Image<double>& picture, int left, int top, Visit visit) {
    for (int y = std::max(0, top); y < std::min(top + block_side_px, picture.height()); ++y)
        for (int x = std::max(0, left); x < std::min(left + block_side_px, picture.width()); ++x)
            visit(x, y, static_cast<std::size_t>((y - top) * block_side_px + x - left));
}

/// The part of the squared window that lies on the picture: what is mirrored beyond an edge counts once.
double share_inside(int left, int top, const Image<double>& picture) {
    double inside = 0.0;
    for_inside(picture, left, top, [&](int, int, std::size_t i) { inside += weights()[i]; });
    return inside / whole_weight();
}

void blend(Image<double>& picture, const Block& block, int left, int top) {
    for_inside(picture, left, top, [&](int x, int y, std::size_t i) { picture.at(x, y) += weights()[i] * block[i]; });
}

} // namespace

double still_contrast_sensitivity(double cycles_per_degree, double luminance_cdm2) {
    const double u2 = cycles_per_degree * cycles_per_degree;
    if (!(cycles_per_degree >= 0.0 && luminance_cdm2 > 0.0 && std::isfinite(u2) && std::isfinite(luminance_cdm2)))
        throw std::invalid_argument("a contrast sensitivity takes a frequency from 0 up and a luminance above 0");
    if (u2 == 0.0)
        return 0.0;
    const double optics = std::exp(-0.0016 * u2 * std::pow(1.0 + 100.0 / luminance_cdm2, 0.08));
    const double extent = 1.0 + 1.44 + 0.64 * u2;
    const double noise = 63.0 / std::pow(luminance_cdm2, 0.83) - 1.0 / std::expm1(-0.02 * u2);
    return 5200.0 * optics / std::sqrt(extent * noise);
}

SpatialAliasing measure_spatial_aliasing(const Image<float>& tested, const BandSplit& split, double pixels_per_degree) {
    if (tested.width() != split.ideal.width() || tested.height() != split.ideal.height() ||
        std::min(tested.width(), tested.height()) < block_side_px || !(pixels_per_degree > 0.0) || !std::isfinite(pixels_per_degree))
        throw std::invalid_argument(
            fmt::format("the aliasing of {}x{} pixels cannot be measured against a reference for {}x{} at {} pixels "
                        "per degree",
                        tested.width(), tested.height(), split.ideal.width(), split.ideal.height(), pixels_per_degree));
    const Image<double> picture = finite_doubles(tested, "the tested picture");
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
