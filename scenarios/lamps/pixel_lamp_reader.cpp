#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/pixel_lamp.h"
#include "scenarios/lamps/pixel_lamp_file.h"
#include "scenarios/yaml/yaml_entry.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr int most_pixels_each_way = 4096;
constexpr int widest_spread = 16; ///< in pixels: what lights a direction is added up pixel by pixel
/// What of a segment's own peak counts as lit, where its file does not say which directions it lights.
constexpr double lit_share = 0.05;

void check_ascending(const YamlMap& keys, const char* key, const std::vector<double>& pair) {
    if (pair[0] >= pair[1])
        keys.require(key).refuse("edges that do not ascend", "[lower, upper]");
}

void check_lit_box(const YamlMap& keys, const LitBoxKeys& box) {
    check_ascending(keys, "h_deg", box.h_deg);
    check_ascending(keys, "v_deg", box.v_deg);
}

const Fields<LitBoxKeys>& lit_box_fields() {
    static const Fields<LitBoxKeys> fields =
        Fields<LitBoxKeys>{
            field("h_deg", 1, &LitBoxKeys::h_deg, numbers(2, 2, -180.0, 180.0), "left and right edge").required(),
            field("v_deg", 2, &LitBoxKeys::v_deg, numbers(2, 2, -90.0, 90.0), "lower and upper edge").required(),
        }
            .checked(check_lit_box);
    return fields;
}

const Fields<PixelSegmentKeys>& segment_fields() {
    static const Fields<PixelSegmentKeys> fields = Fields<PixelSegmentKeys>{
        field("file", 1, &PixelSegmentKeys::file, any(), "what it shines by itself at full level: a lamp file").required(),
        field("lights", 2, &PixelSegmentKeys::lights, lit_box_fields(),
              "the directions that it lights, for laws that dim it; where its table has 5 % of its peak or more by default"),
        field("dead", 3, &PixelSegmentKeys::dead, any(), "dark whatever it is asked for"),
    };
    return fields;
}

void read_dead(const YamlEntry& entry, PixelRasterKeys& raster) {
    for (const YamlEntry& pixel : entry.list(0, 100'000)) {
        const std::vector<YamlEntry> place = pixel.list(2, 2);
        raster.dead.emplace_back(place[0].whole(0, most_pixels_each_way - 1), place[1].whole(0, most_pixels_each_way - 1));
    }
}

std::string dead_text(const PixelRasterKeys& raster) {
    std::string text;
    for (const auto& [column, row] : raster.dead)
        text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", column, row);
    return fmt::format("[{}]", text);
}

void check_raster(const YamlMap& keys, const PixelRasterKeys& raster) {
    check_ascending(keys, "h_deg", raster.h_deg);
    check_ascending(keys, "v_deg", raster.v_deg);
    if (raster.cd.has_value() == !raster.profile.empty())
        raster.cd ? keys.require("profile").refuse("a profile beside cd", "one of them") : keys.refuse_missing("cd", "cd or profile");
    for (const double pixels : raster.pixels)
        if (pixels != std::floor(pixels))
            keys.require("pixels").refuse("a part of a pixel", "[columns, rows], whole numbers");
    const double pixel_deg[]{(raster.h_deg[1] - raster.h_deg[0]) / raster.pixels[0],
                             (raster.v_deg[1] - raster.v_deg[0]) / raster.pixels[1]};
    for (std::size_t way = 0; way < 2; ++way)
        if (raster.spread_deg[way] > widest_spread * pixel_deg[way])
            keys.require("spread_deg")
                .refuse(fmt::format("{} degrees, of pixels {:.3g} degrees wide", raster.spread_deg[way], pixel_deg[way]),
                        fmt::format("at most the width of {} pixels", widest_spread));
    for (const auto& [column, row] : raster.dead)
        if (column >= raster.pixels[0] || row >= raster.pixels[1])
            keys.require("dead").refuse(fmt::format("pixel [{}, {}]", column, row),
                                        fmt::format("pixels below [{:g}, {:g}]; the first is [0, 0]", raster.pixels[0], raster.pixels[1]));
}

const Fields<PixelRasterKeys>& raster_fields() {
    using Raster = PixelRasterKeys;
    static const Fields<Raster> fields =
        Fields<Raster>{
            field("pixels", 1, &Raster::pixels, numbers(2, 2, 1, most_pixels_each_way), "columns and rows").required(),
            field("h_deg", 2, &Raster::h_deg, numbers(2, 2, -90.0, 90.0), "left and right edge of all pixels").required(),
            field("v_deg", 3, &Raster::v_deg, numbers(2, 2, -90.0, 90.0), "lower and upper edge").required(),
            field("spread_deg", 4, &Raster::spread_deg, numbers(2, 2, 0.001, 20.0),
                  "across and up: standard deviation of the Gaussian that blurs each pixel's rectangle")
                .required(),
            field("cd", 5, &Raster::cd, above(0.0, max_intensity_cd), "of an evenly lit field; or profile"),
            field("profile", 6, &Raster::profile, any(),
                  "a lamp file: what all pixels give together, taken at each pixel's middle and blurred as pixels are"),
            field("crosstalk", 7, &Raster::crosstalk, range(0.0, 0.9), "share of a pixel's light that its four neighbours send instead"),
            own("dead", 8, read_dead, dead_text,
                R"({"type": "array", "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "integer", "minimum": 0}}})",
                "pixels that stay dark: [column, row] each, from [0, 0] at the top left"),
        }
            .checked(check_raster);
    return fields;
}

