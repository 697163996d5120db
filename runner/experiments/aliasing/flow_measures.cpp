#include "runner/experiments/aliasing/flow_measures.h"

#include "metrics/images/image_difference.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

bool too_few(const FlowPaths& followed) {
    return followed.paths.empty() || static_cast<double>(followed.paths.size()) < min_followed * static_cast<double>(followed.started);
}

void add_squares(AliasingPart& sum, const AliasingPart& part) {
    sum.rms += part.rms * part.rms;
    sum.contrast_percent += part.contrast_percent * part.contrast_percent;
    sum.visible += part.visible * part.visible;
}

void root(AliasingPart& sum, double count) {
    for (double* value : {&sum.rms, &sum.contrast_percent, &sum.visible})
        *value = std::sqrt(*value / count);
}

} // namespace

Image<float> floats_of(const Image<double>& picture) {
    Image<float> out(picture.width(), picture.height());
    std::ranges::transform(picture.pixels(), out.pixels().begin(), [](double value) { return static_cast<float>(value); });
    return out;
}

float displayed_cdm2(const Rgb8& pixel) {
    const auto linear = [](std::uint8_t value) { return srgb_decoded(value / 255.0); };
    return static_cast<float>(display_white_cdm2 * (0.2126 * linear(pixel.r) + 0.7152 * linear(pixel.g) + 0.0722 * linear(pixel.b)));
}

Image<float> display_step_cdm2(const Image<float>& displayed) {
    Image<float> steps(displayed.width(), displayed.height());
    std::ranges::transform(displayed.pixels(), steps.pixels().begin(), [](float cdm2) {
        const std::array<float, 256>& decoded = srgb_table();
        const auto above = std::ranges::lower_bound(decoded, cdm2 / static_cast<float>(display_white_cdm2));
        const auto code = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - decoded.begin(), 0, 254));
        return static_cast<float>(display_white_cdm2) * (decoded[code + 1] - decoded[code]);
    });
    return steps;
}

std::string method_name(FlowMethod method) { return method == FlowMethod::dis ? "dense inverse search" : "Farneback"; }

std::optional<TemporalAliasing> aliasing_along(const FlowPaths& followed, const std::vector<Image<double>>& aliasing,
                                               const std::vector<Image<double>>& levels, double rate_hz, double pixels_per_degree) {
    if (too_few(followed))
        return std::nullopt;
    std::vector<PixelTrack> tracks;
    for (const Path& path : followed.paths)
        tracks.push_back(track_of(path, aliasing.front().width(), aliasing.front().height()));
    return measure_temporal_aliasing(aliasing, levels, tracks, rate_hz, pixels_per_degree);
}

std::optional<TemporalAliasing> flicker_along(const FlowPaths& followed, const std::vector<Image<float>>& pictures, double rate_hz,
                                              double pixels_per_degree) {
    if (too_few(followed))
        return std::nullopt;
    return measure_flicker(samples_along(followed.paths, pictures), rate_hz, pixels_per_degree);
}

SpatialAliasing over_moments(std::vector<SpatialAliasing>& found, std::size_t shown) {
    SpatialAliasing all = std::move(found[shown]);
    const auto each = [&](auto use) {
        use([](SpatialAliasing& a) -> AliasingPart& { return a.aliasing; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.folded; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.rest; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.lost; });
        for (std::size_t b = 0; b < all.bands.size(); ++b) {
            use([b](SpatialAliasing& a) -> AliasingPart& { return a.bands[b].aliasing; });
            use([b](SpatialAliasing& a) -> AliasingPart& { return a.bands[b].lost; });
        }
    };
    found[shown].bands = all.bands;
    each([&](auto part) {
        AliasingPart sum;
        for (SpatialAliasing& one : found)
            add_squares(sum, part(one));
        root(sum, static_cast<double>(found.size()));
        part(all) = sum;
    });
    return all;
}

} // namespace fernlicht
