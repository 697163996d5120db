#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/level_track.h"
#include "scenarios/lamps/pixel_lamp.h"
#include "scenarios/values/picture_decoding.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace fernlicht {
namespace {

constexpr double latest_s = 1.0e6;

char separator_of(std::string_view line) {
    for (const char c : {';', '\t', ','})
        if (line.find(c) != std::string_view::npos)
            return c;
    return ' ';
}

float level_in(double value, const InputError::Where& where) {
    if (!(value >= 0.0 && value <= 1.0))
        throw InputError(where, fmt::format("found {}", value), "a level from 0 to 1");
    return static_cast<float>(value);
}

std::vector<float> levels_of_picture(const std::filesystem::path& picture, const PixelLamp& lamp, const InputError::Where& asked_by,
                                     FilesRead& opened) {
    if (std::error_code none; !std::filesystem::is_regular_file(picture, none))
        throw InputError(asked_by, fmt::format("there is no file {}", printable(picture.string(), 400)),
                         "a picture (relative paths start at this file's folder)");
    const std::string bytes = read_file(picture, opened, max_lamp_text_bytes);
    const TextureImage decoded = decode_texture(picture, bytes, max_made_samples, 1);
    const std::vector<std::string>& channels = decoded.channels;
    const bool colours = channels == std::vector<std::string>{"R", "G", "B"};
    if (!channels.empty() && !colours && (channels.size() != 1 || (channels[0] != "level" && channels[0] != "Y")))
        throw InputError({picture, 0, 0, {}}, fmt::format("found channels {}", printable(fmt::format("{}", fmt::join(channels, ", ")))),
                         "`level`, `Y`, or `R`, `G` and `B`");
    const Image<float>& image = decoded.value;
    const bool raster = !lamp.parts().raster.empty();
    const int columns = raster ? lamp.parts().raster.front().columns : static_cast<int>(lamp.count());
    const int rows = raster ? lamp.parts().raster.front().rows : 1;
    if (image.width() != columns || image.height() != rows)
        throw InputError({picture, 0, 0, {}}, fmt::format("found {} x {} pixels", image.width(), image.height()),
                         fmt::format("{} x {}, as the lamp has", columns, rows));
    std::vector<float> levels;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            levels.push_back(level_in(static_cast<double>(image.at(x, y)), {picture, 0, 0, fmt::format("pixel {}, {}", x, y)}));
    return levels;
}

/// Of a line after its time; `pictures`: it names one.
std::vector<float> levels_of_line(const std::vector<std::string_view>& cells, bool pictures, const PixelLamp& lamp,
                                  const InputError::Where& at, FilesRead& opened) {
    if (pictures) {
        if (cells.size() != 2)
            throw InputError(at, fmt::format("found {} cells", cells.size()), "2: a time and the name of a picture");
        return levels_of_picture((at.file.parent_path() / std::string(cells[1])).lexically_normal(), lamp, at, opened);
    }
    if (cells.size() != lamp.count() + 1)
        throw InputError(at, fmt::format("found {} cells", cells.size()),
                         fmt::format("{}: a time and a level for each pixel", lamp.count() + 1));
    std::vector<float> levels;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        InputError::Where where = at;
        where.key = fmt::format("column {}", i + 1);
        levels.push_back(level_in(finite_number(cells[i], where), where));
    }
    return levels;
}

} // namespace

