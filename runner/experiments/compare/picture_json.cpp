#include "runner/experiments/compare/picture_comparison.h"
#include "runner/files/json_text.h"

#include <nlohmann/json.hpp>
#include <tuple>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json value_json(const ComparedValue& v) {
    return {{"name", v.name},
            {"unit", v.unit},
            {"value", v.value ? Json(*v.value) : Json(nullptr)},
            {"not_measured", v.value ? Json(nullptr) : Json(v.why_not)},
            {"x", v.place ? Json(v.place->first) : Json(nullptr)},
            {"y", v.place ? Json(v.place->second) : Json(nullptr)}};
}

Json strictness_json(const StrictnessResult& r) {
    Json out{{"statement", r.statement}, {"passed", r.passed}, {"margin", r.margin ? Json(*r.margin) : Json(nullptr)}};
    if (r.children.empty()) {
        out["found"] = r.found;
        out["threshold"] = r.threshold;
        out["unit"] = r.unit;
        out["pixels"] = r.pixels;
        out["worst_x"] = r.worst_x;
        out["worst_y"] = r.worst_y;
        return out;
    }
    out["children"] = Json::array();
    for (const StrictnessResult& child : r.children)
        out["children"].push_back(strictness_json(child));
    return out;
}

Json histogram_json(const ErrorHistogram& histogram) {
    Json edges = Json::array();
    for (int i = 0; i <= ErrorHistogram::bins; ++i)
        edges.push_back(ErrorHistogram::edge(i));
    return {{"equal", histogram.equal}, {"edges", edges}, {"counts", histogram.counts}};
}

} // namespace

nlohmann::ordered_json layers_json(const PictureComparison& comparison) {
    Json layers = Json::array();
    for (const LayerComparison& layer : comparison.layers) {
        Json values = Json::array();
        for (const ComparedValue& v : layer.values)
            values.push_back(value_json(v));
        layers.push_back({{"name", layer.name},
                          {"unit", layer.unit},
                          {"values", values},
                          {"strictness", layer.strictness ? strictness_json(*layer.strictness) : Json(nullptr)},
                          {"histogram", histogram_json(layer.histogram)}});
    }
    return layers;
}

nlohmann::ordered_json figures_json(const std::vector<ComparedFigure>& figures) {
    Json list = Json::array();
    for (const ComparedFigure& figure : figures)
        list.push_back({{"svg", figure.place() + ".svg"}, {"png", figure.place() + ".png"}, {"title", figure.title}});
    return list;
}

std::string pictures_json(const PicturesFound& found) {
    const auto& [comparison, pair] = std::tie(found.comparison, found.pair);
    return json_text({{"schema", "fernlicht comparison"},
                      {"schema_version", 2},
                      {"kind", "pictures"},
                      {"notes", pair.notes},
                      {"reference", pair.reference.string()},
                      {"tested", pair.tested.string()},
                      {"width_px", pair.width},
                      {"height_px", pair.height},
                      {"pixels_per_degree", comparison.pixels_per_degree},
                      {"strictness", comparison.strictness_name.empty() ? Json(nullptr) : Json(comparison.strictness_name)},
                      {"passed", comparison.strictness_name.empty() ? Json(nullptr) : Json(comparison.passed())},
                      {"layers", layers_json(comparison)},
                      {"pictures", found.pictures}});
}

} // namespace fernlicht
