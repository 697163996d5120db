#include "scenarios/lamps/ies.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/lamp_text.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <system_error>

namespace fernlicht {
namespace {

/// The year that ends the header, two or four digits; 0: none.
int year_at_end(std::string_view header) {
    const std::size_t end = header.find_last_of("0123456789");
    if (end == std::string_view::npos)
        return 0;
    const std::size_t before = header.substr(0, end + 1).find_last_not_of("0123456789");
    const std::string_view digits = header.substr(before + 1, end - before);
    int year = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), year);
    if (digits.size() == 2)
        return year < 50 ? 2000 + year : 1900 + year;
    return digits.size() == 4 ? year : 0;
}

/// What stands before the numbers of an LM-63 file.
struct IesHeader {
    int edition = 1986; ///< 1986, 1991, 1995, 2002 or 2019
    std::string tilt;   ///< "NONE", "INCLUDE" or a file name
    std::size_t tilt_line = 0;
    std::vector<std::pair<std::string, std::string>> labels;
};

void add_keyword(std::string_view line, IesHeader& header) {
    const std::size_t close = line.find(']');
    if (!line.starts_with('[') || close == std::string_view::npos) {
        header.labels.emplace_back("text", line);
        return;
    }
    const std::string key = uppercase(trimmed(line.substr(1, close - 1)));
    const std::string_view value = trimmed(line.substr(close + 1));
    if (key == "MORE" && !header.labels.empty())
        header.labels.back().second += fmt::format("{}{}", header.labels.back().second.empty() ? "" : " ", value);
    else
        header.labels.emplace_back(key, value);
}

/// The edition that a header line names ("IESNA91", "IESNA: LM-63-1995", "IES:LM-63-2019"); nullopt: not a header line.
/// An LM-63 line without a year that we know counts as the last edition not after it, with a note.
std::optional<int> ies_edition(std::string_view line, Notes& notes) {
    std::string header = uppercase(line.substr(0, 200));
    std::erase_if(header, [](char c) { return c == ' ' || c == '\t'; });
    const bool names_lm63 = header.find("LM-63") != std::string::npos || header.find("LM63") != std::string::npos;
    if (!header.starts_with("IES") || !(names_lm63 || header.starts_with("IESNA")))
        return std::nullopt;
    const int year = year_at_end(header); // 1963 for a header that ends with LM-63
    for (const int edition : {2019, 2002, 1995, 1991, 1986})
        if (year >= edition) {
            if (year != edition)
                notes.push_back(fmt::format("The header names an edition of {}, which we do not know: read as LM-63-{}.", year, edition));
            return edition;
        }
    notes.push_back("The header names no edition that we know: read as LM-63-2002.");
    return 2002;
}

/// Is this `TILT = ...`? Then what follows the equals sign.
std::optional<std::string_view> tilt_of(std::string_view line) {
    line = trimmed(line);
    if (uppercase(line.substr(0, 4)) != "TILT")
        return std::nullopt;
    line = trimmed(line.substr(4));
    if (!line.starts_with('='))
        return std::nullopt;
    return trimmed(line.substr(1));
}

/// Reads up to and including the TILT line. Throws InputError when there is none.
IesHeader read_ies_header(LineReader& lines, const std::filesystem::path& path, Notes& notes) {
    IesHeader header;
    bool seen_first = false;
    std::string_view line;
    while (lines.next(line)) {
        line = trimmed(line);
        if (const auto tilt = tilt_of(line)) {
            const std::string upper = uppercase(*tilt);
            header.tilt = upper == "NONE" || upper == "INCLUDE" ? upper : std::string(*tilt);
            header.tilt_line = lines.number();
            return header;
        }
        if (line.empty())
            continue;
        const auto edition = seen_first ? std::nullopt : ies_edition(line, notes);
        seen_first = true;
        if (header.labels.size() >= max_lamp_labels)
            throw InputError({path, lines.number(), 0, "TILT"}, fmt::format("does not come within {} lines of text", max_lamp_labels),
                             "a line TILT=NONE, TILT=INCLUDE or TILT=<file>");
        if (edition)
            header.edition = *edition;
        else
            add_keyword(line, header);
    }
    throw InputError({path, lines.number(), 0, "TILT"}, "the file ends before it", "a line TILT=NONE, TILT=INCLUDE or TILT=<file>");
}

constexpr std::string_view separators{" \t\v\f,\0", 6};

/// The numbers after the TILT line: separated by blanks, commas and line ends, wrapped anywhere.
class IesNumbers {
  public:
    IesNumbers(const std::filesystem::path& path, LineReader& lines) : path_(path), lines_(lines) {}

