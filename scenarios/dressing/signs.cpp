#include "scenarios/dressing/dressed_object.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace fernlicht {
namespace {

using Points = std::vector<glm::dvec2>; ///< on the face, metres from its middle: right and up as its reader sees them

/// Strokes on a grid of 4 by 6, two digits a point; of letters that are not here nothing is drawn.
constexpr std::array<std::pair<char, std::string_view>, 36> glyphs{{
    {'0', "10 01 05 16 36 45 41 30 10"},
    {'1', "04 26 20"},
    {'2', "05 16 36 45 44 00 40"},
    {'3', "05 16 36 45 44 33 13|33 42 41 30 10 01"},
    {'4', "30 36 02 42"},
    {'5', "46 06 03 33 42 41 30 10 01"},
    {'6', "45 36 16 05 01 10 30 41 42 33 13 02"},
    {'7', "06 46 10"},
    {'8', "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33"},
    {'9', "01 10 30 41 45 36 16 05 04 13 33 44"},
    {'A', "00 26 40|12 32"},
    {'B', "00 06 36 45 44 33 03|33 42 41 30 00"},
    {'C', "45 36 16 05 01 10 30 41"},
    {'D', "00 06 26 44 42 20 00"},
    {'E', "46 06 00 40|03 33"},
    {'F', "46 06 00|03 33"},
    {'G', "45 36 16 05 01 10 30 41 43 23"},
    {'H', "00 06|40 46|03 43"},
    {'I', "20 26"},
    {'J', "46 41 30 10 01"},
    {'K', "00 06|46 03 40"},
    {'L', "06 00 40"},
    {'M', "00 06 23 46 40"},
    {'N', "00 06 40 46"},
    {'O', "10 01 05 16 36 45 41 30 10"},
    {'P', "00 06 36 45 44 33 03"},
    {'Q', "10 01 05 16 36 45 41 30 10|22 40"},
    {'R', "00 06 36 45 44 33 03|23 40"},
    {'S', "45 36 16 05 04 13 33 42 41 30 10 01"},
    {'T', "06 46|20 26"},
    {'U', "06 01 10 30 41 46"},
    {'V', "06 20 46"},
    {'W', "06 10 23 30 46"},
    {'X', "00 46|06 40"},
    {'Y', "06 23 46|23 20"},
    {'Z', "06 46 00 40"},
}};

Points polygon(int corners, double radius_m, double first_rad) {
    Points out;
    for (int i = 0; i < corners; ++i) {
        const double angle = first_rad + 2.0 * pi * i / corners;
        out.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
    }
    return out;
}

Points rectangle(double width_m, double height_m) {
    const double x = 0.5 * width_m, y = 0.5 * height_m;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

Points scaled(Points points, double by) {
    for (glm::dvec2& p : points)
        p *= by;
    return points;
}

/// A plate of a sign with colours on it, film on film.
class SignPlate {
  public:
    /// Counter-clockwise as its reader sees it, convex. `thick_m` deep, its face at x = 0.
    SignPlate(TriangleSoup& soup, const Points& outline, Stuff colour) : soup_(soup), outline_(outline) {
        constexpr double thick_m = 0.02;
        fill(outline, colour, 0);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
            quad(glm::dvec3(0.0, a), glm::dvec3(-thick_m, a), glm::dvec3(-thick_m, b), glm::dvec3(0.0, b), Stuff::sign_back);
            if (i > 0 && i + 1 < outline.size())
                soup_.add({glm::dvec3(-thick_m, outline[0]), glm::dvec3(-thick_m, b), glm::dvec3(-thick_m, a)}, index_of(Stuff::sign_back));
        }
    }

    void fill(const Points& convex, Stuff colour, int layer = 1) {
        for (std::size_t i = 1; i + 1 < convex.size(); ++i)
            soup_.add({at(convex[0], layer), at(convex[i], layer), at(convex[i + 1], layer)}, index_of(colour));
    }
    /// Between the outline drawn in to two shares of its size.
    void border(double outer, double inner, Stuff colour) {
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            const glm::dvec2 &a = outline_[i], &b = outline_[(i + 1) % outline_.size()];
            quad(at(outer * a, 1), at(outer * b, 1), at(inner * b, 1), at(inner * a, 1), colour);
        }
    }
    /// A frame of one width along the edges of a rectangle, `in_m` from them.
    void frame(double width_m, double height_m, double in_m, double wide_m, Stuff colour) {
        const Points outer = rectangle(width_m - 2.0 * in_m, height_m - 2.0 * in_m),
                     inner = rectangle(width_m - 2.0 * (in_m + wide_m), height_m - 2.0 * (in_m + wide_m));
        for (std::size_t i = 0; i < 4; ++i)
            quad(at(outer[i], 1), at(outer[(i + 1) % 4], 1), at(inner[(i + 1) % 4], 1), at(inner[i], 1), colour);
    }
    void stroke(const Points& line, double wide_m, Stuff colour) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const glm::dvec2 along = 0.5 * wide_m * glm::normalize(line[i + 1] - line[i]), left(-along.y, along.x),
                             a = line[i] - 0.6 * along, b = line[i + 1] + 0.6 * along;
            quad(at(a - left, 2), at(b - left, 2), at(b + left, 2), at(a + left, 2), colour);
        }
    }
    void arrow(const Points& line, double wide_m, Stuff colour) {
        stroke(line, wide_m, colour);
        const glm::dvec2 tip = line.back(), along = wide_m * glm::normalize(tip - line[line.size() - 2]), left(-along.y, along.x);
        fill({tip - left * 1.3, tip + 1.8 * along, tip + left * 1.3}, colour, 2);
    }
    /// Letters 1/7 of their height thick (DIN 1451), no wider than `room_m`.
    void write(std::string_view text, const glm::dvec2& middle, double height_m, double room_m, Stuff colour) {
        constexpr double pitch = 5.8; // of the grid, from letter to letter
        if (text.empty())
            return;
        const double columns = pitch * static_cast<double>(text.size()) - (pitch - 4.0), cell = std::min(height_m / 6.0, room_m / columns);
        glm::dvec2 pen = middle - 0.5 * cell * glm::dvec2(columns, 6.0);
        for (const char c : text) {
            const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
            if (const auto* glyph = std::ranges::find(glyphs, upper, &std::pair<char, std::string_view>::first); glyph != glyphs.end()) {
                Points line;
                for (std::size_t i = 0; i + 1 < glyph->second.size(); i += 3) {
                    line.push_back(pen + cell * glm::dvec2(glyph->second[i] - '0', glyph->second[i + 1] - '0'));
                    if (i + 2 >= glyph->second.size() || glyph->second[i + 2] == '|') {
                        stroke(line, cell * 6.0 / 7.0, colour);
                        line.clear();
                    }
                }
            }
            pen.x += pitch * cell;
        }
    }

  private:
    static glm::dvec3 at(const glm::dvec2& p, int layer) { return {0.0015 * layer, p}; }
    void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, Stuff colour) {
        soup_.add({a, b, c}, index_of(colour));
        soup_.add({a, c, d}, index_of(colour));
    }
    TriangleSoup& soup_;
    Points outline_;
};

