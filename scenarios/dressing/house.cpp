#include "scenarios/dressing/dressed_object.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fernlicht {
namespace {

constexpr double wall_inside_m = 0.35;    ///< from the box: eaves reach so far beyond the walls
constexpr double roof_beyond_m = 0.25;    ///< and the roof's ends beyond the gables
constexpr double reveal_m = 0.14;         ///< windows stand so far behind the wall's face
constexpr double roof_thick_m = 0.18;     ///< upright
constexpr double floor_to_floor_m = 2.65; ///< from floor to floor
constexpr double floor_m = 0.35;          ///< of the lowest storey above the ground: as high as the plinth
constexpr double plinth_proud_m = 0.04;   ///< before the wall
constexpr double frame_wide_m = 0.07;

/// A hole in a wall, in its plane: u to the right as seen from outside, z up.
struct Opening {
    double left_m, right_m, bottom_m, top_m;
    Stuff pane;         ///< of a door the light above it
    double drawn = 0.0; ///< how far a blind is down, whether there are curtains
    bool is_door = false;

    bool has_blind() const { return pane == Stuff::glass && !is_door && drawn < 0.4; }
};

/// A wall's plane: where u = 0 stands, which way u runs, and which way is out.
struct WallPlane {
    glm::dvec3 origin_m, along, out;
    glm::dvec3 at(double u, double z, double depth = 0.0) const { return origin_m + u * along - depth * out + glm::dvec3(0.0, 0.0, z); }
};

class HouseBuilder {
  public:
    HouseBuilder(const HouseSize& size, Dice& dice, Detail detail) : size_(size), dice_(dice), near_(detail == Detail::near) {
        static constexpr Stuff walls[]{Stuff::white_plaster, Stuff::ochre_plaster, Stuff::grey_plaster, Stuff::rose_plaster, Stuff::brick};
        wall_ = walls[dice.of(5)];
        roof_ = dice.share() < 0.7 ? Stuff::red_tiles : Stuff::dark_tiles;
        shutters_ = dice.share() < 0.35;
        at_home_ = dice.share() < 0.75;
        chimney_at_m_ = {dice.between(-0.3, 0.3) * size.length_m, dice.share() < 0.5 ? -0.55 : 0.55};
        chimney_m_ = 0.6;
        half_length_m_ = 0.5 * size.length_m - roof_beyond_m;
        half_width_m_ = 0.5 * size.width_m - wall_inside_m;
        ridge_m_ = size.height_m - chimney_m_;
        // As many storeys as leave the roof a rise of 0.4 of the half width at least.
        const double room = ridge_m_ - size.ground_m - 0.4 * half_width_m_ - floor_m;
        storeys_ = std::max(1, static_cast<int>(room / floor_to_floor_m));
        const double wall_top = std::max(size.ground_m + floor_m + floor_to_floor_m * storeys_, ridge_m_ - 1.1 * half_width_m_);
        slope_ = (ridge_m_ - roof_thick_m - wall_top) / half_width_m_;
        eaves_m_ = wall_top;
    }

    TriangleSoup build() {
        const bool front_left = size_.road_left;
        for (const bool left : {true, false}) {
            const double side = left ? 1.0 : -1.0;
            const WallPlane plane{{side * half_length_m_, side * half_width_m_, 0.0}, {-side, 0.0, 0.0}, {0.0, side, 0.0}};
            wall(plane, 2.0 * half_length_m_, left == front_left);
        }
        for (const double end : {-1.0, 1.0}) {
            const WallPlane plane{{end * half_length_m_, -end * half_width_m_, 0.0}, {0.0, end, 0.0}, {end, 0.0, 0.0}};
            wall(plane, 2.0 * half_width_m_, false);
            gable(plane);
        }
        if (near_)
            plinth();
        roof();
        chimney();
        return std::move(soup_);
    }

