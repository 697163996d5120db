#include "runner/experiments/compare/picture_comparison.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string six_digits(double value) {
    return value == std::round(value) && std::abs(value) < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value);
}

Table values_table(const LayerComparison& layer) {
    Table table{"figures-" + layer.name, "", columns_of("figure<|value|unit<|place<"), {}};
    for (const ComparedValue& v : layer.values)
        if (v.value)
            table.rows.push_back({v.name, {six_digits(*v.value), *v.value}, v.unit, v.x ? fmt::format("at {}, {}", *v.x, *v.y) : ""});
        else
            table.rows.push_back({v.name, "not measured", "", v.why_not});
    return table;
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

void add_strictness(Section& section, const StrictnessResult& r, std::size_t depth) {
    section.blocks.emplace_back(
        fmt::format("{:{}}{} {}", "", 2 * depth, r.passed ? "pass" : "FAIL", r.children.empty() ? leaf_text(r) : r.statement));
    for (const StrictnessResult& child : r.children)
        add_strictness(section, child, depth + 1);
}

std::string histogram_text(const LayerComparison& layer) {
    const auto all = static_cast<double>(layer.histogram.pixels());
    std::string text = fmt::format("pixels by error: {:.4g} % none", 100.0 * static_cast<double>(layer.histogram.equal) / all);
    for (int bin = 0; bin < ErrorHistogram::bins; bin += ErrorHistogram::bins_per_decade) { // decades are enough to read
        std::size_t count = 0;
        for (int i = bin; i < bin + ErrorHistogram::bins_per_decade; ++i)
            count += layer.histogram.counts[static_cast<std::size_t>(i)];
        if (count > 0)
            text += fmt::format(", {:.4g} % from {:g}", 100.0 * static_cast<double>(count) / all, ErrorHistogram::edge(bin));
    }
    return text + ' ' + layer.unit;
}

} // namespace

std::vector<std::string> strictness_failures(const PictureComparison& comparison) {
    std::vector<std::string> failures;
    for (const LayerComparison& layer : comparison.layers)
        if (layer.strictness)
            collect_failures(layer.name, *layer.strictness, failures);
    return failures;
}

Document document(const PicturesFound& found) {
    Document document{found.pair.tested.filename().string() + " against " + found.pair.reference.filename().string(), {}};
    document.sections.push_back({"",
                                 {"reference A  " + found.pair.reference.string(), "tested B     " + found.pair.tested.string(),
                                  fmt::format("{} x {} pixels, {:.4f} pixels per degree; differences are B - A", found.pair.width,
                                              found.pair.height, found.comparison.pixels_per_degree)}});
    for (const std::string& note : found.pair.notes)
        document.sections.front().blocks.emplace_back("note: " + note);
    for (const LayerComparison& layer : found.comparison.layers) {
        Section& section = document.sections.emplace_back(Section{layer.name, {values_table(layer), histogram_text(layer)}});
        if (!layer.strictness)
            continue;
        section.blocks.emplace_back(
            fmt::format("strictness {}: {}", found.comparison.strictness_name, layer.strictness->passed ? "pass" : "FAIL"));
        add_strictness(section, *layer.strictness, 1);
    }
    PictureStrip drawn{"Pictures", {}};
    for (const std::string& name : found.pictures)
        if (name.ends_with(".png"))
            drawn.pictures.push_back({name, name.substr(0, name.size() - 4)});
    if (!drawn.pictures.empty())
        document.sections.push_back({"", {drawn}, 2, true});
    return document;
}

} // namespace fernlicht
