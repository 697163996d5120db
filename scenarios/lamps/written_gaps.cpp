#include "scenarios/lamps/written_gaps.h"

#include "scenarios/lamps/lamp_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::vector<double> four_numbers(std::string_view text) {
    std::vector<double> out;
    while (!(text = trimmed(text)).empty()) {
        const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
        const std::optional<double> value = number_in(text.substr(0, end));
        if (!value || out.size() == 4)
            return {};
        out.push_back(*value);
        text.remove_prefix(end);
    }
    return out;
}

} // namespace

std::string gaps_text(const CandelaTable& table) {
    if (table.gaps.empty())
        return "none";
    std::vector<unsigned char> left = table.gaps;
    const std::size_t columns = table.h_deg.size() - 1, rows = table.v_deg.size() - 1;
    std::string out;
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            if (left[y * columns + x] == 0)
                continue;
            std::size_t right = x + 1, top = y + 1;
            while (right < columns && left[y * columns + right] != 0)
                ++right;
            const auto row = [&](std::size_t r, std::size_t c) { return left.begin() + static_cast<std::ptrdiff_t>(r * columns + c); };
            while (top < rows && std::find(row(top, x), row(top, right), 0) == row(top, right))
                ++top;
            for (std::size_t r = y; r < top; ++r)
                std::fill(row(r, x), row(r, right), static_cast<unsigned char>(0));
            out +=
                fmt::format("{}{} {} {} {}", out.empty() ? "" : "; ", table.h_deg[x], table.h_deg[right], table.v_deg[y], table.v_deg[top]);
        }
    return out.empty() ? "none" : out;
}

void mark_written_gaps(const std::string& text, CandelaTable& table, const InputError::Where& where) {
    if (trimmed(text) == "none")
        return;
    const std::size_t columns = table.h_deg.size() - 1, rows = table.v_deg.size() - 1;
    table.gaps.assign(rows * columns, 0);
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(';'), rest.size());
        const std::vector<double> g = four_numbers(rest.substr(0, end));
        if (g.size() != 4)
            throw InputError(where, fmt::format("found '{}'", printable(std::string(rest.substr(0, end)))),
                             "none, or four angles h0 h1 v0 v1");
        // By the middles of the cells, so that rounded angles still name the same cells.
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                const double h = (table.h_deg[x] + table.h_deg[x + 1]) / 2.0, v = (table.v_deg[y] + table.v_deg[y + 1]) / 2.0;
                if (h > g[0] && h < g[1] && v > g[2] && v < g[3])
                    table.gaps[y * columns + x] = 1;
            }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
}

bool take_written_gaps(std::vector<std::pair<std::string, std::string>>& labels, CandelaTable& table, const std::filesystem::path& path) {
    const auto found = std::find_if(labels.begin(), labels.end(), [](const auto& label) { return label.first == gaps_key; });
    if (found == labels.end())
        return false;
    mark_written_gaps(found->second, table, {path, 0, 0, gaps_key});
    labels.erase(found);
    return true;
}

} // namespace fernlicht