  private:
    void quad(const std::array<glm::dvec3, 4>& q, Stuff stuff) {
        soup_.add({q[0], q[1], q[2]}, index_of(stuff));
        soup_.add({q[0], q[2], q[3]}, index_of(stuff));
    }
    /// Of a wall's plane, at so much depth behind it.
    void flat(const WallPlane& p, double u0, double u1, double z0, double z1, double depth, Stuff stuff) {
        if (u1 - u0 > 1e-6 && z1 - z0 > 1e-6)
            quad({p.at(u0, z0, depth), p.at(u1, z0, depth), p.at(u1, z1, depth), p.at(u0, z1, depth)}, stuff);
    }

    Stuff pane() {
        if (!at_home_ || dice_.share() > 0.24)
            return Stuff::glass;
        return dice_.share() < 0.6 ? Stuff::curtain : Stuff::room;
    }

    std::vector<Opening> openings(double length, bool front) {
        std::vector<Opening> all;
        const int columns = std::max(1, static_cast<int>((length - 1.0) / 2.6));
        const double pitch = length / columns;
        const int door = front ? static_cast<int>(dice_.of(static_cast<std::size_t>(columns))) : -1;
        for (int storey = 0; storey < storeys_; ++storey) {
            const double floor = size_.ground_m + floor_m + floor_to_floor_m * storey;
            for (int column = 0; column < columns; ++column) {
                const double middle = (column + 0.5) * pitch;
                if (storey == 0 && column == door)
                    all.push_back({middle - 0.55, middle + 0.55, floor, floor + 2.1, pane(), dice_.share(), true});
                else if (front || dice_.share() < 0.7)
                    all.push_back(
                        {middle - 0.55, middle + 0.55, floor + 0.85, std::min(floor + 2.1, eaves_m_ - 0.15), pane(), dice_.share()});
            }
        }
        return all;
    }

    /// Cells between all edges of openings, so that no corner of one lies on another's side.
    void wall(const WallPlane& p, double length, bool front) {
        const std::vector<Opening> holes = openings(length, front);
        std::vector<double> us{0.0, length}, zs{0.0, eaves_m_};
        for (const Opening& hole : holes) {
            us.insert(us.end(), {hole.left_m, hole.right_m});
            zs.insert(zs.end(), {hole.bottom_m, hole.top_m});
        }
        for (std::vector<double>* cuts : {&us, &zs}) {
            std::ranges::sort(*cuts);
            cuts->erase(std::unique(cuts->begin(), cuts->end(), [](double a, double b) { return b - a < 1e-6; }), cuts->end());
        }
        for (std::size_t i = 0; i + 1 < us.size(); ++i)
            for (std::size_t k = 0; k + 1 < zs.size(); ++k) {
                const double u = 0.5 * (us[i] + us[i + 1]), z = 0.5 * (zs[k] + zs[k + 1]);
                const bool open = std::ranges::any_of(
                    holes, [&](const Opening& h) { return u > h.left_m && u < h.right_m && z > h.bottom_m && z < h.top_m; });
                if (!open)
                    flat(p, us[i], us[i + 1], zs[k], zs[k + 1], 0.0, wall_);
            }
        for (const Opening& hole : holes) {
            near_ ? fill(p, hole)
                  : flat(p, hole.left_m, hole.right_m, hole.bottom_m, hole.top_m, 0.0,
                         hole.is_door       ? Stuff::door
                         : hole.has_blind() ? Stuff::blind
                                            : hole.pane);
            if (hole.is_door) {
                const glm::dvec3 foot = p.at(hole.left_m - 0.1, 0.0),
                                 top = p.at(hole.right_m + 0.1, size_.ground_m + 0.5 * floor_m, 0.05 - wall_inside_m);
                append_box(soup_, glm::min(foot, top), glm::max(foot, top), index_of(Stuff::plinth)); // the step
            }
        }
    }

