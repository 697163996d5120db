#include "runner/experiments/compare/picture_comparison.h"

#include "metrics/images/flip.h"
#include "metrics/images/image_difference.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

using Values = std::vector<ComparedValue>;

void add(Values& values, std::string name, std::string unit, double value, std::optional<int> x = {}, std::optional<int> y = {}) {
    values.push_back({std::move(name), std::move(unit), value, {}, x, y});
}

void add_not_measured(Values& values, std::string name, std::string unit, std::string why) {
    values.push_back({std::move(name), std::move(unit), std::nullopt, std::move(why)});
}

void add_psnr(Values& values, double psnr_db, double peak, const std::string& unit) {
    if (std::isfinite(psnr_db))
        add(values, "psnr_db", "dB", psnr_db);
    else
        add_not_measured(values, "psnr_db", "dB", peak > 0.0 ? "the pictures do not differ" : "the reference has no light, so no peak");
    add(values, "psnr_peak", unit, peak);
}

void add_structure(Values& values, const Image<float>& tested, const Image<float>& reference, double range) {
    const SsimScales found = ssim_scales(tested, reference, range);
    add(values, "ssim", "", found.finest.mean);
    add(values, "ssim_least", "", found.finest.minimum, found.finest.minimum_x, found.finest.minimum_y);
    if (found.all)
        add(values, "ms_ssim", "", *found.all);
    else
        add_not_measured(values, "ms_ssim", "",
                         fmt::format("five scales need {0} x {0} pixels at least, found {1} x {2}", smallest_for_ms_ssim_px, tested.width(),
                                     tested.height()));
}

void add_colours(Values& values, const Image<float>& map) {
    const ColourDifference found = summary_of_colours(map);
    add(values, "ciede2000_mean", "", found.mean);
    add(values, "ciede2000_median", "", found.median);
    add(values, "ciede2000_p95", "", found.p95);
    add(values, "ciede2000_max", "", found.maximum, found.maximum_x, found.maximum_y);
}

void add_flip(Values& values, const Image<float>& map) {
    const FlipSummary s = summary_of_flip(map);
    add(values, "flip_mean", "", s.mean);
    add(values, "flip_weighted_first_quartile", "", s.weighted_first_quartile);
    add(values, "flip_weighted_median", "", s.weighted_median);
    add(values, "flip_weighted_third_quartile", "", s.weighted_third_quartile);
    add(values, "flip_first_quartile", "", s.first_quartile);
    add(values, "flip_median", "", s.median);
    add(values, "flip_third_quartile", "", s.third_quartile);
    add(values, "flip_min", "", s.minimum);
    const auto largest = static_cast<int>(std::ranges::max_element(map.pixels()) - map.pixels().begin());
    add(values, "flip_max", "", s.maximum, largest % map.width(), largest / map.width());
}

Image<float> subtracted(const Image<float>& tested, const Image<float>& reference) {
    Image<float> out(tested.width(), tested.height());
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] = tested.pixels()[i] - reference.pixels()[i];
    return out;
}

/// Of each pixel's channel that differs most.
Image<float> largest_difference(const std::vector<Image<float>>& tested, const std::vector<Image<float>>& reference) {
    Image<float> out = subtracted(tested[0], reference[0]);
    for (std::size_t c = 1; c < tested.size(); ++c) {
        const Image<float> other = subtracted(tested[c], reference[c]);
        for (std::size_t i = 0; i < out.size(); ++i)
            if (std::abs(other.pixels()[i]) > std::abs(out.pixels()[i]))
                out.pixels()[i] = other.pixels()[i];
    }
    return out;
}

WholeFigures whole_figures(const LayerComparison& layer) {
    WholeFigures whole;
    if (const ComparedValue* flip = find_in(layer, "flip_mean")) {
        whole.mean_flip = flip->value;
        whole.no_flip = flip->why_not;
    }
    if (const ComparedValue* ssim = find_in(layer, "ssim")) {
        whole.ssim = ssim->value;
        whole.no_ssim = ssim->why_not;
    }
    return whole;
}

