#include "runner/experiments/compare/picture_comparison.h"

namespace fernlicht {
namespace {

JsonMembers compared_value_members(ComparedValue& v) {
    return {{"name", v.name}, {"unit", v.unit}, {"value", v.value}, {"not_measured", null_unless(!v.value, json_leaf(v.why_not))},
            {"x", v.x},       {"y", v.y}};
}

/// Described once, at `place`, which those within one lead back to.
JsonMembers strictness_members(StrictnessResult& r, const std::string& place) {
    JsonPart children = json_part(r.children, [place](StrictnessResult& child) { return strictness_members(child, place); });
    children.schema = [place] { return nlohmann::ordered_json{{"type", "array"}, {"items", {{"$ref", place}}}}; };
    return joined({{"statement", r.statement}, {"passed", r.passed}, {"margin", r.margin}},
                  when(r.children.empty(), {{"found", r.found},
                                            {"threshold", r.threshold},
                                            {"unit", r.unit},
                                            {"pixels", r.pixels},
                                            {"worst_x", r.worst_x},
                                            {"worst_y", r.worst_y}}),
                  when(!r.children.empty(), {{"children", children}}));
}

JsonMembers error_histogram_members(ErrorHistogram& histogram) {
    std::vector<double> edges;
    for (int i = 0; i <= ErrorHistogram::bins; ++i)
        edges.push_back(ErrorHistogram::edge(i));
    return {{"equal", histogram.equal}, {"edges", std::move(edges)}, {"counts", histogram.counts}};
}

} // namespace

JsonPart layers_part(PictureComparison& comparison, const std::string& place) {
    const auto strictness = [at = place + "/items/properties/strictness"](StrictnessResult& r) { return strictness_members(r, at); };
    return json_part(comparison.layers, [strictness](LayerComparison& layer) -> JsonMembers {
        return {{"name", layer.name},
                {"unit", layer.unit},
                {"values", layer.values, compared_value_members},
                {"strictness", layer.strictness, strictness},
                {"histogram", layer.histogram, error_histogram_members}};
    });
}

JsonMembers compared_figure_members(ComparedFigure& figure) {
    const auto svg = through([&figure] { return figure.place() + ".svg"; },
                             [&figure](const std::string& file) { figure.name = std::filesystem::path(file).stem().string(); });
    return {{"svg", svg}, {"png", figure.place() + ".png"}, {"title", figure.title}};
}

JsonMembers pictures_members(PicturesFound& found) {
    PictureComparison& comparison = found.comparison;
    return {{"schema", json_constant("fernlicht comparison")},
            {"schema_version", json_constant(2)},
            {"kind", json_constant("pictures")},
            {"notes", found.pair.notes},
            {"reference", found.pair.reference},
            {"tested", found.pair.tested},
            {"width_px", found.pair.width},
            {"height_px", found.pair.height},
            {"pixels_per_degree", comparison.pixels_per_degree},
            {"strictness", or_null(comparison.strictness_name)},
            {"passed", comparison.strictness_name.empty() ? std::nullopt : std::optional(comparison.passed())},
            {"layers", layers_part(comparison, "#/properties/layers")},
            {"pictures", found.pictures}};
}

} // namespace fernlicht