    void fill(const WallPlane& p, const Opening& h) {
        const double l = h.left_m, r = h.right_m, b = h.bottom_m, t = h.top_m, d = reveal_m;
        quad({p.at(l, b), p.at(l, b, d), p.at(l, t, d), p.at(l, t)}, wall_);
        quad({p.at(r, b, d), p.at(r, b), p.at(r, t), p.at(r, t, d)}, wall_);
        quad({p.at(l, t, d), p.at(r, t, d), p.at(r, t), p.at(l, t)}, wall_);
        quad({p.at(l, b), p.at(r, b), p.at(r, b, d), p.at(l, b, d)}, h.is_door ? Stuff::plinth : Stuff::white_frame);
        if (h.is_door) {
            flat(p, l, r, b, t - 0.35, d, Stuff::door);
            flat(p, l, r, t - 0.35, t, d, h.pane); // the light above it
            return;
        }
        double blind = t; // its lower end
        if (h.has_blind()) {
            blind = h.drawn < 0.25 ? b : b + 0.45 * (t - b);
            flat(p, l, r, blind, t, 0.4 * d, Stuff::blind);
            flat(p, l, r, blind - 0.02, blind, 0.4 * d - 0.004, Stuff::zinc); // its last slat
        }
        if (blind == b) {
            shutters(p, h);
            return;
        }
        flat(p, l, l + frame_wide_m, b, t, d, Stuff::white_frame);
        flat(p, r - frame_wide_m, r, b, t, d, Stuff::white_frame);
        flat(p, l + frame_wide_m, r - frame_wide_m, b, b + frame_wide_m, d, Stuff::white_frame);
        flat(p, l + frame_wide_m, r - frame_wide_m, t - frame_wide_m, t, d, Stuff::white_frame);
        const double middle = 0.5 * (l + r), bar = 0.5 * frame_wide_m;
        flat(p, middle - bar, middle + bar, b + frame_wide_m, t - frame_wide_m, d, Stuff::white_frame);
        // Two panes; curtains hang at their outer sides, or a low one across them.
        const bool lit = h.pane == Stuff::room, low = h.drawn > 0.8 && !lit;
        const Stuff cloth = lit ? Stuff::curtain : Stuff::net;
        const double hem = low && h.pane == Stuff::glass ? 0.5 * (b + t) : b + frame_wide_m, top = t - frame_wide_m,
                     hangs = !low && h.pane != Stuff::curtain && h.drawn > 0.45 ? 0.12 : 0.0;
        for (const double side : {-1.0, 1.0}) {
            const double inner = middle + side * bar, outer = middle + side * (0.5 * (r - l) - frame_wide_m), edge = outer - side * hangs;
            flat(p, std::min(inner, edge), std::max(inner, edge), hem, top, d, h.pane);
            flat(p, std::min(edge, outer), std::max(edge, outer), hem, top, d, cloth);
            flat(p, std::min(inner, outer), std::max(inner, outer), b + frame_wide_m, hem, d, cloth);
        }
        shutters(p, h);
    }

    /// Leaves of half the window's width, open against the wall.
    void shutters(const WallPlane& p, const Opening& h) {
        if (shutters_)
            for (const double from : {h.left_m - 0.58, h.right_m + 0.03})
                flat(p, from, from + 0.55, h.bottom_m, h.top_m, -0.03, Stuff::shutter);
    }

    /// Between the wall's top and the roof.
    void gable(const WallPlane& p) {
        const double width = 2.0 * half_width_m_, top = ridge_m_ - roof_thick_m;
        const std::array<glm::dvec3, 3> whole{p.at(0.0, eaves_m_), p.at(width, eaves_m_), p.at(half_width_m_, top)};
        const double z0 = eaves_m_ + 0.35, z1 = z0 + 1.0, u0 = half_width_m_ - 0.45, u1 = half_width_m_ + 0.45;
        const Stuff behind = pane();
        if (!near_ || top - z1 < 1.2) {
            soup_.add(whole, index_of(wall_));
            return;
        }
        // A window under the ridge, and the wall round it as a fan.
        const glm::dvec3 a = p.at(u0, z0), b = p.at(u1, z0), c = p.at(u1, z1), d = p.at(u0, z1);
        const std::uint32_t m = index_of(wall_);
        soup_.add({whole[0], whole[1], b}, m);
        soup_.add({whole[0], b, a}, m);
        soup_.add({whole[1], whole[2], c}, m);
        soup_.add({whole[1], c, b}, m);
        soup_.add({whole[2], whole[0], d}, m);
        soup_.add({whole[0], a, d}, m);
        soup_.add({whole[2], d, c}, m);
        const bool shuttered = std::exchange(shutters_, false);
        fill(p, {u0, u1, z0, z1, behind, 0.5});
        shutters_ = shuttered;
    }

