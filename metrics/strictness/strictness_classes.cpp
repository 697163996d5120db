#include "metrics/strictness/strictness.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/picture_decoding.h"
#include "scenarios/yaml/yaml_entry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace fernlicht {
namespace {

using Kind = StrictnessNode::Kind;

StrictnessNode every(double absolute, double relative) { return {.kind = Kind::every, .bound = {absolute, relative}}; }

StrictnessNode percentage(double percent, double absolute, double relative, bool shift) {
    return {.kind = Kind::percentage, .bound = {absolute, relative}, .percent = percent, .one_pixel_shift = shift};
}

StrictnessNode joined(Kind kind, std::vector<StrictnessNode> children) { return {.kind = kind, .children = std::move(children)}; }

} // namespace

const std::vector<StrictnessClass>& strictness_classes() {
    static const std::vector<StrictnessClass> classes{
        // "Same inputs, same backend, same driver, same kind of CPU: same bytes."
        {"identical", "the same bytes, as one machine promises for one drive", every(0.0, 0.0), every(0.0, 0.0)},
        // As baselines are judged: a thousandth is what rounding in another order makes of a sum of lamps, 1e-4 lx where there is
        // next to no light, and one pixel in 10 000 is an edge where another triangle wins. A thousandth is a tenth of a level: one level
        // by rounding.
        {"same-driver", "what another patch level of a driver or a library may round otherwise", percentage(0.01, 1.0, 0.0, false),
         percentage(0.01, 1e-4, 1e-3, false)},
        // Half of the 2 % that must never pass. 1 % of light is 255 * 0.01 / 2.4 = 1.1 levels at white: 2 with rounding. Either all pixels
        // keep it, or, since edges fall otherwise in another rasteriser, 99 of 100 do while edges may move by one pixel.
        {"same-light", "another technique, rasteriser or GPU that promises the same light to 1 %",
         joined(Kind::any, {every(2.0, 0.0), percentage(1.0, 2.0, 0.0, true)}),
         joined(Kind::any, {every(0.01, 0.01), percentage(1.0, 0.01, 0.01, true)})},
        // A tenth of the light is near what an eye at night tells apart in one place; at white it is 255 * 0.1 / 2.4 = 11 levels, and 8 a
        // tenth at half of white. What breaks it may be small (2 % of the pixels), but not glaring: four times as much in one pixel of a
        // thousand.
        {"same-picture", "what a person takes for the same picture, another exposure of edges and texture included",
         joined(Kind::all, {percentage(2.0, 8.0, 0.0, true), percentage(0.1, 32.0, 0.0, true)}),
         joined(Kind::all, {percentage(2.0, 0.1, 0.1, true), percentage(0.1, 0.1, 0.4, true)})}};
    return classes;
}

namespace {

constexpr std::size_t max_children = 64;
constexpr double largest_bound = 1e9;

PixelMask read_mask(const YamlEntry& entry) {
    constexpr std::size_t max_pixels = (std::size_t{1} << 28) / 3;
    FilesRead opened;
    const std::filesystem::path path = entry.path();
    const DecodedPicture picture = decode_picture(path, entry.key_path(), read_file(path, opened), max_pixels);
    PixelMask mask(picture.width, picture.height);
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.pixels()[i] = picture.rgba[4 * i] || picture.rgba[4 * i + 1] || picture.rgba[4 * i + 2] ? 255 : 0;
    return mask;
}

PixelBound read_bound(const YamlMap& leaf) {
    if (!leaf.find("absolute") && !leaf.find("relative"))
        leaf.refuse_missing("absolute", "absolute (in the picture's unit), relative (share of the reference) or both");
    return {leaf.number_or("absolute", 0.0, 0.0, largest_bound), leaf.number_or("relative", 0.0, 0.0, largest_bound)};
}

StrictnessNode read_leaf(Kind kind, const YamlEntry& entry) {
    StrictnessNode node{.kind = kind};
    if (kind == Kind::hard_limit) {
        node.bound = read_bound(entry.map({"absolute", "relative"}));
        return node;
    }
    if (kind == Kind::mean_flip || kind == Kind::ssim) {
        const char* key = kind == Kind::ssim ? "at_least" : "at_most";
        node.figure = entry.map({key}).require(key).number(0.0, 1.0);
        return node;
    }
    const YamlMap leaf = kind == Kind::percentage ? entry.map({"percent", "absolute", "relative", "one_pixel_shift", "mask"})
                                                  : entry.map({"absolute", "relative", "one_pixel_shift", "mask"});
    node.bound = read_bound(leaf);
    if (kind == Kind::percentage)
        node.percent = leaf.require("percent").number(0.0, 100.0);
    node.one_pixel_shift = leaf.flag_or("one_pixel_shift", false);
    if (const std::optional<YamlEntry> mask = leaf.find("mask")) {
        node.mask = read_mask(*mask);
        node.mask_name = printable(mask->text());
    }
    return node;
}

StrictnessNode read_node(const YamlEntry& entry) {
    const YamlMap map = entry.map({"all", "any", "every", "percentage", "hard_limit", "mean_flip", "ssim"});
    const auto chosen = map.one_of({"all", "any", "every", "percentage", "hard_limit", "mean_flip", "ssim"});
    if (!chosen)
        entry.refuse("one of all, any, every, percentage, hard_limit, mean_flip, ssim");
    const auto& [word, value] = *chosen;
    static const std::map<std::string_view, Kind> leaves{{"every", Kind::every},
                                                         {"percentage", Kind::percentage},
                                                         {"hard_limit", Kind::hard_limit},
                                                         {"mean_flip", Kind::mean_flip},
                                                         {"ssim", Kind::ssim}};
    if (const auto leaf = leaves.find(word); leaf != leaves.end())
        return read_leaf(leaf->second, value);
    StrictnessNode node{.kind = word == "all" ? Kind::all : Kind::any};
    for (const YamlEntry& child : value.list(1, max_children))
        node.children.push_back(read_node(child));
    return node;
}

StrictnessClass read_class(const std::filesystem::path& file) {
    FilesRead opened;
    const YamlValue document = parse_yaml(read_file(file, opened, std::size_t{1} << 20), file);
    const YamlMap map = YamlEntry(document, file, "").map({"name", "meaning", "display", "linear"});
    StrictnessClass read;
    read.name = map.require("name").name();
    if (const std::optional<YamlEntry> meaning = map.find("meaning"))
        read.meaning = meaning->text();
    // A class for one kind of picture alone keeps the other to the same bytes, rather than to nothing.
    const StrictnessNode same{.kind = Kind::every};
    if (!map.find("display") && !map.find("linear"))
        map.refuse_missing("display", "display, linear or both");
    const std::optional<YamlEntry> display = map.find("display"), linear = map.find("linear");
    read.display = display ? read_node(*display) : same;
    read.linear = linear ? read_node(*linear) : same;
    return read;
}

} // namespace

StrictnessClass read_strictness(const std::string& name_or_file) {
    std::vector<std::string> names;
    for (const StrictnessClass& one : strictness_classes()) {
        if (one.name == name_or_file)
            return one;
        names.push_back(one.name);
    }
    std::error_code ignored;
    if (std::filesystem::exists(name_or_file, ignored))
        return read_class(name_or_file);
    const std::string nearest = nearest_name(name_or_file, names);
    throw InputError({{}, 0, 0, "--strictness"}, fmt::format("found '{}', which is neither a class nor a file", printable(name_or_file)),
                     nearest.empty() ? fmt::format("one of {}, or a YAML file", fmt::join(names, ", ")) : nearest);
}

} // namespace fernlicht
