#include "scenarios/lamps/eulumdat.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/lamp_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// A number with a point or a decimal comma.
std::optional<double> either_decimal(std::string_view text) {
    std::string copy(trimmed(text.substr(0, 100)));
    std::replace(copy.begin(), copy.end(), ',', '.');
    return number_in(copy);
}

class LdtLines {
  public:
    LdtLines(const std::filesystem::path& path, std::string_view text) : path_(path), lines_(text) {}

    std::string_view text(const char* name) {
        std::string_view line;
        if (!lines_.next(line))
            throw InputError({path_, lines_.number(), 0, name}, "the file ends before it", "one line");
        return trimmed(line);
    }
    double number(const char* name) { return number_in_line(text(name), name); }
    double number_in_line(std::string_view line, const char* name) const {
        const std::optional<double> value = either_decimal(line);
        if (!value || !std::isfinite(*value))
            throw InputError(where(name), fmt::format("found '{}'", printable(std::string(line.substr(0, 200)))), "a finite number");
        return *value;
    }
    long whole(const char* name, long least, long most) {
        const double value = number(name);
        if (value != std::floor(value) || value < static_cast<double>(least) || value > static_cast<double>(most))
            throw InputError(where(name), fmt::format("found {}", value), fmt::format("a whole number from {} to {}", least, most));
        return static_cast<long>(value);
    }
    std::vector<double> numbers(const char* name, std::size_t count) {
        std::vector<double> out; // grows with what is there, not with what the header promises
        for (std::size_t i = 0; i < count; ++i)
            out.push_back(number(name));
        return out;
    }
    std::size_t next_number() const { return lines_.number() + 1; }
    InputError::Where where(const char* name) const { return {path_, lines_.number(), 0, name}; }

  private:
    const std::filesystem::path& path_;
    LineReader lines_;
};

struct FirstSet {
    double flux_lm = 0.0;
    std::string type;
};

FirstSet first_lamp_set(LdtLines& in, Notes& notes) {
    const auto count = static_cast<std::size_t>(in.whole("number of lamp sets", 1, 20));
    InputError::Where where = in.where("lamp sets");
    ++where.line;
    std::vector<std::string_view> lines; // six of each set: number of lamps, type, flux, colour, colour rendering, watts
    for (std::size_t i = 0; i < 6 * count; ++i)
        lines.push_back(in.text("lamp sets"));
    const auto reads = [&](std::size_t set_step, std::size_t field_step) {
        for (std::size_t set = 0; set < count; ++set) {
            const std::optional<double> lamps = either_decimal(lines[set * set_step]);
            if (!lamps || *lamps != std::floor(*lamps) || !either_decimal(lines[set * set_step + 2 * field_step]))
                return false;
        }
        return true;
    };
    const bool by_set = reads(6, 1), by_field = !by_set && reads(1, count);
    if (!by_set && !by_field)
        throw InputError(where,
                         fmt::format("found '{}' lamps of '{}' lm in the first of {} sets", printable(std::string(lines[0])),
                                     printable(std::string(lines[2])), count),
                         "numbers");
    if (by_field)
        notes.push_back("The lamp sets are listed field by field, not set by set.");
    const std::size_t step = by_set ? 1 : count;
    FirstSet set;
    set.type = lines[step];
    set.flux_lm = *either_decimal(lines[2 * step]);
    if (!(std::isfinite(set.flux_lm) && set.flux_lm > 0.0))
        throw InputError(where, fmt::format("found a lamp flux of {} lm", set.flux_lm), "a flux above 0");
    if (*either_decimal(lines[0]) < 0.0)
        notes.push_back("The number of lamps is negative: absolute photometry.");
    if (count > 1)
        notes.push_back(fmt::format("{} lamp sets to choose from: the first, '{}' with {} lm, is taken.", count, set.type, set.flux_lm));
    return set;
}

struct Layout {
    long symmetry = 0;
    std::size_t planes = 0, gammas = 0;

    std::size_t stored() const { return symmetry == 0 ? planes : symmetry == 1 ? 1 : symmetry == 4 ? planes / 4 + 1 : planes / 2 + 1; }
    std::size_t first() const { return symmetry == 3 ? 3 * planes / 4 : 0; }
    PlaneSymmetry plane_symmetry() const {
        static constexpr PlaneSymmetry meaning[5] = {PlaneSymmetry::none, PlaneSymmetry::rotational, PlaneSymmetry::about_c0_c180,
                                                     PlaneSymmetry::about_c90_c270, PlaneSymmetry::quadrants};
        return planes == 1 ? PlaneSymmetry::rotational : meaning[symmetry];
    }
};

Layout read_layout(LdtLines& in, Notes& notes) {
    Layout layout;
    layout.symmetry = in.whole("symmetry (Isym)", 0, 4);
    layout.planes = static_cast<std::size_t>(in.whole("number of C planes (Mc)", 1, static_cast<long>(max_lamp_samples)));
    const std::size_t unit = layout.symmetry == 2 ? 2 : layout.symmetry >= 3 ? 4 : 1;
    if (layout.planes % unit != 0)
        throw InputError(in.where("number of C planes (Mc)"), fmt::format("found {}", layout.planes),
                         fmt::format("a multiple of {} for symmetry {}", unit, layout.symmetry));
    in.text("step of the C planes (Dc)"); // the angles are listed
    layout.gammas = static_cast<std::size_t>(in.whole("number of gamma angles (Ng)", 2, static_cast<long>(max_lamp_samples)));
    if (layout.planes * layout.gammas > max_lamp_samples)
        throw InputError(in.where("number of gamma angles (Ng)"), fmt::format("found {} x {}", layout.planes, layout.gammas),
                         fmt::format("at most {} intensities", max_lamp_samples));
    in.text("step of the gamma angles (Dg)");
    if (layout.planes == 1 && layout.symmetry != 1)
        notes.push_back(fmt::format("Symmetry {} with a single plane: taken as rotational.", layout.symmetry));
    return layout;
}

