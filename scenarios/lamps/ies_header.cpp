#include "scenarios/lamps/ies_header.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

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

} // namespace

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

std::optional<std::string_view> tilt_of(std::string_view line) {
    line = trimmed(line);
    if (uppercase(line.substr(0, 4)) != "TILT")
        return std::nullopt;
    line = trimmed(line.substr(4));
    if (!line.starts_with('='))
        return std::nullopt;
    return trimmed(line.substr(1));
}

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

} // namespace fernlicht