    double number(const char* name) {
        const std::string_view text = token(name);
        return finite_number(text, where(name));
    }
    double above_zero(const char* name) {
        const std::string_view text = token(name);
        return number_above_zero(text, where(name));
    }
    long whole(const char* name, long least, long most) {
        const std::string_view text = token(name);
        return whole_number(text, least, most, where(name));
    }
    /// `lines`, of intensities, gets the line of each.
    std::vector<double> numbers(const char* name, std::size_t count, std::vector<std::size_t>* lines = nullptr) {
        std::vector<double> out; // grows with what is there, not with what the header promises
        for (std::size_t i = 0; i < count; ++i) {
            if (!more())
                throw InputError({path_, lines_.number(), 0, name}, fmt::format("the file ends after {} of {}", i, count), "all of them");
            out.push_back(lines ? intensity_of([&] { return number(name); }) : number(name));
            if (lines)
                lines->push_back(lines_.number());
        }
        return out;
    }
    bool more() {
        for (;;) {
            begin_ = line_.find_first_not_of(separators, end_);
            if (begin_ != std::string_view::npos)
                return true;
            if (!lines_.next(line_))
                return false;
            end_ = 0;
        }
    }
    std::size_t line_number() const { return lines_.number(); }
    /// From the next number on; its first line is line_number().
    std::string_view ahead() {
        if (!more())
            return {};
        const char* const begin = line_.data() + begin_;
        const std::string_view rest = lines_.rest();
        return {begin, static_cast<std::size_t>((rest.empty() ? line_.data() + line_.size() : rest.data() + rest.size()) - begin)};
    }

  private:
    std::string_view token(const char* name) {
        if (!more())
            throw InputError({path_, lines_.number(), 0, name}, "the file ends before it", "a number");
        end_ = std::min(line_.find_first_of(separators, begin_), line_.size());
        return line_.substr(begin_, end_ - begin_);
    }
    InputError::Where where(const char* name) const { return {path_, lines_.number(), begin_ + 1, name}; }

    const std::filesystem::path& path_;
    LineReader& lines_;
    std::string_view line_;
    std::size_t begin_ = 0, end_ = 0;
};

/// What `read` gives. Where it fails, decimal commas are named before what they led to: in an IES file a comma separates.
template <class Read> auto unless_commas(std::string_view text, std::size_t lines_before, const std::filesystem::path& path, Read read) {
    try {
        return read();
    } catch (const InputError&) {
        refuse_decimal_commas(text, lines_before, path);
        throw;
    }
}

/// Lamp-to-luminaire geometry, angles and factors. Gives the factor of the lamp as it was measured, at tilt 0.
double tilt_factor(IesNumbers& numbers, Notes& notes) {
    numbers.whole("lamp-to-luminaire geometry", 1, 3);
    const auto count = static_cast<std::size_t>(numbers.whole("number of tilt angles", 1, 1000));
    const std::vector<double> angles = numbers.numbers("tilt angle", count), factors = numbers.numbers("tilt factor", count);
    const auto zero = std::find(angles.begin(), angles.end(), 0.0);
    if (zero == angles.end()) {
        notes.push_back("TILT has no factor for tilt 0, in which the lamp was measured: 1 is taken.");
        return 1.0;
    }
    const double factor = factors[static_cast<std::size_t>(zero - angles.begin())];
    notes.push_back(
        fmt::format("TILT factors hold for tilted luminaires; the lamp is taken as measured, with the factor {} of tilt 0.", factor));
    return factor;
}

double read_tilt(const IesHeader& header, IesNumbers& numbers, const std::filesystem::path& path, FilesRead& opened, Notes& notes) {
    if (header.tilt == "NONE")
        return 1.0;
    const InputError::Where where{path, header.tilt_line, 0, "TILT"};
    double factor = 1.0;
    if (header.tilt == "INCLUDE") {
        factor = tilt_factor(numbers, notes);
    } else {
        const std::filesystem::path name = header.tilt;
        if (header.tilt.empty() || header.tilt.find_first_of("/\\") != std::string::npos || header.tilt.find("..") != std::string::npos)
            throw InputError(where, fmt::format("found '{}'", printable(header.tilt)),
                             "NONE, INCLUDE or the name of a file beside this one");
        if (header.edition >= 2019)
            notes.push_back("TILT names a file, which LM-63-2019 forbids: read all the same.");
        const std::filesystem::path file = path.parent_path() / name;
        std::error_code ignored; // what cannot be looked at is not there
        if (!std::filesystem::exists(file, ignored))
            throw InputError(where, fmt::format("there is no file '{}' beside this one", printable(header.tilt)),
                             "NONE, INCLUDE or a file");
        const std::string text = lamp_text(read_file(file, opened, max_lamp_text_bytes), file);
        LineReader lines(text);
        IesNumbers tilt_numbers(file, lines);
        factor = unless_commas(text, 0, file, [&] { return tilt_factor(tilt_numbers, notes); });
        if (tilt_numbers.more())
            refuse_decimal_commas(text, 0, file);
    }
    if (!(factor > 0.0))
        throw InputError(where, fmt::format("the factor at tilt 0 is {}", factor), "a factor above 0");
    return factor;
}