/// A name of no place.
std::string place_name(Dice& dice) {
    static constexpr std::array<const char*, 8> first{"ALT", "NEU", "OBER", "LINDEN", "STEIN", "BUCHEN", "HIRSCH", "MUEHL"};
    static constexpr std::array<const char*, 6> second{"DORF", "HEIM", "BACH", "TAL", "BERG", "HAUSEN"};
    const char* const begin = first[dice.of(first.size())];
    return std::string(begin) + second[dice.of(second.size())];
}

/// Lines of text from above, as large as they fit.
void write_lines(SignPlate& plate, const std::vector<std::string>& lines, double width_m, double height_m, Stuff colour) {
    const double pitch = height_m / static_cast<double>(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
        plate.write(lines[i], {0.0, 0.5 * height_m - (static_cast<double>(i) + 0.5) * pitch}, 0.62 * pitch, width_m, colour);
}

/// Warning of what lies ahead: a bent arrow for bends, else an exclamation mark.
void warning(TriangleSoup& soup, double size_m, std::string_view type, std::string_view subtype) {
    SignPlate plate(soup, polygon(3, size_m / std::sqrt(3.0), 0.5 * pi), Stuff::sheet_white);
    plate.border(0.97, 0.74, Stuff::sheet_red);
    const double u = 0.1 * size_m;
    if (type == "103" || type == "105") {
        const double side = subtype == "20" ? 1.0 : -1.0;
        plate.arrow({{-0.5 * side * u, -1.6 * u}, {-0.5 * side * u, -0.3 * u}, {0.35 * side * u, 0.7 * u}}, 0.55 * u, Stuff::sheet_black);
    } else {
        plate.stroke({{0.0, -0.4 * u}, {0.0, 1.6 * u}}, 0.55 * u, Stuff::sheet_black);
        plate.stroke({{0.0, -1.55 * u}, {0.0, -1.25 * u}}, 0.55 * u, Stuff::sheet_black);
    }
}

/// The number of a speed limit: its value, or a subtype that is one; 274-62 alone is none.
std::string limit_of(const SignalFace& look) {
    const double value = std::strtod(look.value.c_str(), nullptr), subtype = std::strtod(look.subtype.c_str(), nullptr);
    const double limit = value >= 5.0 ? value : subtype >= 5.0 && std::fmod(subtype, 10.0) == 0.0 ? subtype : 0.0;
    return limit >= 5.0 && limit <= 130.0 ? std::to_string(static_cast<int>(limit)) : "";
}

} // namespace

