#include "scenarios/lamps/beam_files.h"

#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/measured_grid.h"
#include "scenarios/values/picture_decoding.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double written_distance_m = 25.0;
constexpr std::size_t longest_side = 4096;

struct Extent {
    double low_deg = 0.0, high_deg = 0.0;
};

/// Metadata under our own prefix.
class Metadata {
  public:
    Metadata(const std::filesystem::path& path, const std::map<std::string, std::string>& attributes)
        : path_(path), attributes_(attributes) {}

    const std::string* text(const std::string& key) const {
        const auto found = attributes_.find("fernlicht:" + key);
        return found == attributes_.end() ? nullptr : &found->second;
    }
    double above_zero(const std::string& key, double otherwise) const {
        const std::string* value = text(key);
        const double number = value ? finite_number(*value, where(key)) : otherwise;
        if (!(number > 0.0 && number < 1e9))
            throw InputError(where(key),
                             value ? fmt::format("found '{}'", printable(*value)) : "is neither in the options nor in the picture",
                             "a number above 0");
        return number;
    }
    Extent extent(const std::string& key) const {
        const std::string* value = text(key);
        if (!value)
            throw InputError(where(key), "is neither in the options nor in the picture", "two angles in degrees");
        const std::string_view pair = trimmed(*value);
        const std::size_t blank = std::min(pair.find(' '), pair.size());
        return {finite_number(pair.substr(0, blank), where(key)), finite_number(pair.substr(blank), where(key))};
    }
    InputError::Where where(const std::string& key) const { return {path_, 0, 0, "fernlicht:" + key}; }

  private:
    const std::filesystem::path& path_;
    const std::map<std::string, std::string>& attributes_;
};

std::vector<double> pixel_centres(const Extent& extent, int count, double limit, const InputError::Where& where) {
    if (!(extent.low_deg < extent.high_deg && extent.low_deg >= -2.0 * limit && extent.high_deg <= 2.0 * limit))
        throw InputError(where, fmt::format("found {} to {}", extent.low_deg, extent.high_deg),
                         fmt::format("ascending angles within -{} to {}", limit, limit));
    std::vector<double> out;
    for (int i = 0; i < count; ++i)
        out.push_back(extent.low_deg + (extent.high_deg - extent.low_deg) * (i + 0.5) / count);
    // A written table that ends at the limit has its outermost centres there, but for rounding.
    for (double& angle : out)
        if (std::abs(angle) > limit && std::abs(angle) < limit + 1e-9)
            angle = std::copysign(limit, angle);
    if (out.front() < -limit || out.back() > limit || !(out[1] > out[0]))
        throw InputError(where, fmt::format("puts pixel centres at {} to {}", out.front(), out.back()),
                         fmt::format("angles within -{} to {}", limit, limit));
    return out;
}

double option_above_zero(double value, const char* name, const std::filesystem::path& path) {
    if (!(value > 0.0 && value < 1e9))
        throw InputError({path, 0, 0, name}, fmt::format("found {}", value), "a number above 0");
    return value;
}

/// The picture's rows from the bottom up, in cd.
std::vector<double> intensities(const Image<float>& value, double cd_per_value, const std::filesystem::path& path) {
    std::vector<double> cd;
    cd.reserve(value.size());
    for (int y = value.height() - 1; y >= 0; --y)
        for (int x = 0; x < value.width(); ++x) {
            const double v = static_cast<double>(value.at(x, y));
            if (!std::isfinite(v))
                throw InputError({path, 0, 0, fmt::format("pixel {}, {}", x, y)}, fmt::format("found {}", v), "a finite value");
            cd.push_back(v * cd_per_value);
        }
    return cd;
}

void take_texts(const Metadata& metadata, LampFile& lamp) {
    if (const std::string* name = metadata.text("name"))
        lamp.name = *name;
    if (metadata.text("flux_lm"))
        lamp.declared_flux_lm = metadata.above_zero("flux_lm", 0.0);
    const std::string* labels = metadata.text("labels");
    LineReader lines(labels ? *labels : std::string_view{});
    for (std::string_view line; lines.next(line) && lamp.labels.size() < max_lamp_labels;)
        lamp.labels.emplace_back(line.substr(0, line.find(':')),
                                 line.find(':') == std::string_view::npos ? "" : trimmed(line.substr(line.find(':') + 1)));
}

/// An even axis that holds all samples, or one twice as fine as the finest step.
struct EvenAxis {
    double first_deg = 0.0, step_deg = 1.0;
    std::size_t count = 2;

    double at(std::size_t i) const { return first_deg + step_deg * static_cast<double>(i); }
    Extent extent() const { return {first_deg - step_deg / 2.0, at(count - 1) + step_deg / 2.0}; }
};

EvenAxis even_axis(const std::vector<double>& axis) {
    const double finest = finest_step(axis), range = axis.back() - axis.front();
    for (const double part : {1.0, 2.0, 3.0, 4.0, 5.0}) {
        const double intervals = std::round(range * part / finest);
        if (intervals + 1.0 > static_cast<double>(longest_side))
            break;
        const double step = range / intervals;
        const bool fits = std::all_of(axis.begin(), axis.end(), [&](double angle) {
            const double place = (angle - axis.front()) / step;
            return std::abs(place - std::round(place)) * step < 1e-9;
        });
        if (fits)
            return {axis.front(), step, static_cast<std::size_t>(intervals) + 1};
    }
    const double intervals = std::min(std::ceil(2.0 * range / finest), static_cast<double>(longest_side) / 2.0 - 1.0);
    return {axis.front(), range / intervals, static_cast<std::size_t>(intervals) + 1};
}