struct Photometry {
    char type = 'C';
    double factor = 1.0; ///< cd per listed value
    std::optional<double> lamp_flux_lm;
    MeasuredGrid grid;
    std::vector<std::size_t> lines; ///< of the intensities, plane by plane
    std::string_view intensities;   ///< with all that follows
};

void check_range(const std::vector<double>& angles, double least, double most, const InputError::Where& where) {
    for (const double angle : angles)
        if (angle < least || angle > most)
            throw InputError(where, fmt::format("found {}", angle), fmt::format("angles from {} to {}", least, most));
}

/// What the type code means, and whether the angles can be of that type.
char checked_type(long code, const MeasuredGrid& grid, const std::filesystem::path& path, Notes& notes) {
    const auto [low, high] = std::minmax_element(grid.v_deg.begin(), grid.v_deg.end());
    char type = code == 1 ? 'C' : code == 2 ? 'B' : 'A';
    if (type == 'C' && *low < 0.0) {
        notes.push_back("Type code 1 (C) with vertical angles below 0, which type C has not: read as type A.");
        type = 'A';
    } else if (type == 'A' && *high > 90.0) {
        notes.push_back("Type code 3 (A) with vertical angles above 90, which type A has not: read as type C.");
        type = 'C';
    }
    const InputError::Where v{path, grid.v_line, 0, "vertical angles"}, h{path, grid.h_line, 0, "horizontal angles"};
    check_range(grid.v_deg, type == 'C' ? 0.0 : -90.0, type == 'C' ? 180.0 : 90.0, v);
    const double h_limit = type == 'A' ? 180.0 : type == 'B' ? 90.0 : 360.0;
    check_range(grid.h_deg, -h_limit, h_limit, h);
    if (type != 'C' && grid.h_deg.size() == 1)
        throw InputError(h, "found a single one, which says nothing beside its plane", fmt::format("at least 2 in type {}", type));
    return type;
}

Photometry read_photometry(IesNumbers& numbers, int edition, const std::filesystem::path& path, Notes& notes) {
    Photometry p;
    const long lamps = numbers.whole("number of lamps", -1000, 1'000'000);
    const double lumens = numbers.number("lumens per lamp");
    const double multiplier = numbers.above_zero("candela multiplier");
    const auto nv = static_cast<std::size_t>(numbers.whole("number of vertical angles", 2, static_cast<long>(max_lamp_samples)));
    const auto nh = static_cast<std::size_t>(numbers.whole("number of horizontal angles", 1, static_cast<long>(max_lamp_samples)));
    if (nv * nh > max_lamp_samples)
        throw InputError({path, numbers.line_number(), 0, "number of angles"}, fmt::format("found {} x {}", nv, nh),
                         fmt::format("at most {} intensities", max_lamp_samples));
    const long code = numbers.whole("photometric type", 1, 3);
    numbers.whole("units type", 1, 2);
    for (const char* dimension : {"width", "length", "height"}) // 2002 codes round shapes as negative sizes; any size will do
        numbers.number(dimension);
    const double ballast = numbers.above_zero("ballast factor");
    const double reserved = numbers.number("ballast-lamp photometric factor");
    numbers.number("input watts");
    p.factor = multiplier * ballast;
    if (edition < 1995 && reserved > 0.0)
        p.factor *= reserved;
    else if (edition < 1995)
        notes.push_back(fmt::format("The ballast-lamp photometric factor is {}: taken as 1.", reserved));
    if (lumens > 0.0 && lamps > 0)
        p.lamp_flux_lm = static_cast<double>(lamps) * lumens;
    const auto next_line = [&] { return numbers.more() ? numbers.line_number() : 0; };
    p.grid.v_line = next_line();
    p.grid.v_deg = numbers.numbers("vertical angle", nv);
    p.grid.h_line = next_line();
    p.grid.h_deg = numbers.numbers("horizontal angle", nh);
    p.intensities = numbers.ahead();
    const std::vector<double> planes = numbers.numbers("candela value", nv * nh, &p.lines);
    p.grid.cd.resize(planes.size());
    for (std::size_t h = 0; h < nh; ++h)
        for (std::size_t v = 0; v < nv; ++v)
            p.grid.cd[v * nh + h] = planes[h * nv + v] * p.factor;
    p.type = checked_type(code, p.grid, path, notes);
    return p;
}