    void plinth() {
        const double x = half_length_m_ + plinth_proud_m, y = half_width_m_ + plinth_proud_m;
        const double top = size_.ground_m + floor_m;
        const std::array<glm::dvec2, 4> outer{glm::dvec2(x, y), {-x, y}, {-x, -y}, {x, -y}},
            inner{glm::dvec2(half_length_m_, half_width_m_),
                  {-half_length_m_, half_width_m_},
                  {-half_length_m_, -half_width_m_},
                  {half_length_m_, -half_width_m_}};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t k = (i + 1) % 4;
            const glm::dvec2 &a = outer[k], &b = outer[i];
            const double lower = top - plinth_proud_m; // a chamfer leads rain off
            quad({glm::dvec3(b, 0.0), glm::dvec3(a, 0.0), glm::dvec3(a, lower), glm::dvec3(b, lower)}, Stuff::plinth);
            quad({glm::dvec3(b, lower), glm::dvec3(a, lower), glm::dvec3(inner[k], top), glm::dvec3(inner[i], top)}, Stuff::plinth);
        }
    }

    double top_at(double y) const { return ridge_m_ - slope_ * std::abs(y); }

    /// Two slabs with their undersides, ends and fascias: closed.
    void roof() {
        const double x = 0.5 * size_.length_m, y = 0.5 * size_.width_m;
        for (const double side : {-1.0, 1.0}) {
            const auto at = [&](double along, double across, double down) {
                return glm::dvec3(side * along, side * across, top_at(across) - down);
            };
            quad({at(x, y, 0), at(-x, y, 0), at(-x, 0, 0), at(x, 0, 0)}, roof_);
            const double d = roof_thick_m;
            quad({at(x, 0, d), at(-x, 0, d), at(-x, y, d), at(x, y, d)}, Stuff::wood);
            quad({at(x, y, d), at(-x, y, d), at(-x, y, 0), at(x, y, 0)}, Stuff::zinc); // the gutter's face
            quad({at(x, 0, d), at(x, y, d), at(x, y, 0), at(x, 0, 0)}, Stuff::wood);
            quad({at(-x, y, d), at(-x, 0, d), at(-x, 0, 0), at(-x, y, 0)}, Stuff::wood);
        }
    }

    void chimney() {
        const double x = chimney_at_m_.x, y = chimney_at_m_.y;
        append_box(soup_, {x - 0.28, y - 0.28, top_at(0.83) - 0.1}, {x + 0.28, y + 0.28, size_.height_m}, index_of(Stuff::brick));
    }

    HouseSize size_;
    Dice& dice_;
    bool near_;
    Stuff wall_, roof_;
    bool shutters_ = false, at_home_ = false;
    double chimney_m_, half_length_m_, half_width_m_, ridge_m_, slope_ = 0.0, eaves_m_ = 0.0;
    glm::dvec2 chimney_at_m_{0.0};
    int storeys_ = 1;
    TriangleSoup soup_;
};

} // namespace

DressedObject dressed_house(const HouseSize& size, Dice dice, Detail detail) {
    DressedObject out;
    out.closed = true;
    out.low = HouseBuilder(size, dice, detail).build();
    smooth(out.low, radians(1.0)); // corners in one plane are one
    return out;
}

} // namespace fernlicht