std::shared_ptr<const LevelTrack> read_levels(const std::filesystem::path& path, const std::shared_ptr<const LampFile>& lamp,
                                              FilesRead& opened) {
    FilesRead own;
    const std::string text = lamp_text(read_file(path, own, max_lamp_text_bytes), path);
    const PixelLamp& pixels = *lamp->pixels;
    auto track = std::make_shared<LevelTrack>(lamp);
    std::optional<char> separator;
    std::optional<bool> pictures; // unknown before the first line
    double last_s = -1.0;
    LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
        if (trimmed(line).empty() || trimmed(line).starts_with('#'))
            continue;
        if (!separator)
            separator = separator_of(line);
        const std::vector<std::string_view> cells = cells_of(line, *separator);
        InputError::Where at{path, lines.number(), 0, {}};
        if (!pictures && !cells.empty() && uppercase(cells[0]) == "TIME_S") {
            pictures = cells.size() == 2 && uppercase(cells[1]) == "PICTURE";
            if (cells.size() == 2 && !*pictures && pixels.count() != 1)
                throw InputError(at, fmt::format("found a column '{}'", printable(std::string(cells[1]))),
                                 fmt::format("`picture`, or a level for each of {} pixels", pixels.count()));
            continue;
        }
        if (!pictures)
            pictures = cells.size() == 2 && !number_in(cells[1]);
        InputError::Where time_at = at;
        time_at.key = "time_s";
        const double time_s = finite_number(cells.empty() ? std::string_view{} : cells[0], time_at);
        if (!(time_s >= 0.0 && time_s <= latest_s && time_s > last_s))
            throw InputError(time_at, fmt::format("found {}", time_s),
                             last_s < 0.0 ? std::string("a time from 0 on, s") : fmt::format("a time after {} s", last_s));
        last_s = time_s;
        track->ask(time_s, levels_of_line(cells, *pictures, pixels, at, own), at);
    }
    if (track->changes() == 0)
        throw InputError({path, 0, 0, {}}, "holds no levels", "lines of a time and levels");
    opened.insert(opened.end(), own.begin(), own.end());
    track->came_from(std::move(own));
    return track;
}

std::optional<ShownLevels> read_shown_levels(const std::filesystem::path& path, const PixelLamp& lamp, const std::string& name,
                                             double time_s, FilesRead& opened) {
    FilesRead own;
    const std::string text = lamp_text(read_file(path, own, max_lamp_text_bytes), path);
    LineReader lines(text);
    std::string_view line;
    if (!lines.next(line) || !line.starts_with("time_s,lamp,level,"))
        return std::nullopt;
    const std::vector<std::string_view> head = cells_of(line, ',');
    const auto first = static_cast<std::size_t>(std::ranges::find(head, "level_1") - head.begin());
    std::set<std::string> lamps; // before any row is judged: it may be another lamp's
    LineReader named = lines;
    while (named.next(line)) {
        if (trimmed(line).empty())
            continue;
        const std::vector<std::string_view> cells = cells_of(line, ',');
        if (cells.size() < 7)
            throw InputError({path, named.number(), 0, {}}, fmt::format("found {} cells", cells.size()), "a line of a run's levels");
        lamps.emplace(cells[1]);
    }
    const std::string all = fmt::format("{}", fmt::join(lamps, ", "));
    if (name.empty() ? lamps.size() > 1 : !lamps.contains(name))
        throw InputError({path, 0, 0, "--levels-lamp"},
                         name.empty() ? fmt::format("levels of {}", printable(all, 200))
                                      : fmt::format("no levels of '{}'", printable(name)),
                         name.empty() ? "--levels-lamp with one of them" : "one of " + printable(all, 200));
    std::optional<ShownLevels> shown;
    double first_s = latest_s;
    while (lines.next(line)) {
        if (trimmed(line).empty())
            continue;
        const std::vector<std::string_view> cells = cells_of(line, ',');
        const InputError::Where at{path, lines.number(), 0, {}};
        const std::string of(cells[1]);
        const double at_s = finite_number(cells[0], at);
        if ((!name.empty() && of != name) || at_s > time_s) {
            first_s = std::min(first_s, at_s);
            continue;
        }
        const std::size_t told = cells.size() > first ? cells.size() - first : 0;
        const auto has = static_cast<std::size_t>(whole_number(cells[4], 1, 1'000'000'000, at));
        if (has != lamp.count() || told < lamp.count())
            throw InputError(at, fmt::format("found {} of {} levels", std::min(told, has), has),
                             has == lamp.count() ? "a level of each: a run writes those of lamps with at most 100"
                                                 : fmt::format("{}, as the lamp has", lamp.count()));
        shown.emplace(ShownLevels{static_cast<double>(level_in(finite_number(cells[2], at), at)), {}});
        for (std::size_t i = 0; i < lamp.count(); ++i)
            shown->pixels.push_back(level_in(finite_number(cells[first + i], at), at));
    }
    if (!shown)
        throw InputError({path, 0, 0, {}}, fmt::format("no levels at {:g} s or before", time_s),
                         fmt::format("a time from {:g} s on", first_s));
    opened.insert(opened.end(), own.begin(), own.end());
    return shown;
}

} // namespace fernlicht
