#include "metrics/beam/intake.h"

#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// The wide light, and by how much more of it to the wrong side is no chance.
constexpr double wide_from_deg = 10.0, wide_to_deg = 60.0, wide_down_deg = -10.0, wide_up_deg = 2.0;
constexpr double clear_ratio = 1.3;

/// 1 of a right lamp, -1 of a left one, 0 where its names do not say, or say both.
int side_named(const LampFile& lamp) {
    std::string text = lamp.name;
    if (!lamp.opened.empty())
        text += " " + lamp.opened.front().path.stem().string();
    bool left = false, right = false;
    std::string word;
    for (const char c : text + " ") {
        if (std::isalpha(static_cast<unsigned char>(c))) {
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            continue;
        }
        left = left || word == "left" || word == "lh" || word == "links";
        right = right || word == "right" || word == "rh" || word == "rechts";
        word.clear();
    }
    return left == right ? 0 : right ? 1 : -1;
}

/// Natural logarithm of the wide light on the left over that on the right; 0 where either side has none.
double log_to_the_left(const CandelaTable& t) {
    double left = 0.0, right = 0.0;
    for (double v = wide_down_deg; v <= wide_up_deg; v += 0.25)
        for (double h = wide_from_deg; h <= wide_to_deg; h += 0.5) {
            left += intensity_cd(t, -h, v);
            right += intensity_cd(t, h, v);
        }
    return left > 0.0 && right > 0.0 ? std::log(left / right) : 0.0;
}

} // namespace

std::optional<IntakeFinding> swapped_sides(const LampFile& left, const LampFile& right, bool by_names) {
    if (left.table == right.table)
        return std::nullopt;
    const int left_named = by_names ? side_named(left) : 0, right_named = by_names ? side_named(right) : 0;
    // Both have the cut-off of the same traffic: what that sends aside is in both, and goes out.
    const double outwards = log_to_the_left(left.table) - log_to_the_left(right.table);
    const std::string by_light =
        fmt::format("the left lamp's wide light goes {:.2f} times as much to the right as the right lamp's", std::exp(-outwards));
    const bool light_says_so = outwards < -std::log(clear_ratio);
    if (left_named == 1 && right_named == -1)
        return IntakeFinding{IntakeFault::sides, true,
                             fmt::format("the two sides are swapped: the left lamp is called '{}' and the right one '{}'{}", left.name,
                                         right.name, light_says_so ? ", and " + by_light : "")};
    if (light_says_so && left_named != -1 && right_named != 1)
        return IntakeFinding{IntakeFault::sides, false,
                             fmt::format("the two sides may be swapped: {}, and headlamps light their own side more", by_light)};
    return std::nullopt;
}

} // namespace fernlicht