void read_pixel_version(const YamlEntry& entry, PixelLampKeys& lamp) {
    lamp.version = entry.whole(0, 1'000'000);
    if (lamp.version != 1)
        entry.refuse("1, the version of pixel lamps that this program knows");
}

void check_pixel_lamp(const YamlMap& keys, const PixelLampKeys& lamp) {
    if (lamp.raster && !lamp.segments.empty())
        keys.require("segments").refuse("segments beside a raster", "one of them");
    if (!lamp.raster && lamp.segments.empty())
        keys.refuse_missing("raster", "raster or segments");
}

/// A lamp file that the description names.
LampFile part_of(const YamlEntry& asked_by, const std::filesystem::path& path, LampFile& whole) {
    if (std::error_code none; !std::filesystem::is_regular_file(path, none))
        asked_by.refuse(fmt::format("there is no file {}", printable(path.string(), 400)),
                        "a lamp file (relative paths start at this file's folder)");
    FilesRead twice; // it may name the very file that names it
    if (looks_like_pixel_lamp(read_file(path, twice, max_lamp_text_bytes)))
        asked_by.refuse("a pixel lamp", "a lamp file with one table");
    LampFile part = read_lamp(path, {});
    whole.opened.insert(whole.opened.end(), part.opened.begin(), part.opened.end());
    return part;
}

AngleBox box_of(const LitBoxKeys& box) { return {box.h_deg[0], box.h_deg[1], box.v_deg[0], box.v_deg[1]}; }

AngleBox lit_box(const CandelaTable& table) {
    const double least = lit_share * peak_of(table).cd;
    AngleBox box{180.0, -180.0, 90.0, -90.0};
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            if (table.at(v, h) > 0.0 && table.at(v, h) >= least)
                box = {std::min(box.left_deg, table.h_deg[h]), std::max(box.right_deg, table.h_deg[h]),
                       std::min(box.bottom_deg, table.v_deg[v]), std::max(box.top_deg, table.v_deg[v])};
    return box;
}

PixelRaster raster_of(const PixelRasterKeys& keys, const YamlMap& map, LampFile& whole) {
    PixelRaster raster{static_cast<int>(keys.pixels[0]),
                       static_cast<int>(keys.pixels[1]),
                       {keys.h_deg[0], keys.h_deg[1], keys.v_deg[0], keys.v_deg[1]},
                       keys.spread_deg[0],
                       keys.spread_deg[1],
                       {},
                       keys.crosstalk};
    std::optional<CandelaTable> profile;
    if (!keys.cd)
        profile = part_of(map.require("profile"), keys.profile, whole).table;
    const double pixel_h = (keys.h_deg[1] - keys.h_deg[0]) / raster.columns, pixel_v = (keys.v_deg[1] - keys.v_deg[0]) / raster.rows;
    for (int row = 0; row < raster.rows; ++row)
        for (int column = 0; column < raster.columns; ++column)
            raster.cd.push_back(
                profile ? intensity_cd(*profile, keys.h_deg[0] + (column + 0.5) * pixel_h, keys.v_deg[1] - (row + 0.5) * pixel_v)
                        : *keys.cd);
    return raster;
}

