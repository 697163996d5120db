#include "runner/experiments/fit/lux_points.h"

#include "runner/files/csv_file.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr std::size_t most_readings = 20'000;
constexpr double readings_within_m = 1000.0, brightest_lx = 1.0e6;

/// Spreadsheets leave lines of nothing but commas at the end.
std::string_view without_empty_end(std::string_view text) {
    for (std::size_t end = text.size(); end != std::string_view::npos;) {
        end = text.find_last_of('\n', end == 0 ? 0 : end - 1);
        if (text.substr(end == std::string_view::npos ? 0 : end + 1).find_first_not_of(" \t\r\n,") != std::string_view::npos)
            break;
        text = text.substr(0, end == std::string_view::npos ? 0 : end);
    }
    return text;
}

/// Spreadsheets of many countries part columns by semicolons; then decimals may stand behind commas, too.
void refuse_semicolons(std::string_view text, const std::filesystem::path& path) {
    const std::string_view first = text.substr(0, text.find('\n'));
    if (std::ranges::count(first, ';') > std::ranges::count(first, ',') || std::ranges::count(first, '\t') > std::ranges::count(first, ','))
        throw InputError({path, 1, 0, {}}, fmt::format("found '{}'", printable(std::string(trimmed(first)))),
                         "columns separated by commas, not by semicolons or tabs, and a point before decimals");
}

class PointFile {
  public:
    explicit PointFile(CsvFile csv) : csv_(std::move(csv)) {
        for (std::string& head : csv_.heads)
            head = std::string(trimmed(head));
        for (auto head = csv_.heads.begin(); head != csv_.heads.end(); ++head)
            check_head(*head, head - csv_.heads.begin());
        for (const std::string_view needed : {"ahead_m", "left_m", "above_m", "lux"})
            if (!has(needed))
                refuse_head(fmt::format("has no column '{}'", needed), fmt::format("{} in every file", "ahead_m, left_m, above_m and lux"));
        if (!has("uncertainty_percent") && !has("uncertainty_lx"))
            refuse_head("has neither 'uncertainty_percent' nor 'uncertainty_lx'", "one of them: how well each reading is known");
        if (!has("facing") && !has("normal_ahead"))
            refuse_head("has neither 'facing' nor 'normal_ahead', 'normal_left' and 'normal_up'", "where the luxmeter looked");
        if (has("normal_ahead") + has("normal_left") + has("normal_up") == 1 ||
            has("normal_ahead") + has("normal_left") + has("normal_up") == 2)
            refuse_head("has a part of a direction", "normal_ahead, normal_left and normal_up together");
        if (csv_.rows.size() > most_readings)
            throw InputError({csv_.file, 0, 0, {}}, fmt::format("has {} readings", csv_.rows.size()),
                             fmt::format("at most {}", most_readings));
    }

    std::vector<LuxReading> readings() const {
        std::vector<LuxReading> readings;
        for (std::size_t row = 0; row < csv_.rows.size(); ++row)
            readings.push_back(reading(row));
        if (readings.empty())
            throw InputError({csv_.file, 0, 0, {}}, "has no readings", "a line for each under the names of the columns");
        return readings;
    }

  private:
    [[noreturn]] void refuse_head(const std::string& found, const std::string& expected) const {
        throw InputError({csv_.file, 1, 0, {}}, found, expected);
    }

    void check_head(const std::string& head, std::ptrdiff_t before) const {
        std::vector<std::string_view> known;
        for (const auto& [name, meaning] : lux_point_columns())
            known.push_back(name);
        if (std::ranges::find(known, head) == known.end()) {
            const std::string nearest = nearest_name(head, known);
            throw InputError({csv_.file, 1, static_cast<std::size_t>(before) + 1, {}}, "found column '" + printable(head) + "'",
                             nearest.empty() ? fmt::format("{}", fmt::join(known, ", ")) : nearest);
        }
        if (std::find(csv_.heads.begin(), csv_.heads.begin() + before, head) != csv_.heads.begin() + before)
            refuse_head("found column '" + head + "' twice", "each column once");
    }

    bool has(std::string_view head) const { return std::ranges::find(csv_.heads, head) != csv_.heads.end(); }
    std::string text(std::size_t row, std::string_view head) const {
        return has(head) ? std::string(trimmed(csv_.rows[row][csv_.column(head)])) : std::string();
    }
    bool given(std::size_t row, std::string_view head) const { return !text(row, head).empty(); }
    [[noreturn]] void refuse(std::size_t row, std::string_view head, const std::string& expected) const {
        csv_.refuse(row, csv_.column(head), expected);
    }

    /// 0 where there is none and `needed` does not ask for it.
    double number(std::size_t row, std::string_view head, double least, double most, bool needed = false) const {
        if (!needed && !given(row, head))
            return 0.0;
        const std::optional<double> value = number_in(text(row, head));
        if (!value || !(*value >= least && *value <= most))
            refuse(row, head, fmt::format("a number from {:g} to {:g}", least, most));
        return *value;
    }

