#include "scenarios/lamps/beam_files.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/lamp_text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct MatrixHeader {
    bool lux = false, flat_angles = false, planar = false;
    bool unit_given = false;
    double distance_m = 25.0;
    std::optional<std::string> gaps;
    std::size_t gaps_line = 0;
};

/// The key of `# key: value` when it is one lower-case word; "" for comments.
std::string_view key_of(std::string_view line) {
    line = trimmed(line.substr(std::min(line.find_first_not_of('#'), line.size())));
    const std::size_t colon = line.find(':');
    const std::string_view key = trimmed(line.substr(0, colon));
    const bool word = std::all_of(key.begin(), key.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
    return colon != std::string_view::npos && word ? key : std::string_view{};
}

bool one_of_two(std::string_view value, const char* no, const char* yes, const InputError::Where& where) {
    if (value == no || value == yes)
        return value == yes;
    throw InputError(where, fmt::format("found '{}'", printable(std::string(value.substr(0, 200)))), fmt::format("{} or {}", no, yes));
}

void take_header_line(std::string_view line, const InputError::Where& at, MatrixHeader& header, LampFile& lamp) {
    const std::string_view value = line.find(':') == std::string_view::npos ? std::string_view{} : trimmed(line.substr(line.find(':') + 1));
    const std::string_view body = trimmed(line.substr(std::min(line.find_first_not_of('#'), line.size())));
    if (body.starts_with("label ") && body.find(':') != std::string_view::npos) {
        if (lamp.labels.size() >= max_lamp_labels)
            throw InputError(at, "the labels go on", fmt::format("at most {}", max_lamp_labels));
        lamp.labels.emplace_back(trimmed(body.substr(6, body.find(':') - 6)), value);
        return;
    }
    const std::string_view key = body.empty() ? std::string_view{} : key_of(body);
    if (key.empty())
        return;
    InputError::Where where = at;
    where.key = key;
    if (key == "unit") {
        header.lux = one_of_two(value, "cd", "lx", where);
        header.unit_given = true;
    } else if (key == "distance_m") {
        header.distance_m = number_above_zero(value, where);
    } else if (key == "angles") {
        header.flat_angles = one_of_two(value, "goniometer", "screen", where);
    } else if (key == "screen") {
        header.planar = one_of_two(value, "spherical", "planar", where);
    } else if (key == "name") {
        lamp.name = value;
    } else if (key == "flux_lm") {
        lamp.declared_flux_lm = number_above_zero(value, where);
    } else if (key == "gaps_deg") {
        header.gaps = value;
        header.gaps_line = at.line;
    } else {
        const std::array known{"unit", "distance_m", "angles", "screen", "name", "flux_lm", "gaps_deg"};
        const std::string nearest = nearest_name(std::string(key.substr(0, 40)), known);
        throw InputError(where, "is no key of a beam matrix", nearest.empty() ? "one of unit, distance_m, angles, screen" : nearest);
    }
}

class Cells {
  public:
    explicit Cells(std::string_view first_line) {
        for (const char c : {',', '\t', ';'}) // the last that there is
            separator_ = first_line.find(c) != std::string_view::npos ? c : separator_;
    }

    std::vector<std::string_view> of(std::string_view line) const { return cells_of(line, separator_); }
    double number(std::string_view cell, const InputError::Where& where) const {
        if (separator_ == ',' || cell.find(',') == std::string_view::npos)
            return finite_number(cell, where);
        std::string copy(cell.substr(0, 100));
        std::replace(copy.begin(), copy.end(), ',', '.');
        return finite_number(copy, where);
    }

  private:
    char separator_ = ' ';
};

void take_first_row(std::string_view line, const Cells& cells, const InputError::Where& at, MeasuredGrid& grid) {
    const std::vector<std::string_view> row = cells.of(line);
    grid.h_line = at.line;
    InputError::Where where = at;
    where.key = "horizontal angle";
    for (std::size_t i = 1; i < row.size(); ++i)
        grid.h_deg.push_back(cells.number(row[i], where));
}

void take_row(std::string_view line, const Cells& cells, const InputError::Where& at, MeasuredGrid& grid) {
    const std::vector<std::string_view> row = cells.of(line);
    InputError::Where where = at;
    if (row.size() != grid.h_deg.size() + 1)
        throw InputError(where, fmt::format("found {} cells", row.size()),
                         fmt::format("{}: a vertical angle and one per horizontal angle{}", grid.h_deg.size() + 1,
                                     row.size() > grid.h_deg.size() ? "; where numbers have decimal commas, semicolons separate" : ""));
    if (grid.cd.size() + grid.h_deg.size() > max_lamp_samples)
        throw InputError(where, "the matrix goes on", fmt::format("at most {} cells", max_lamp_samples));
    where.key = "vertical angle";
    grid.v_deg.push_back(cells.number(row[0], where));
    for (std::size_t i = 1; i < row.size(); ++i) {
        where.key = fmt::format("column {}", i + 1);
        grid.cd.push_back(cells.number(row[i], where));
    }
}

void check_angles(const MeasuredGrid& grid, const MatrixHeader& header, const std::filesystem::path& path) {
    const bool wall = header.flat_angles || (header.lux && header.planar);
    check_angle_ranges(grid, wall ? most_wall_deg : 180.0, wall ? most_wall_deg : 90.0, path);
}

/// `row_lines` gets the line of each row.
MeasuredGrid read_matrix(const std::filesystem::path& path, std::string_view text, MatrixHeader& header, LampFile& lamp,
                         std::vector<std::size_t>& row_lines) {
    MeasuredGrid grid;
    LineReader lines(text);
    std::string_view line;
    std::optional<Cells> cells;
    while (lines.next(line)) {
        const InputError::Where at{path, lines.number(), 0, {}};
        if (trimmed(line).empty())
            continue;
        if (trimmed(line).starts_with('#')) {
            take_header_line(trimmed(line), at, header, lamp);
            continue;
        }
        if (!header.unit_given)
            throw InputError({path, lines.number(), 0, "unit"}, "is not given before the numbers",
                             "a line '# unit: lx' or '# unit: cd'; other text grids need a recipe");
        try {
            if (cells) {
                take_row(line, *cells, at, grid);
                row_lines.push_back(lines.number());
            } else {
                cells.emplace(line);
                take_first_row(line, *cells, at, grid);
            }
        } catch (const InputError&) {
            refuse_decimal_commas(line, lines.number() - 1, path); // a comma in the first row separates
            throw;
        }
    }
    if (!cells || grid.v_deg.empty())
        throw InputError({path, lines.number(), 0, {}}, "the file ends before the matrix", "horizontal angles, then rows");
    grid.v_line = row_lines.front();
    return grid;
}

} // namespace