void judge(LayerComparison& layer, const StrictnessNode& tree, const std::vector<Image<float>>& tested,
           const std::vector<Image<float>>& reference) {
    try {
        layer.strictness = judge_strictness(tree, tested, reference, layer.unit, whole_figures(layer));
    } catch (const std::invalid_argument& error) { // pictures are checked; what is left is the mask
        throw InputError({{}, 0, 0, "--strictness"}, error.what());
    }
}

LayerComparison compare_display(const PicturePair& pair, double pixels_per_degree, const StrictnessClass* strictness, StepTimes& times) {
    const Image<Rgb8>&tested = pair.tested_display, &reference = pair.reference_display;
    LayerComparison layer{.name = "display", .unit = "levels"};
    const DisplayDifference found = compare_displays(tested, reference);
    add(layer.values, "max_error", "levels", found.maximum, found.maximum_x, found.maximum_y);
    add(layer.values, "rmse", "levels", found.rmse);
    add_psnr(layer.values, found.psnr_db, 255.0, "levels");
    add(layer.values, "percent_different", "%", found.percent_different);
    add(layer.values, "mean_difference_r", "levels", found.mean_signed[0]);
    add(layer.values, "mean_difference_g", "levels", found.mean_signed[1]);
    add(layer.values, "mean_difference_b", "levels", found.mean_signed[2]);
    times.step("errors");
    const Image<float> tested_luma = luma_of(tested), reference_luma = luma_of(reference);
    add_structure(layer.values, tested_luma, reference_luma, 255.0);
    times.step("SSIM");
    layer.colours = ciede2000_map(tested, reference);
    add_colours(layer.values, layer.colours);
    times.step("CIEDE2000");
    if (const std::string why = why_no_flip_at(pixels_per_degree); !why.empty()) {
        add_not_measured(layer.values, "flip_mean", "", why);
    } else {
        layer.flip = flip_ldr(tested, reference, pixels_per_degree);
        add_flip(layer.values, layer.flip);
    }
    times.step("FLIP");
    std::vector<Image<float>> tested_channels(3), reference_channels(3);
    oneapi::tbb::parallel_for(0, 3, [&](int c) {
        tested_channels[static_cast<std::size_t>(c)] = channel_of(tested, c);
        reference_channels[static_cast<std::size_t>(c)] = channel_of(reference, c);
    });
    layer.difference = largest_difference(tested_channels, reference_channels);
    layer.histogram = error_histogram(tested_channels, reference_channels);
    times.step("histogram");
    if (strictness)
        judge(layer, strictness->display, tested_channels, reference_channels);
    times.step("strictness");
    return layer;
}

double mean_of(const Image<float>& image) {
    double sum = 0.0;
    for (const float v : image.pixels())
        sum += static_cast<double>(v);
    return sum / static_cast<double>(image.size());
}

/// As is for what FLIP can be taken of; otherwise why not.
std::string why_no_flip(const LinearPair& pair, double pixels_per_degree) {
    if (!(peak_of(pair.reference) > 0.0))
        return "the reference has no light, so no exposure";
    const auto negative = [](const Image<float>& image) { return std::ranges::any_of(image.pixels(), [](float v) { return v < 0.0F; }); };
    return negative(pair.reference) || negative(pair.tested) ? "a luminance is below 0" : why_no_flip_at(pixels_per_degree);
}

void add_luminance_flip(LayerComparison& layer, const LinearPair& pair, double pixels_per_degree) {
    if (const std::string why = why_no_flip(pair, pixels_per_degree); !why.empty()) {
        add_not_measured(layer.values, "flip_mean", "", why);
        return;
    }
    const ExposureRange exposures = exposures_for(pair.reference);
    layer.flip = flip_hdr(pair.tested, pair.reference, exposures, pixels_per_degree);
    add_flip(layer.values, layer.flip);
    add(layer.values, "flip_start_exposure", "stops", exposures.start);
    add(layer.values, "flip_stop_exposure", "stops", exposures.stop);
    add(layer.values, "flip_exposures", "", exposures.count);
}

