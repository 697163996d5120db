#include "metrics/strictness/strictness_file.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/picture_decoding.h"
#include "scenarios/yaml/yaml_entry.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace fernlicht {
namespace {

using NodeKind = StrictnessNode::Kind;

constexpr std::size_t most_children = 64;
constexpr double largest_bound = 1e9;

PixelMask read_mask(const YamlEntry& entry) {
    constexpr std::size_t most_pixels = (std::size_t{1} << 28) / 3;
    FilesRead opened;
    const std::filesystem::path path = entry.path();
    const DecodedPicture picture = decode_picture(path, entry.key_path(), read_file(path, opened), most_pixels);
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

StrictnessNode read_leaf(NodeKind kind, const YamlEntry& entry) {
    StrictnessNode node{.kind = kind};
    if (kind == NodeKind::hard_limit) {
        node.bound = read_bound(entry.map({"absolute", "relative"}));
        return node;
    }
    if (kind == NodeKind::mean_flip || kind == NodeKind::ssim) {
        const char* key = kind == NodeKind::ssim ? "at_least" : "at_most";
        node.figure = entry.map({key}).require(key).number(0.0, 1.0);
        return node;
    }
    const YamlMap leaf = kind == NodeKind::percentage ? entry.map({"percent", "absolute", "relative", "one_pixel_shift", "mask"})
                                                      : entry.map({"absolute", "relative", "one_pixel_shift", "mask"});
    node.bound = read_bound(leaf);
    if (kind == NodeKind::percentage)
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
    static const std::map<std::string_view, NodeKind> leaves{{"every", NodeKind::every},
                                                             {"percentage", NodeKind::percentage},
                                                             {"hard_limit", NodeKind::hard_limit},
                                                             {"mean_flip", NodeKind::mean_flip},
                                                             {"ssim", NodeKind::ssim}};
    if (const auto leaf = leaves.find(word); leaf != leaves.end())
        return read_leaf(leaf->second, value);
    StrictnessNode node{.kind = word == "all" ? NodeKind::all : NodeKind::any};
    for (const YamlEntry& child : value.list(1, most_children))
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
    const StrictnessNode same{.kind = NodeKind::every};
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