bool looks_like_beam_matrix(std::string_view text) {
    LineReader lines(text);
    std::string_view line;
    for (std::size_t seen = 0; seen < 2000 && lines.next(line); ++seen) {
        line = trimmed(line);
        if (!line.empty() && !line.starts_with('#'))
            return false;
        if (line.find_first_not_of('#') != std::string_view::npos && key_of(line) == "unit")
            return true;
    }
    return false;
}

LampFile read_beam_matrix(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened) {
    LampFile lamp{.name = path.stem().string(), .format = "beam matrix", .opened = std::move(opened)};
    MatrixHeader header;
    std::vector<std::size_t> row_lines;
    MeasuredGrid grid = read_matrix(path, text, header, lamp, row_lines);
    check_angles(grid, header, path);
    if (header.lux)
        for (std::size_t v = 0; v < grid.v_deg.size(); ++v)
            for (std::size_t h = 0; h < grid.h_deg.size(); ++h)
                grid.cd[v * grid.h_deg.size() + h] *=
                    cd_per_lux(header.distance_m, header.planar, header.flat_angles, grid.h_deg[h], grid.v_deg[v]);
    check_and_order(grid, path, lamp.notes, [&](std::size_t at) { return row_lines[at / grid.h_deg.size()]; });
    check_angles(grid, header, path); // repeated angles may have left a single one
    finish(grid, options, header.gaps ? &*header.gaps : nullptr, {path, header.gaps_line, 0, "gaps_deg"},
           header.flat_angles ? std::optional(flat_screen()) : std::nullopt, lamp);
    return lamp;
}

std::string beam_matrix_text(const LampFile& lamp) {
    const CandelaTable& table = lamp.table;
    std::string out = "# unit: cd\n# angles: goniometer\n";
    out += fmt::format("# name: {}\n# gaps_deg: {}\n", on_one_line(lamp.name), gaps_text(table));
    if (lamp.declared_flux_lm && *lamp.declared_flux_lm > 0.0)
        out += fmt::format("# flux_lm: {}\n", *lamp.declared_flux_lm);
    for (const auto& [key, value] : lamp.labels) {
        std::string clean = on_one_line(key);
        std::replace(clean.begin(), clean.end(), ':', ' ');
        out += fmt::format("# label {}: {}\n", clean, on_one_line(value));
    }
    out += "V\\H";
    for (const double h : table.h_deg)
        out += fmt::format(",{}", h);
    out += '\n';
    for (std::size_t v = 0; v < table.v_deg.size(); ++v) {
        out += fmt::format("{}", table.v_deg[v]);
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            out += fmt::format(",{}", table.at(v, h));
        out += '\n';
    }
    return out;
}

} // namespace fernlicht
