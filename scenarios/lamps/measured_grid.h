// Intensities as a file lists them, on the file's own two axes, and how they become a well-formed table.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/errors.h"

#include <functional>

namespace fernlicht {

using Notes = std::vector<std::string>;

/// cd[v * h_deg.size() + h]; the axes in the file's order. `*_line` say where each axis begins in the file, for messages.
struct MeasuredGrid {
    std::vector<double> h_deg;
    std::vector<double> v_deg;
    std::vector<double> cd;
    std::size_t h_line = 0;
    std::size_t v_line = 0;
};

/// Negative intensities down to -0.1 % of the peak are a meter's noise about zero and become 0; below that they are an InputError.
/// So are intensities above max_intensity_cd: `line_of` gives the line of cd[index] in the file's order, 0 where there is none. Then brings
/// both axes into ascending order. Repeated angles with the same intensities are dropped; with others they are an InputError.
void check_and_order(MeasuredGrid& grid, const std::filesystem::path& file, Notes& notes,
                     const std::function<std::size_t(std::size_t)>& line_of);

/// Beyond, a wall is more than 57 times as far away as straight ahead.
inline constexpr double most_wall_deg = 89.0;

/// Throws InputError unless there are at least 2 angles, as of C planes in gamma when repeated ones are dropped.
void check_count(const std::vector<double>& angles, const char* name, std::size_t line, const std::filesystem::path& file);

/// Throws InputError unless each axis has at least 2 angles, within these bounds to both sides, degrees.
void check_angle_ranges(const MeasuredGrid& grid, double h_limit_deg, double v_limit_deg, const std::filesystem::path& file);

/// What a lux is worth in candela: I = E d^2 where the sensor faces the lamp; in a wall square to the axis, theta off it,
/// I = E (d / cos theta)^2 / cos theta. Angles as read off that wall, or of type A or B.
double cd_per_lux(double distance_m, bool planar, bool screen_angles, double h_deg, double v_deg);

/// Ends every reader but those of C planes: the lamp's table, with the gaps that `written` names (as gaps_text does; `where` it stands) or
/// else those of mark_padding, brought onto H and V from another `system`.
void finish(const MeasuredGrid& grid, const LampReadOptions& options, const std::string* written, const InputError::Where& where,
            std::optional<AngleSystem> system, LampFile& lamp);

/// Marks as gap the outermost rows and columns of cells that only pad the file: more than eight times as wide as their neighbour and
/// ending in zeros all along (a goniometer's range of -5..7 degrees, say, closed by zeros at -90 and 90). Light does not fade over such
/// a width: nothing was measured there. Eight, because real files close 5-degree steps at 45 degrees with zeros at 90.
void mark_padding(CandelaTable& table, Notes& notes);

/// How our writers keep a table's gaps: rectangles in degrees, as text, in whatever place a format has for texts.
inline constexpr const char* gaps_key = "_GAPS_DEG";

/// "none", or "h0 h1 v0 v1; h0 h1 v0 v1; ...": the cells between these angles have no data.
std::string gaps_text(const CandelaTable& table);

} // namespace fernlicht