LayerComparison compare_linear(const LinearPair& pair, double pixels_per_degree, const StrictnessClass* strictness, StepTimes& times) {
    LayerComparison layer{.name = pair.name, .unit = pair.unit};
    const ImageDifference found = compare_images(pair.tested, pair.reference, 0.0, 0.0);
    const double peak = peak_of(pair.reference);
    add(layer.values, "max_error", pair.unit, found.maximum, found.maximum_x, found.maximum_y);
    add(layer.values, "rmse", pair.unit, found.rmse);
    add_psnr(layer.values, found.psnr_db, peak, pair.unit);
    add(layer.values, "percent_different", "%", found.percent_over);
    layer.difference = subtracted(pair.tested, pair.reference);
    add(layer.values, "mean_difference", pair.unit, mean_of(layer.difference));
    times.step("errors");
    if (peak > 0.0)
        add_structure(layer.values, decades_of(pair.tested, peak), decades_of(pair.reference, peak), decades_below_peak);
    else
        for (const char* name : {"ssim", "ms_ssim"})
            add_not_measured(layer.values, name, "", "the reference has no light, so no range");
    times.step("SSIM");
    if (pair.unit == "cd/m2" && pixels_per_degree > 0.0)
        add_luminance_flip(layer, pair, pixels_per_degree);
    times.step("FLIP");
    layer.histogram = error_histogram({pair.tested}, {pair.reference});
    times.step("histogram");
    if (strictness)
        judge(layer, strictness->linear, {pair.tested}, {pair.reference});
    times.step("strictness");
    return layer;
}

} // namespace

const ComparedValue* find_in(const LayerComparison& layer, const std::string& name) {
    const auto found = std::ranges::find(layer.values, name, &ComparedValue::name);
    return found == layer.values.end() ? nullptr : &*found;
}

std::optional<double> value_in(const LayerComparison& layer, const std::string& name) {
    const ComparedValue* found = find_in(layer, name);
    return found ? found->value : std::nullopt;
}

void StepTimes::step(const char* name) {
    const auto now = std::chrono::steady_clock::now();
    auto found = std::ranges::find(ms_, name, &std::pair<std::string, double>::first);
    if (found == ms_.end())
        found = ms_.insert(found, {name, 0.0});
    found->second += std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
}

std::string StepTimes::text() const {
    std::string text;
    for (const auto& [name, ms] : ms_)
        if (ms >= 0.5)
            text += fmt::format("{}{} {:.0f} ms", text.empty() ? "" : ", ", name, ms);
    return text;
}

bool PictureComparison::passed() const {
    return std::ranges::all_of(layers, [](const LayerComparison& layer) { return !layer.strictness || layer.strictness->passed; });
}

std::string why_no_flip_at(double pixels_per_degree) {
    return has_flip_at(pixels_per_degree) ? ""
                                          : fmt::format("{:.4g} pixels per degree, and FLIP is taken at {} to {}", pixels_per_degree,
                                                        min_pixels_per_degree, max_pixels_per_degree);
}

PictureComparison compare_pictures(const PicturePair& pair, double pixels_per_degree, const StrictnessClass* strictness, StepTimes* told) {
    StepTimes untold, &times = told ? *told : untold;
    PictureComparison comparison;
    comparison.pixels_per_degree = pixels_per_degree;
    comparison.strictness_name = strictness ? strictness->name : "";
    if (pair.is_display())
        comparison.layers.push_back(compare_display(pair, pixels_per_degree, strictness, times));
    const bool has_luminance = std::ranges::any_of(pair.linear, [](const LinearPair& linear) { return linear.unit == "cd/m2"; });
    if (strictness && !pair.is_display() && !has_luminance && has_leaf(strictness->linear, StrictnessNode::Kind::mean_flip))
        throw InputError({pair.tested, 0, 0, {}}, "has no luminance",
                         "a picture that has FLIP, as the class " + strictness->name + " asks for it");
    for (const LinearPair& linear : pair.linear)
        comparison.layers.push_back(compare_linear(linear, pixels_per_degree, strictness, times));
    return comparison;
}

} // namespace fernlicht
