#include "scenarios/lamps/ies.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/measured_grid.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t text_width = 200; ///< LM-63-2002 allows 256 characters a line
constexpr std::size_t number_width = 120;

/// `[KEY] text`, continued by [MORE] at blanks.
void append_keyword(std::string& out, const std::string& key, const std::string& value) {
    std::string rest = on_one_line(value);
    std::string head = fmt::format("[{}]", key);
    while (rest.size() > text_width) {
        const std::size_t blank = rest.rfind(' ', text_width);
        if (blank == std::string::npos || blank == 0)
            break;
        out += fmt::format("{} {}\n", head, rest.substr(0, blank));
        rest.erase(0, blank + 1);
        head = "[MORE]";
    }
    out += fmt::format("{} {}\n", head, rest);
}

class NumberLines {
  public:
    explicit NumberLines(std::string& out) : out_(out) {}
    void add(double value) {
        const std::string text = fmt::format("{}", value);
        if (width_ > 0 && width_ + 1 + text.size() > number_width)
            end();
        if (width_ > 0)
            out_ += ' ';
        out_ += text;
        width_ += text.size() + 1;
    }
    void end() {
        out_ += '\n';
        width_ = 0;
    }

  private:
    std::string& out_;
    std::size_t width_ = 0;
};

/// LM-63 keywords, our own and those of other formats as user keywords; the four that 2002 requires come first.
void append_keywords(std::string& out, const LampFile& lamp) {
    const auto has = [&](const char* key) {
        return std::ranges::any_of(lamp.labels, [&](const auto& label) { return label.first == key; });
    };
    for (const char* key : {"TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"})
        if (!has(key))
            append_keyword(out, key, "unknown");
    if (!has("LUMCAT"))
        append_keyword(out, "LUMCAT", lamp.name);
    for (const auto& [key, value] : lamp.labels)
        append_keyword(out, key.find_first_of("[]\r\n") == std::string::npos && !key.empty() ? key : "_TEXT", value);
}

/// LM-63 takes an H axis that begins at 0 for one half of a symmetric beam.
CandelaTable not_mirrored(const CandelaTable& table) {
    if (table.h_deg.front() != 0.0)
        return table;
    CandelaTable out = table;
    const std::size_t columns = table.h_deg.size(), rows = table.v_deg.size();
    out.h_deg.insert(out.h_deg.begin(), -0.001);
    out.cd.clear();
    out.gaps.assign((rows - 1) * columns, 1);
    for (std::size_t v = 0; v < rows; ++v) {
        out.cd.push_back(0.0);
        for (std::size_t h = 0; h < columns; ++h) {
            out.cd.push_back(table.at(v, h));
            if (v + 1 < rows && h + 1 < columns)
                out.gaps[v * columns + h + 1] = table.gaps.empty() ? 0 : table.gaps[v * (columns - 1) + h];
        }
    }
    return out;
}

} // namespace

std::string ies_text(const LampFile& lamp) {
    const CandelaTable table = not_mirrored(lamp.table);
    std::string out = "IESNA:LM-63-2002\n";
    append_keywords(out, lamp);
    append_keyword(out, gaps_key, gaps_text(table));
    out += "TILT=NONE\n";
    out += fmt::format("1 {} 1 {} {} 3 2 0 0 0\n1 1 0\n", lamp.declared_flux_lm.value_or(-1.0), table.v_deg.size(), table.h_deg.size());
    NumberLines numbers(out);
    for (const auto* axis : {&table.v_deg, &table.h_deg}) {
        for (const double angle : *axis)
            numbers.add(angle);
        numbers.end();
    }
    for (std::size_t h = 0; h < table.h_deg.size(); ++h) {
        for (std::size_t v = 0; v < table.v_deg.size(); ++v)
            numbers.add(table.at(v, h));
        numbers.end();
    }
    return out;
}

} // namespace fernlicht