/// Numbers: catalogue of German signs (VzKat). What it does not have, and what other countries have, keeps a white face with an edge.
TriangleSoup dressed_sign(double w, double h, const SignalFace& look, Dice dice) {
    TriangleSoup soup;
    const double smaller = std::min(w, h);
    const std::string& type = look.type;
    const bool known = look.country.empty() || look.country == "DE" || look.country == "DEU" || look.country == "Germany";
    const int number = known ? std::atoi(type.c_str()) : 0;
    const auto board = [&](Stuff ground, Stuff ink, const std::vector<std::string>& lines) {
        SignPlate plate(soup, rectangle(w, h), ground);
        plate.frame(w, h, 0.015 * smaller, 0.025 * smaller, ink);
        write_lines(plate, lines, 0.82 * w, 0.78 * h, ink);
    };
    if ((number >= 101 && number <= 151) && number != 150) {
        warning(soup, std::min(w, h * 2.0 / std::sqrt(3.0)), type, look.subtype);
        for (SoupVertex& v : soup.vertices)
            v.position_m.z -= 0.5 * h - std::min(w, h * 2.0 / std::sqrt(3.0)) * 0.5 / std::sqrt(3.0);
    } else if (number == 205) {
        SignPlate(soup, polygon(3, w / std::sqrt(3.0), -0.5 * pi), Stuff::sheet_white).border(0.97, 0.70, Stuff::sheet_red);
    } else if (number == 206) {
        SignPlate plate(soup, polygon(8, 0.5 * smaller / std::cos(pi / 8.0), pi / 8.0), Stuff::sheet_red);
        plate.border(0.97, 0.93, Stuff::sheet_white);
        plate.write("STOP", {0.0, 0.0}, 0.33 * smaller, 0.76 * smaller, Stuff::sheet_white);
    } else if (number >= 250 && number <= 277) {
        SignPlate plate(soup, polygon(24, 0.5 * smaller, 0.0), Stuff::sheet_white);
        plate.border(0.98, 0.80, Stuff::sheet_red);
        if (number == 274)
            plate.write(limit_of(look), {0.0, 0.0}, 0.42 * smaller, 0.66 * smaller, Stuff::sheet_black);
    } else if (number == 306) {
        SignPlate plate(soup, polygon(4, 0.5 * smaller, 0.0), Stuff::sheet_white);
        plate.fill(scaled(polygon(4, 0.5 * smaller, 0.0), 0.72), Stuff::sheet_yellow);
        plate.border(0.98, 0.95, Stuff::sheet_black);
    } else if (number == 310 || number == 311) {
        board(Stuff::sheet_yellow, Stuff::sheet_black, {!look.text.empty() ? look.text : place_name(dice), "KREIS " + place_name(dice)});
    } else if (number >= 415 && number <= 439) {
        const std::string there = place_name(dice), beyond = place_name(dice);
        board(Stuff::sheet_yellow, Stuff::sheet_black,
              {there + " " + std::to_string(3 + dice.of(9)), beyond + " " + std::to_string(12 + dice.of(30))});
    } else if (number >= 440 && number <= 453) {
        board(Stuff::sheet_blue, Stuff::sheet_white, {place_name(dice), place_name(dice), std::to_string(1000)});
    } else if (number == 625) {
        SignPlate plate(soup, rectangle(w, h), Stuff::sheet_white);
        const double side = look.subtype == "10" || look.subtype == "11" ? -1.0 : 1.0, x = 0.28 * w, y = 0.46 * h;
        for (const double at : {-0.24 * w, 0.22 * w})
            for (const double up : {-1.0, 1.0}) {
                Points half{
                    {side * (at - 0.5 * x), up * y}, {side * at, up * y}, {side * (at + 0.7 * x), 0.0}, {side * (at + 0.2 * x), 0.0}};
                if (side * up > 0.0)
                    std::ranges::reverse(half);
                plate.fill(half, Stuff::sheet_red);
            }
    } else {
        board(Stuff::sheet_white, Stuff::sheet_black, {look.text});
    }
    return soup;
}

TriangleSoup dressed_traffic_light(double width_m, double height_m) {
    constexpr double deep_m = 0.2, visor_m = 0.12;
    TriangleSoup soup;
    append_box(soup, {-deep_m, -0.5 * width_m, -0.5 * height_m}, {0.0, 0.5 * width_m, 0.5 * height_m}, index_of(Stuff::shutter));
    const double pitch = height_m / 3.0, radius = 0.42 * std::min(width_m, pitch);
    for (const double row : {-1.0, 0.0, 1.0}) {
        const Points lens = polygon(12, radius, 0.0);
        const auto at = [&](std::size_t i, double x) { return glm::dvec3(x, lens[i % 12].x, lens[i % 12].y + row * pitch); };
        for (std::size_t i = 0; i < 12; ++i) {
            if (i > 0 && i < 11)
                soup.add({at(0, 0.004), at(i, 0.004), at(i + 1, 0.004)}, index_of(Stuff::glass));
            if (i < 6) // the upper half: a visor with two sides
                for (const bool outside : {true, false}) {
                    const std::size_t a = outside ? i : i + 1, b = outside ? i + 1 : i;
                    soup.add({at(a, visor_m), at(a, 0.0), at(b, 0.0)}, index_of(Stuff::shutter));
                    soup.add({at(a, visor_m), at(b, 0.0), at(b, visor_m)}, index_of(Stuff::shutter));
                }
        }
    }
    return soup;
}

} // namespace fernlicht