void check_angles(const std::vector<double>& angles, double least, double most, std::size_t first_line, const char* name,
                  const std::filesystem::path& path) {
    for (std::size_t i = 0; i < angles.size(); ++i)
        if (angles[i] < least || angles[i] > most)
            throw InputError({path, first_line + i, 0, name}, fmt::format("found {}", angles[i]),
                             fmt::format("an angle from {} to {}", least, most));
}

/// C angles, gamma angles, then plane by plane.
MeasuredGrid read_planes(LdtLines& in, const Layout& layout, double cd_per_value, const std::filesystem::path& path) {
    MeasuredGrid grid;
    grid.h_line = in.next_number();
    const std::vector<double> c = in.numbers("C angle", layout.planes);
    check_angles(c, -360.0, 360.0, grid.h_line, "C angle", path);
    grid.v_line = in.next_number();
    grid.v_deg = in.numbers("gamma angle", layout.gammas);
    check_angles(grid.v_deg, 0.0, 180.0, grid.v_line, "gamma angle", path);
    const std::size_t stored = layout.stored();
    for (std::size_t i = 0; i < stored; ++i)
        grid.h_deg.push_back(c[(layout.first() + i) % layout.planes]);
    // C 270..345, 0..90 in ascending order: -90..-15, 0..90.
    if (layout.symmetry == 3)
        for (double& angle : grid.h_deg)
            angle = angle > 180.0 ? angle - 360.0 : angle;
    std::vector<double> values;
    for (std::size_t i = 0; i < stored * layout.gammas; ++i) {
        const std::string_view line = in.text("intensity"); // whose end is no value's fault
        values.push_back(intensity_of([&] { return in.number_in_line(line, "intensity"); }));
    }
    grid.cd.resize(values.size());
    for (std::size_t p = 0; p < stored; ++p)
        for (std::size_t g = 0; g < layout.gammas; ++g)
            grid.cd[g * stored + p] = values[p * layout.gammas + g] * cd_per_value;
    return grid;
}

} // namespace

bool looks_like_eulumdat(std::string_view text) {
    LineReader lines(text);
    std::string_view line;
    const auto whole_up_to = [&](double most) {
        const bool there = lines.next(line);
        const std::optional<double> value = there ? either_decimal(line) : std::nullopt;
        return value && *value == std::floor(*value) && *value >= 0.0 && *value <= most;
    };
    return lines.next(line) && whole_up_to(3.0) && whole_up_to(4.0) && whole_up_to(1e6) && lines.next(line) && whole_up_to(1e6);
}

LampFile read_eulumdat(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened) {
    LampFile lamp{.name = path.stem().string(), .opened = std::move(opened)};
    LdtLines in(path, text);
    const auto label = [&](const char* name) { lamp.labels.emplace_back(name, in.text(name)); };
    label("company");
    in.whole("type (Ityp)", 0, 3);
    const Layout layout = read_layout(in, lamp.notes);
    for (const char* name : {"report", "luminaire", "number", "file", "date"})
        label(name);
    for (int i = 0; i < 9; ++i)
        in.text("dimensions");
    in.text("downward flux fraction");
    const double output_percent = in.number("light output ratio");
    double conversion = in.number("conversion factor");
    in.text("tilt");
    const FirstSet lamps = first_lamp_set(in, lamp.notes);
    for (int i = 0; i < 10; ++i)
        in.text("direct ratios");
    if (conversion <= 0.0) {
        lamp.notes.push_back(fmt::format("The conversion factor is {}: taken as 1.", conversion));
        conversion = 1.0;
    } else if (conversion != 1.0) {
        lamp.notes.push_back(fmt::format("The intensities are multiplied by the conversion factor {}.", conversion));
    }
    MeasuredGrid grid = read_planes(in, layout, lamps.flux_lm / 1000.0 * conversion, path);
    const std::size_t planes = grid.h_deg.size(), first_line = in.next_number() - grid.cd.size(); // a value a line, plane by plane
    check_and_order(grid, path, lamp.notes, [&](std::size_t at) { return first_line + at % planes * grid.v_deg.size() + at / planes; });
    check_count(grid.v_deg, "gamma angles", grid.v_line, path);
    lamp.format = fmt::format("EULUMDAT, Isym {}", layout.symmetry);
    for (const std::size_t i : {std::size_t{3}, std::size_t{2}}) // number, then luminaire
        if (!lamp.labels[i].second.empty())
            lamp.name = lamp.labels[i].second;
    if (output_percent > 0.0)
        lamp.declared_flux_lm = lamps.flux_lm * output_percent / 100.0;
    from_c_planes(grid, layout.plane_symmetry(), options, lamp);
    return lamp;
}

} // namespace fernlicht
