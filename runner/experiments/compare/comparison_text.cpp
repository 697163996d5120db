#include "runner/experiments/compare/comparison_writers.h"
#include "runner/experiments/compare/strictness_failures.h"
#include "runner/write/aligned_table.h"
#include "scenarios/values/errors.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string six_digits(double value) {
    return value == std::round(value) && std::abs(value) < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value);
}

void append_values(std::string& text, const LayerComparison& layer) {
    std::vector<std::vector<std::string>> rows;
    for (const ComparedValue& v : layer.values)
        rows.push_back({"  " + v.name, v.value ? six_digits(*v.value) : "not measured", v.value ? v.unit : "",
                        !v.value  ? v.why_not
                        : v.place ? fmt::format("at {}, {}", v.place->first, v.place->second)
                                  : ""});
    text += aligned_table("<><<", {"  " + layer.name, "", "", ""}, rows);
}

std::string margin_text(const StrictnessResult& r) {
    if (!r.margin)
        return "no share of 0";
    return fmt::format("{:.3g} % {}", 100.0 * std::abs(*r.margin), *r.margin >= 0.0 ? "to spare" : "too much");
}

std::string leaf_text(const StrictnessResult& r) {
    return fmt::format("{}: {} of {} {}, {}, farthest at {}, {}", r.statement, six_digits(r.found), six_digits(r.threshold), r.unit,
                       margin_text(r), r.worst_x, r.worst_y);
}

void collect_failures(const std::string& layer, const StrictnessResult& r, std::vector<std::string>& failures) {
    if (r.passed)
        return;
    if (r.children.empty())
        failures.push_back(layer + ": " + leaf_text(r));
    for (const StrictnessResult& child : r.children)
        collect_failures(layer, child, failures);
}

void append_strictness(std::string& text, const StrictnessResult& r, std::size_t depth) {
    text += fmt::format("{:{}}{} {}\n", "", 2 * depth + 2, r.passed ? "pass" : "FAIL", r.children.empty() ? leaf_text(r) : r.statement);
    for (const StrictnessResult& child : r.children)
        append_strictness(text, child, depth + 1);
}

void append_histogram(std::string& text, const LayerComparison& layer) {
    const auto all = static_cast<double>(layer.histogram.pixels());
    text += fmt::format("  pixels by error: {:.4g} % none", 100.0 * static_cast<double>(layer.histogram.equal) / all);
    for (int bin = 0; bin < ErrorHistogram::bins; bin += ErrorHistogram::bins_per_decade) { // decades are enough to read
        std::size_t count = 0;
        for (int i = bin; i < bin + ErrorHistogram::bins_per_decade; ++i)
            count += layer.histogram.counts[static_cast<std::size_t>(i)];
        if (count > 0)
            text += fmt::format(", {:.4g} % from {:g}", 100.0 * static_cast<double>(count) / all, ErrorHistogram::edge(bin));
    }
    text += ' ' + layer.unit + '\n';
}

} // namespace

std::vector<std::string> strictness_failures(const PictureComparison& comparison) {
    std::vector<std::string> failures;
    for (const LayerComparison& layer : comparison.layers)
        if (layer.strictness)
            collect_failures(layer.name, *layer.strictness, failures);
    return failures;
}

std::string comparison_text(const PictureComparison& comparison, const PicturePair& pair) {
    std::string text = fmt::format("reference A  {}\ntested B     {}\n{} x {} pixels, {:.4f} pixels per degree; differences are B - A\n",
                                   printable(pair.reference.string(), 400), printable(pair.tested.string(), 400), pair.width, pair.height,
                                   comparison.pixels_per_degree);
    for (const std::string& note : pair.notes)
        text += "note: " + note + '\n';
    for (const LayerComparison& layer : comparison.layers) {
        text += '\n';
        append_values(text, layer);
        append_histogram(text, layer);
        if (layer.strictness) {
            text += fmt::format("  strictness {}: {}\n", comparison.strictness_name, layer.strictness->passed ? "pass" : "FAIL");
            append_strictness(text, *layer.strictness, 1);
        }
    }
    return text;
}

} // namespace fernlicht