/// A lattice point that is a sample but for rounding is that sample: beside it may begin a gap, or nothing.
double on_axis(double angle, const std::vector<double>& axis) {
    const auto above = std::lower_bound(axis.begin(), axis.end(), angle);
    for (const auto near : {above, above == axis.begin() ? above : above - 1})
        if (near != axis.end() && std::abs(*near - angle) < 1e-9)
            return *near;
    return angle;
}

Image<float> rendered(const CandelaTable& table, const EvenAxis& h, const EvenAxis& v) {
    Image<float> picture(static_cast<int>(h.count), static_cast<int>(v.count));
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const double hd = on_axis(h.at(static_cast<std::size_t>(x)), table.h_deg);
            const double vd = on_axis(v.at(v.count - 1 - static_cast<std::size_t>(y)), table.v_deg);
            picture.at(x, y) = static_cast<float>(intensity_cd(table, hd, vd) / (written_distance_m * written_distance_m));
        }
    return picture;
}

} // namespace

bool looks_like_beam_texture(std::string_view bytes) { return bytes.starts_with("\x89PNG") || bytes.starts_with("\x76\x2f\x31\x01"); }

LampFile read_beam_texture(const std::filesystem::path& path, std::string_view bytes, const LampReadOptions& options, FilesRead opened) {
    const TextureImage image = decode_texture(path, std::string(bytes), max_made_samples);
    const Metadata metadata(path, image.attributes);
    LampFile lamp{.name = path.stem().string(), .format = "beam texture", .opened = std::move(opened)};
    take_texts(metadata, lamp);
    const bool own_scale = options.texture_scale_lx == 0.0;
    const double scale =
        own_scale ? metadata.above_zero("scale_lx", 0.0) : option_above_zero(options.texture_scale_lx, "texture scale", path);
    const double distance = own_scale ? metadata.above_zero("distance_m", options.texture_distance_m)
                                      : option_above_zero(options.texture_distance_m, "texture distance", path);
    const auto extent = [&](const double(&given)[2], const char* key) {
        return given[0] == given[1] ? metadata.extent(key) : Extent{given[0], given[1]};
    };
    MeasuredGrid grid;
    grid.h_deg =
        pixel_centres(extent(options.texture_h_extent_deg, "h_extent_deg"), image.value.width(), 180.0, metadata.where("h_extent_deg"));
    grid.v_deg =
        pixel_centres(extent(options.texture_v_extent_deg, "v_extent_deg"), image.value.height(), 90.0, metadata.where("v_extent_deg"));
    grid.cd = intensities(image.value, scale * distance * distance, path);
    check_and_order(grid, path, lamp.notes, [](std::size_t) { return std::size_t{0}; });
    if (image.was_coloured)
        lamp.notes.push_back("The picture is coloured: its luminance is taken.");
    if (image.pixel_type == "uint8")
        lamp.notes.push_back(fmt::format("8-bit pixels: steps of {:.3g} cd.", scale * distance * distance / 255.0));
    finish(grid, options, metadata.text("gaps_deg"), metadata.where("gaps_deg"), std::nullopt, lamp); // an even axis has no padding
    return lamp;
}

std::string beam_texture_bytes(const LampFile& lamp) {
    EvenAxis h = even_axis(lamp.table.h_deg), v = even_axis(lamp.table.v_deg);
    while (h.count * v.count > max_made_samples) {
        EvenAxis& longer = h.count > v.count ? h : v;
        const double range = longer.at(longer.count - 1) - longer.first_deg;
        longer.count = (longer.count + 1) / 2;
        longer.step_deg = range / static_cast<double>(longer.count - 1);
    }
    std::string labels;
    for (const auto& [key, value] : lamp.labels) {
        std::string line = fmt::format("{}: {}", key.substr(0, key.find(':')), value);
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        labels += line + "\n";
    }
    const auto pair = [](const Extent& extent) { return fmt::format("{} {}", extent.low_deg, extent.high_deg); };
    std::map<std::string, std::string> attributes{{"fernlicht:name", lamp.name},
                                                  {"fernlicht:scale_lx", "1"},
                                                  {"fernlicht:distance_m", fmt::format("{}", written_distance_m)},
                                                  {"fernlicht:h_extent_deg", pair(h.extent())},
                                                  {"fernlicht:v_extent_deg", pair(v.extent())},
                                                  {"fernlicht:gaps_deg", gaps_text(lamp.table)},
                                                  {"fernlicht:labels", labels}};
    if (lamp.declared_flux_lm && *lamp.declared_flux_lm > 0.0)
        attributes["fernlicht:flux_lm"] = fmt::format("{}", *lamp.declared_flux_lm);
    return encode_texture(rendered(lamp.table, h, v), "illuminance.lx", attributes);
}

} // namespace fernlicht