    std::string facing(std::size_t row) const {
        std::string word = text(row, "facing");
        if (!given(row, "normal_ahead") && !given(row, "normal_left") && !given(row, "normal_up")) {
            if (word != "lamp" && word != "car" && word != "up")
                refuse(row, has("facing") ? "facing" : "normal_ahead", has("facing") ? "lamp, car or up" : "a direction");
            return word;
        }
        if (!word.empty())
            refuse(row, "facing", "nothing beside a direction in normal_ahead, normal_left and normal_up");
        const glm::dvec3 normal{number(row, "normal_ahead", -readings_within_m, readings_within_m),
                                number(row, "normal_left", -readings_within_m, readings_within_m),
                                number(row, "normal_up", -readings_within_m, readings_within_m)};
        if (!(glm::length(normal) > 1e-6))
            refuse(row, "normal_ahead", "a direction: one of its three parts is not 0");
        const glm::dvec3 unit = glm::normalize(normal);
        return fmt::format("normal {} {} {}", unit.x, unit.y, unit.z);
    }

    LuxReading reading(std::size_t row) const {
        LuxReading r;
        r.line = row + 2;
        r.name = text(row, "name");
        r.time_s = number(row, "time_s", 0.0, 1.0e6);
        r.ahead_m = number(row, "ahead_m", -readings_within_m, readings_within_m, true);
        r.left_m = number(row, "left_m", -readings_within_m, readings_within_m, true);
        r.above_m = number(row, "above_m", -readings_within_m, readings_within_m, true);
        r.facing = facing(row);
        r.lamps = text(row, "lamps");
        r.lux = number(row, "lux", 0.0, brightest_lx, true);
        r.uncertainty_percent = number(row, "uncertainty_percent", 0.0, 1000.0);
        r.uncertainty_lx = number(row, "uncertainty_lx", 0.0, brightest_lx);
        r.place_uncertainty_m = number(row, "place_uncertainty_m", 0.0, 10.0);
        if (!(r.uncertainty_percent * r.lux > 0.0 || r.uncertainty_lx > 0.0)) {
            const bool percent_alone = r.uncertainty_percent > 0.0;
            refuse(row, has("uncertainty_lx") && (percent_alone || !has("uncertainty_percent")) ? "uncertainty_lx" : "uncertainty_percent",
                   percent_alone ? "an uncertainty_lx above 0 beside it: a share of 0 lx is none" : "an uncertainty above 0");
        }
        return r;
    }

    CsvFile csv_;
};

} // namespace

const std::vector<std::pair<std::string_view, std::string_view>>& lux_point_columns() {
    static const std::vector<std::pair<std::string_view, std::string_view>> columns{
        {"name", "of the point, for people"},
        {"time_s", "of the drive, at which the car stood so (default 0)"},
        {"ahead_m", "of the front bumper"},
        {"left_m", "of the car's middle; right: negative"},
        {"above_m", "of the road under the car's wheels"},
        {"facing", "where the luxmeter looked: car (level, straight back along the car), up, or lamp (at the lamp; of several, at each)"},
        {"normal_ahead", "instead: the direction it looked in, ahead ..."},
        {"normal_left", "... to the left ..."},
        {"normal_up", "... and up, of any length"},
        {"lamps", "that were lit, left+right; empty: all that the drive has on"},
        {"lux", "of these lamps alone: less what was read with the lamps off"},
        {"uncertainty_percent", "standard uncertainty (k = 1) as a share of the reading"},
        {"uncertainty_lx", "standard uncertainty in lux; both add in quadrature"},
        {"place_uncertainty_m", "standard uncertainty of the place, in each direction (default 0)"},
    };
    return columns;
}

std::optional<glm::dvec3> normal_of(const LuxReading& reading) {
    if (reading.facing == "car")
        return glm::dvec3(-1.0, 0.0, 0.0);
    if (reading.facing == "up")
        return glm::dvec3(0.0, 0.0, 1.0);
    if (reading.facing == "lamp")
        return std::nullopt;
    const auto words = words_of(reading.facing);
    return glm::dvec3(number_in(words.at(1)).value(), number_in(words.at(2)).value(), number_in(words.at(3)).value());
}

std::vector<std::string> lamps_named(const LuxReading& reading) {
    std::vector<std::string> names;
    for (const std::string_view name : words_of(reading.lamps, "+"))
        names.emplace_back(trimmed(name));
    return names;
}

std::vector<LuxReading> read_lux_points(const std::filesystem::path& path, FilesRead& opened) {
    const std::string text = lamp_text(read_file(path, opened), path);
    refuse_semicolons(text, path);
    return PointFile(csv_in(without_empty_end(text), path)).readings();
}

} // namespace fernlicht
