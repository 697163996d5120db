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
    // The first cell whose middle lies above the angle, so that rounded angles still name the same cells.
    const auto first_above = [](const std::vector<double>& axis, double angle) {
        std::size_t low = 0, high = axis.size() - 1;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            (axis[middle] + axis[middle + 1]) / 2.0 > angle ? high = middle : low = middle + 1;
        }
        return low;
    };
    // Each rectangle as four corners, then summed up: time does not grow with rectangles times cells.
    std::vector<long> corners((rows + 1) * (columns + 1), 0);
    const auto corner = [&](std::size_t y, std::size_t x) -> long& { return corners[y * (columns + 1) + x]; };
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(';'), rest.size());
        const std::vector<double> g = four_numbers(rest.substr(0, end));
        if (g.size() != 4 || !(g[0] < g[1]) || !(g[2] < g[3]))
            throw InputError(where, fmt::format("found '{}'", printable(std::string(rest.substr(0, std::min<std::size_t>(end, 200))))),
                             "none, or angles h0 h1 v0 v1 with h0 < h1 and v0 < v1");
        const std::size_t x0 = first_above(table.h_deg, g[0]), x1 = first_above(table.h_deg, g[1]);
        const std::size_t y0 = first_above(table.v_deg, g[2]), y1 = first_above(table.v_deg, g[3]);
        ++corner(y0, x0);
        ++corner(y1, x1);
        --corner(y0, x1);
        --corner(y1, x0);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    table.gaps.assign(rows * columns, 0);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            corner(y, x) += (x > 0 ? corner(y, x - 1) : 0) + (y > 0 ? corner(y - 1, x) : 0) - (x > 0 && y > 0 ? corner(y - 1, x - 1) : 0);
            table.gaps[y * columns + x] = corner(y, x) > 0;
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