PixelParts parts_of(const PixelLampKeys& keys, const YamlMap& map, LampFile& whole) {
    PixelParts parts;
    parts.answer = {keys.latency_s, keys.slew_per_s.value_or(std::numeric_limits<double>::infinity()), keys.steps, keys.exponent};
    if (!keys.base.empty())
        parts.base.push_back(part_of(map.require("base"), keys.base, whole).table);
    if (keys.raster) {
        const YamlMap raster = map.require("raster").map(keys_of(raster_fields()));
        parts.raster.push_back(raster_of(*keys.raster, raster, whole));
        for (const auto& [column, row] : keys.raster->dead)
            parts.dead.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(parts.raster.front().columns) +
                                 static_cast<std::size_t>(column));
        return parts;
    }
    const std::vector<YamlEntry> entries = map.require("segments").list(1, PixelLamp::most_segments);
    for (std::size_t i = 0; i < keys.segments.size(); ++i) {
        const PixelSegmentKeys& segment = keys.segments[i];
        LampFile file = part_of(entries[i], segment.file, whole);
        const AngleBox lights = segment.lights ? box_of(*segment.lights) : lit_box(file.table);
        if (const CandelaTable& t = file.table; lights.right_deg < t.h_deg.front() || lights.left_deg > t.h_deg.back() ||
                                                lights.top_deg < t.v_deg.front() || lights.bottom_deg > t.v_deg.back())
            entries[i].refuse("lights beside its table", fmt::format("some of H {:g} to {:g}, V {:g} to {:g} degrees", t.h_deg.front(),
                                                                     t.h_deg.back(), t.v_deg.front(), t.v_deg.back()));
        parts.segments.push_back({file.name, std::move(file.table), lights});
        if (segment.dead)
            parts.dead.push_back(i);
    }
    return parts;
}

} // namespace

const Fields<PixelLampKeys>& pixel_lamp_fields() {
    using Lamp = PixelLampKeys;
    static const Fields<Lamp> fields =
        Fields<Lamp>{
            field("fernlicht_pixel_lamp", 1, &Lamp::version, range(1, 1), "version of this format").required().read_by(read_pixel_version),
            field("name", 2, &Lamp::name, any(), "for people; the file's name by default"),
            field("base", 3, &Lamp::base, any(), "a lamp file: light that is always on and does not dim"),
            field("raster", 4, &Lamp::raster, raster_fields(), "pixels in columns and rows, all alike"),
            list("segments", 5, &Lamp::segments, 0, PixelLamp::most_segments, segment_fields(),
                 "instead of a raster: a lamp file for each, in the order in which levels are given"),
            field("steps", 6, &Lamp::steps, range(0, 65535), "levels between dark and full that it can be set to, 255 of 8 bits; 0: any"),
            field("exponent", 7, &Lamp::exponent, range(0.1, 10.0), "light is level to the power of it"),
            field("slew_per_s", 8, &Lamp::slew_per_s, above(0.0, 1.0e6), "how fast a level can change, a second; at once by default"),
            field("latency_s", 9, &Lamp::latency_s, range(0.0, 10.0), "from what is asked until it begins to change"),
        }
            .block()
            .checked(check_pixel_lamp);
    return fields;
}

bool looks_like_pixel_lamp(std::string_view text) {
    LineReader lines(text);
    for (std::string_view line; lines.next(line);)
        if (line.starts_with("fernlicht_pixel_lamp"))
            return true;
        else if (!trimmed(line).empty() && !trimmed(line).starts_with('#') && trimmed(line) != "---")
            return false;
    return false;
}

LampFile read_pixel_lamp(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened) {
    if (options.rule != BetweenSamples::linear_cd || !options.recipe.empty())
        throw InputError({path, 0, 0, options.recipe.empty() ? "between_samples" : "recipe"}, "a way to read the table of a pixel lamp",
                         "none: its table is the sum of its pixels', linear between samples");
    const YamlValue document = parse_yaml(std::string(text), path);
    const YamlEntry entry(document, path, "");
    const PixelLampKeys keys = read_fields(pixel_lamp_fields(), entry);
    LampFile lamp{.name = keys.name.empty() ? path.stem().string() : keys.name, .format = "pixel lamp", .opened = std::move(opened)};
    try {
        lamp.pixels = std::make_shared<const PixelLamp>(parts_of(keys, entry.map(keys_of(pixel_lamp_fields())), lamp));
    } catch (const std::invalid_argument& error) {
        throw InputError({path, 0, 0, {}}, error.what());
    }
    const auto counted = [&](std::size_t count) {
        return fmt::format("{} {}{}", count, keys.raster ? "pixel" : "segment", count == 1 ? "" : "s");
    };
    lamp.format = "pixel lamp, " + counted(lamp.pixels->count());
    lamp.table = lamp.pixels->table(std::vector<float>(lamp.pixels->count(), 1.0F));
    if (!lamp.pixels->parts().dead.empty())
        lamp.notes.push_back(fmt::format("{} of {} dead", lamp.pixels->parts().dead.size(), counted(lamp.pixels->count())));
    return lamp;
}

} // namespace fernlicht
