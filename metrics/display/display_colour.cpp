#include "metrics/display/display_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>
#include <vector>

namespace fernlicht {
namespace {

/// What depends on the profile alone.
struct DisplayMatrices {
    explicit DisplayMatrices(const DisplayProfile& p)
        : white_xyz(p.xyz_from_rgb * glm::dvec3(1.0)), rgb_from_xyz(glm::inverse(p.xyz_from_rgb)),
          black_xyz(white_xyz * (p.black_cdm2 / white_xyz.y)), rgb_from_light(rgb_from_xyz * xyz_from_light()) {}
    glm::dvec3 white_xyz;
    glm::dmat3 rgb_from_xyz;
    glm::dvec3 black_xyz;
    glm::dmat3 rgb_from_light;
};

/// The share `grey` of white has the colour's luminance. The colour moves towards it as far as it must.
glm::dvec3 into_gamut(GamutRule rule, const glm::dvec3& rgb, double grey) {
    if (rule == GamutRule::clip)
        return glm::clamp(rgb, 0.0, 1.0);
    double keep = 1.0;
    for (int i = 0; i < 3; ++i) {
        if (rgb[i] > 1.0)
            keep = std::min(keep, (1.0 - grey) / (rgb[i] - grey));
        if (rgb[i] < 0.0)
            keep = std::min(keep, grey / (grey - rgb[i]));
    }
    return glm::clamp(glm::dvec3(grey) + keep * (rgb - grey), 0.0, 1.0);
}

double luminance_of(const glm::dvec3& light) {
    static const glm::dmat3 light_xyz = xyz_from_light();
    return light_xyz[0].y * light.x + light_xyz[1].y * light.y + light_xyz[2].y * light.z;
}

glm::dvec3 shares_of_light(const DisplayProfile& profile, const DisplayMatrices& m, const ToneMapper& mapper, const glm::dvec3& light) {
    const double luminance = luminance_of(light);
    const double share = toned(mapper, luminance);
    if (share == 0.0)
        return glm::dvec3(0.0);
    return into_gamut(profile.gamut, m.rgb_from_light * (light * (share * m.white_xyz.y / luminance)), share);
}

} // namespace

glm::dvec3 shares_for(const DisplayProfile& profile, const glm::dvec3& xyz) {
    const DisplayMatrices m(profile);
    const glm::dvec3 light = xyz - m.black_xyz;
    if (!(light.y > 0.0))
        return glm::dvec3(0.0);
    const double grey = std::min(light.y / m.white_xyz.y, 1.0);
    return into_gamut(profile.gamut, m.rgb_from_xyz * (light * (grey * m.white_xyz.y / light.y)), grey);
}

glm::dvec3 shown_xyz(const DisplayProfile& profile, const glm::dvec3& code) {
    const DisplayMatrices m(profile);
    glm::dvec3 shares;
    for (int i = 0; i < 3; ++i)
        shares[i] = std::min(decoded(profile, std::clamp(code[i], 0.0, 1.0)), 1.0);
    return m.black_xyz + profile.xyz_from_rgb * shares;
}

glm::dvec3 display_code(const DisplayProfile& profile, const ToneMapper& mapper, const glm::dvec3& light) {
    const glm::dvec3 shares = shares_of_light(profile, DisplayMatrices(profile), mapper, light);
    return {encoded(profile, shares.x), encoded(profile, shares.y), encoded(profile, shares.z)};
}

Image<glm::u16vec3> display_picture(const DisplayProfile& profile, const ToneMapper& mapper, const Image<glm::vec3>& light,
                                    const std::optional<glm::dmat3>& white) {
    const DisplayMatrices m(profile);
    const double most = profile.bits == 16 ? 65535.0 : 255.0;
    Image<glm::u16vec3> codes(light.width(), light.height());
    tbb::parallel_for(0, light.height(), [&](int y) {
        for (int x = 0; x < light.width(); ++x) {
            glm::dvec3 seen(light.at(x, y));
            if (const double luminance = luminance_of(seen); white && luminance > 0.0) {
                seen = *white * seen;
                seen *= luminance / luminance_of(seen);
            }
            const glm::dvec3 shares = shares_of_light(profile, m, mapper, seen);
            for (int i = 0; i < 3; ++i)
                codes.at(x, y)[i] = static_cast<std::uint16_t>(std::lround(most * encoded(profile, shares[i])));
        }
    });
    return codes;
}

double mean_shown_cdm2(const DisplayProfile& profile, const Image<glm::u16vec3>& codes) {
    const std::size_t most = profile.bits == 16 ? 65535 : 255;
    std::vector<double> shares(most + 1);
    for (std::size_t code = 0; code <= most; ++code)
        shares[code] = std::min(decoded(profile, static_cast<double>(code) / static_cast<double>(most)), 1.0);
    glm::dvec3 sum(0.0);
    for (const glm::u16vec3& code : codes.pixels())
        sum += glm::dvec3(shares[code.r], shares[code.g], shares[code.b]);
    return profile.black_cdm2 + (profile.xyz_from_rgb * sum).y / static_cast<double>(codes.size());
}

namespace {

constexpr double ln_10 = 2.302585092994045684;
constexpr double darkest_share = 0.005; // of the pixels may lie below the darkest luminance worth showing
constexpr std::size_t histogram_bins =
    static_cast<std::size_t>(LuminanceHistogram::last_decade - LuminanceHistogram::first_decade) * LuminanceHistogram::bins_a_decade;
constexpr double bin_ln = ln_10 / LuminanceHistogram::bins_a_decade;

/// Sum of the slopes, each cut to its bounds, as it rises with their common factor.
double summed(const std::vector<double>& shares, double factor, double least, double most) {
    double sum = 0.0;
    for (const double share : shares)
        sum += std::clamp(factor * share, least, most);
    return sum;
}

} // namespace

LuminanceHistogram::LuminanceHistogram() : counts_(histogram_bins, 0) {}

double LuminanceHistogram::bin_cdm2(std::size_t bin) { return std::exp(ln_10 * first_decade + bin_ln * static_cast<double>(bin)); }

void LuminanceHistogram::add(double luminance_cdm2) {
    ++pixels_;
    if (!std::isfinite(luminance_cdm2))
        return;
    most_ = std::max(most_, luminance_cdm2);
    if (luminance_cdm2 < bin_cdm2(0))
        return;
    const double at = (std::log(luminance_cdm2) - ln_10 * first_decade) / bin_ln;
    ++counts_[std::min(static_cast<std::size_t>(at), histogram_bins - 1)];
    ++counted_;
    ln_sum_ += std::log(luminance_cdm2);
}

void LuminanceHistogram::add(const Image<float>& luminance_cdm2) {
    for (const float value : luminance_cdm2.pixels())
        add(static_cast<double>(value));
}

double LuminanceHistogram::log_mean_cdm2() const { return counted_ == 0 ? 0.0 : std::exp(ln_sum_ / static_cast<double>(counted_)); }

double fitted_s(double luminance_cdm2, double l_max_cdm2, double share) {
    if (!(luminance_cdm2 > 0.0 && luminance_cdm2 < l_max_cdm2))
        return 1.0;
    return std::max(1.0, share * (l_max_cdm2 - luminance_cdm2) / (luminance_cdm2 * (1.0 - share)));
}

ToneMapper histogram_mapper(const LuminanceHistogram& histogram, double l_max_cdm2, double range, double min_slope) {
    ToneMapper mapper{ToneMapperKind::linear, 1.0, l_max_cdm2, {}};
    const std::vector<std::uint64_t>& counts = histogram.counts();
    std::uint64_t counted = 0, below = 0;
    for (const std::uint64_t count : counts)
        counted += count;
    std::size_t first = 0;
    while (first < counts.size() && static_cast<double>(below + counts[first]) <= darkest_share * static_cast<double>(counted))
        below += counts[first++];
    if (first == counts.size() || !(LuminanceHistogram::bin_cdm2(first + 1) < l_max_cdm2))
        return mapper;
    const auto end =
        static_cast<std::size_t>(std::ceil((std::log(l_max_cdm2) - std::log(LuminanceHistogram::bin_cdm2(first))) / bin_ln - 1.0e-9)) +
        first;
    const double display_ln = -std::log(range), ln_first = std::log(LuminanceHistogram::bin_cdm2(first)), ln_last = std::log(l_max_cdm2);
    if (ln_last - ln_first <= display_ln)
        return mapper;
    const std::size_t bins = end - first;
    const double step_ln = (ln_last - ln_first) / static_cast<double>(bins), mean_slope = display_ln / (ln_last - ln_first);
    std::vector<double> shares(bins, 0.0);
    for (std::size_t i = 0; i < bins; ++i)
        shares[i] = first + i < counts.size() ? static_cast<double>(counts[first + i]) / static_cast<double>(counted) : 0.0;
    const double least = min_slope * mean_slope, wanted = display_ln / step_ln;
    // All slopes at 1 give more than is wanted, all at the least less; bins without pixels stay at the least, so that the most of the rest
    // may not suffice: then the empty ones take what is left, evenly.
    double low = 0.0, high = 1.0;
    while (summed(shares, high, least, 1.0) < wanted && high < 1.0e12)
        high *= 2.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (summed(shares, middle, least, 1.0) < wanted ? low : high) = middle;
    }
    std::vector<double> slopes(bins);
    for (std::size_t i = 0; i < bins; ++i)
        slopes[i] = std::clamp(high * shares[i], least, 1.0);
    const double missing = wanted - summed(shares, high, least, 1.0);
    const auto empty = static_cast<double>(std::ranges::count(shares, 0.0));
    if (missing > 0.0 && empty > 0.0)
        for (std::size_t i = 0; i < bins; ++i)
            slopes[i] += shares[i] == 0.0 ? missing / empty : 0.0;
    mapper.kind = ToneMapperKind::histogram;
    double ln_share = -display_ln, sum = 0.0;
    for (const double slope : slopes)
        sum += slope * step_ln;
    for (std::size_t i = 0; i <= bins; ++i) {
        mapper.curve.push_back({ln_first + step_ln * static_cast<double>(i), i == bins ? 0.0 : ln_share});
        if (i < bins)
            ln_share += slopes[i] * step_ln * (display_ln / sum);
    }
    mapper.curve.back().ln_luminance = ln_last;
    return mapper;
}

void AdaptedLuminance::see(double log_mean_cdm2, double step_s) {
    if (!(log_mean_cdm2 > 0.0) || !std::isfinite(log_mean_cdm2))
        return;
    if (adapted_cdm2_ == 0.0) {
        adapted_cdm2_ = log_mean_cdm2;
        return;
    }
    const double tau_s = log_mean_cdm2 > adapted_cdm2_ ? brighter_s_ : darker_s_, apart = std::log(log_mean_cdm2 / adapted_cdm2_);
    adapted_cdm2_ *= std::exp(-apart * std::expm1(-step_s / tau_s));
}

} // namespace fernlicht
