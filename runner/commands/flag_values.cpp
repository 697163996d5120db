#include "runner/commands/flag_values.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace fernlicht {

void add_tables_flag(CLI::App& command, std::string& tables) {
    command.add_option("--tables", tables, "csv or tex: write each table of the page also as a file in tables/");
}

TableFormat table_format(const std::string& text) {
    if (!text.empty() && text != "csv" && text != "tex")
        refuse_flag("--tables", text, "csv or tex");
    return text.empty() ? TableFormat::none : text == "csv" ? TableFormat::csv : TableFormat::tex;
}

void refuse_flag(const char* flag, const std::string& found, const char* expected) {
    throw InputError({{}, 0, 0, flag}, "found '" + printable(found) + "'", expected);
}

std::pair<int, int> two_numbers(const char* flag, const std::string& text, char separator, bool open, const char* expected) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos)
        refuse_flag(flag, text, expected);
    const auto number = [&](std::string_view part) {
        if (part.empty() && open)
            return -1;
        int value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc{} || end != part.data() + part.size() || value < 0)
            refuse_flag(flag, text, expected);
        return value;
    };
    const std::string_view all = text;
    return {number(all.substr(0, at)), number(all.substr(at + 1))};
}

std::vector<std::string> items_of(const char* flag, const std::vector<std::string>& lists) {
    std::vector<std::string> items;
    for (const std::string& list : lists)
        for (std::size_t begin = 0; begin <= list.size();) {
            const std::size_t end = std::min(list.find(',', begin), list.size());
            items.push_back(list.substr(begin, end - begin));
            if (items.back().empty())
                refuse_flag(flag, list, "something before and after each comma");
            begin = end + 1;
        }
    return items;
}

std::pair<int, int> resolution_of(const std::string& text) {
    const auto [width, height] = two_numbers("--resolution", text, 'x', false, "WIDTHxHEIGHT, e.g. 1024x768");
    if (std::min(width, height) < 1 || std::max(width, height) > largest_view_px)
        refuse_flag("--resolution", text, fmt::format("sides from 1 to {} pixels", largest_view_px).c_str());
    return {width, height};
}

double share_of(const char* flag, const std::string& text) {
    const bool percent = text.ends_with('%');
    const char *const begin = text.data(), *const end = begin + text.size() - (percent ? 1 : 0);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    value *= percent ? 0.01 : 1.0;
    if (error != std::errc{} || stop != end || !(value > 0.0 && value <= 1.0))
        refuse_flag(flag, text, "a share above 0 and up to 1, or per cent, e.g. 0.005 or 0.5%");
    return value;
}

std::vector<std::optional<BeamTexels>> beams_of(const std::vector<std::string>& texts) {
    constexpr const char* expected = "float, eight-bit or WIDTHxHEIGHTxBITS with 8, 16 or 32 bits, e.g. 512x128x8";
    std::vector<std::optional<BeamTexels>> beams;
    for (const std::string& text : items_of("--beams", texts)) {
        if (text == "float" || text == "eight-bit") {
            beams.push_back(text == "float" ? std::nullopt : std::optional(eight_bit_texels));
            continue;
        }
        const std::size_t last = std::min(text.rfind('x'), text.size() - 1);
        const std::string depth = text.substr(last + 1);
        const auto [width, height] = two_numbers("--beams", text.substr(0, last), 'x', false, expected);
        if ((depth != "8" && depth != "16" && depth != "32") || std::min(width, height) < least_beam_texels ||
            std::max(width, height) > most_beam_texels)
            refuse_flag("--beams", text, expected);
        beams.emplace_back(BeamTexels{width, height, depth == "8" ? 8 : depth == "16" ? 16 : 32});
    }
    return beams;
}

} // namespace fernlicht