PlaneSymmetry symmetry_of(const std::vector<double>& c_deg) {
    const double first = c_deg.front(), last = c_deg.back();
    if (c_deg.size() == 1)
        return PlaneSymmetry::rotational;
    if (first == 0.0 && last == 90.0)
        return PlaneSymmetry::quadrants;
    if (first == 0.0 && last == 180.0)
        return PlaneSymmetry::about_c0_c180;
    return first == 90.0 && last == 270.0 ? PlaneSymmetry::about_c90_c270 : PlaneSymmetry::none;
}

/// H 0..x stands for -x..x in types A and B.
MeasuredGrid laterally_completed(const MeasuredGrid& half, Notes& notes) {
    notes.push_back("The horizontal angles begin at 0, which is lateral symmetry: mirrored.");
    MeasuredGrid whole{{}, half.v_deg, {}};
    std::transform(half.h_deg.rbegin(), half.h_deg.rend() - 1, std::back_inserter(whole.h_deg), std::negate<>());
    whole.h_deg.insert(whole.h_deg.end(), half.h_deg.begin(), half.h_deg.end());
    const std::size_t n = half.h_deg.size();
    for (auto row = half.cd.begin(); row != half.cd.end(); row += static_cast<std::ptrdiff_t>(n)) {
        const auto end = row + static_cast<std::ptrdiff_t>(n);
        whole.cd.insert(whole.cd.end(), std::make_reverse_iterator(end), std::make_reverse_iterator(row + 1));
        whole.cd.insert(whole.cd.end(), row, end);
    }
    return whole;
}

} // namespace

bool looks_like_ies(std::string_view text) {
    LineReader lines(text);
    std::string_view line;
    Notes unused;
    bool first = true;
    for (std::size_t seen = 0; seen < 2000 && lines.next(line); ++seen) {
        if (tilt_of(line) || (first && ies_edition(trimmed(line), unused)))
            return true;
        first = first && trimmed(line).empty();
    }
    return false;
}

LampFile read_ies(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened) {
    LampFile lamp{.name = path.stem().string(), .opened = std::move(opened)};
    LineReader lines(text);
    IesHeader header = read_ies_header(lines, path, lamp.notes);
    const std::string_view rest = lines.rest();
    IesNumbers numbers(path, lines);
    double tilt = 1.0;
    Photometry p = unless_commas(rest, header.tilt_line, path, [&] {
        tilt = read_tilt(header, numbers, path, lamp.opened, lamp.notes);
        return read_photometry(numbers, header.edition, path, lamp.notes);
    });
    if (numbers.more()) {
        refuse_decimal_commas(rest, header.tilt_line, path);
        refuse_decimal_commas(p.intensities, p.lines.front() - 1, path); // angles may have points all the same
        refuse_lone_commas(p.intensities, p.lines.front() - 1, path);
        lamp.notes.push_back(fmt::format("Line {} goes on after the last candela value: not read.", numbers.line_number()));
    }
    for (double& cd : p.grid.cd)
        cd *= tilt;
    const std::size_t planes = p.grid.h_deg.size();
    check_and_order(p.grid, path, lamp.notes, [&](std::size_t at) { return p.lines[at % planes * p.grid.v_deg.size() + at / planes]; });
    check_count(p.grid.v_deg, "vertical angles", p.grid.v_line, path); // columns that say the same twice are one by now
    if (p.type != 'C')
        check_count(p.grid.h_deg, "horizontal angles", p.grid.h_line, path);
    lamp.format = fmt::format("IES LM-63-{}, type {}", header.edition, p.type);
    lamp.declared_flux_lm = p.lamp_flux_lm;
    lamp.labels = std::move(header.labels);
    for (const char* key : {"LUMINAIRE", "LUMCAT"})
        for (const auto& [name, value] : lamp.labels)
            if (name == key && !value.empty())
                lamp.name = value;
    if (p.type == 'C') {
        from_c_planes(p.grid, symmetry_of(p.grid.h_deg), options, lamp);
        return lamp;
    }
    if (p.grid.h_deg.front() == 0.0)
        p.grid = laterally_completed(p.grid, lamp.notes);
    const auto gaps = std::ranges::find(lamp.labels, gaps_key, &std::pair<std::string, std::string>::first);
    const bool written = gaps != lamp.labels.end();
    finish(p.grid, options, written ? &gaps->second : nullptr, {path, 0, 0, gaps_key},
           p.type == 'B' ? std::optional(type_b()) : std::nullopt, lamp);
    if (written)
        lamp.labels.erase(gaps);
    return lamp;
}

} // namespace fernlicht
