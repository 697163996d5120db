#include "runner/experiments/stability/shadow_trial.h"

#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht::stability {
namespace {

constexpr double of_free_light = 0.02; // by which a drawn light may lie outside what rays allow
constexpr double beside_centre_px = 0.05;
constexpr double looked_up_texels = 1.5; ///< of which ShadowTolerance::aside_share is made; a look-up weighs texels up to one away

/// Across and upwards as the lamp sees it; a look-up weighs a square of texels, whose corners count at the corner of a shadow.
constexpr std::array<glm::dvec2, 13> beside_it{{{0.0, 0.0},
                                                {1.0, 0.0},
                                                {-1.0, 0.0},
                                                {0.0, 1.0},
                                                {0.0, -1.0},
                                                {0.5, 0.0},
                                                {-0.5, 0.0},
                                                {0.0, 0.5},
                                                {0.0, -0.5},
                                                {1.0, 1.0},
                                                {-1.0, 1.0},
                                                {1.0, -1.0},
                                                {-1.0, -1.0}}};

enum class Seen { no, yes, perhaps };

RendererSettings renderer_settings(const ShadowSettings& shadows) {
    RendererSettings settings;
    settings.shadows = shadows;
    return settings;
}

class Beholder {
  public:
    Beholder(const Twin& twin, const Moment& moment, const ShadowTolerance& tolerance)
        : twin_(twin), moment_(moment), tolerance_(tolerance) {}

    Seen sees(const std::vector<TwinPixel>& places, bool ground, const LitLamp& lamp, const glm::dvec3& lamp_m) const {
        bool seen = false, hidden = false;
        for (const TwinPixel& place : places) {
            const glm::dvec3 to_lamp = lamp_m - place.point_m;
            const double d = glm::length(to_lamp);
            if (!(d > 0.0))
                return Seen::perhaps;
            const glm::dvec3 any = std::abs(to_lamp.z) < 0.9 * d ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
            const glm::dvec3 across = glm::normalize(glm::cross(to_lamp, any)), up = glm::cross(across, to_lamp / d);
            const double raise = std::max(tolerance_.raise_m, tolerance_.raise_share * d),
                         aside = tolerance_.aside_m + tolerance_.aside_share * d;
            for (int height = 0; height < (raise > 0.0 ? 3 : 1); ++height)
                for (const glm::dvec2& at : beside_it) {
                    const glm::dvec3 beside = aside * (at.x * across + at.y * up);
                    const double below_surface = std::max(0.0, -glm::dot(beside, place.normal));
                    if (ground && height == 0 && below_surface > 0.0)
                        pass_below(place, place.point_m + beside / looked_up_texels, lamp_m, below_surface / looked_up_texels, seen,
                                   hidden);
                    const glm::dvec3 from = place.point_m + beside + ((height == 0 ? 1e-4 : height * raise) + below_surface) * place.normal;
                    for (int k = 0; k < (tolerance_.lamp_radius_m > 0.0 ? 17 : 1); ++k) { // the middle, 4 half-way, 12 on the rim
                        const double r = k == 0 ? 0.0 : tolerance_.lamp_radius_m * (k < 5 ? 0.5 : 1.0),
                                     angle = 2.0 * pi * k / (k < 5 ? 4.0 : 12.0);
                        cast(from, lamp_m + r * (std::cos(angle) * lamp.pose.left() + std::sin(angle) * lamp.pose.up()), lamp, seen,
                             hidden);
                        if (seen && hidden)
                            return Seen::perhaps;
                    }
                }
        }
        return seen ? Seen::yes : Seen::no;
    }

  private:
    /// Ground that faces the lamp is in no map: a texel that looks below the foot of what stands there meets what is beyond the surface.
    void pass_below(const TwinPixel& place, const glm::dvec3& from, const glm::dvec3& to, double depth_m, bool& seen, bool& hidden) const {
        const double d = glm::length(to - from), rise = glm::dot(to - from, place.normal) / d;
        const double out_m = rise > 0.0 ? depth_m / rise + 1e-4 : d;
        if (out_m >= d)
            return;
        const auto blocker = twin_.cast(moment_, {from, (to - from) / d}, out_m, Twin::Met::casters);
        (blocker && blocker->distance_m < d ? hidden : seen) = true;
    }

    void cast(const glm::dvec3& from, const glm::dvec3& to, const LitLamp& lamp, bool& seen, bool& hidden) const {
        const double d = glm::length(to - from);
        const glm::dvec3 way = (to - from) / d;
        const double gap = tolerance_.gap_m + tolerance_.gap_share * d;
        // Of a map that begins so far from the lamp's plane, along this way.
        const double towards = -glm::dot(way, lamp.pose.forward()),
                     end = tolerance_.map_begins_m > 0.0 && towards > 0.0 ? std::max(0.0, d - tolerance_.map_begins_m / towards) : d;
        const auto blocked = [&](double first, double last) {
            const auto blocker = twin_.cast(moment_, {from, way}, first, Twin::Met::casters);
            return blocker && blocker->distance_m < last;
        };
        const bool whole = blocked(1e-5, d);
        (whole ? hidden : seen) = true;
        if (whole && (gap > 0.0 || end < d))
            (blocked(std::max(gap, 1e-5), end) ? hidden : seen) = true;
    }

    const Twin& twin_;
    const Moment& moment_;
    const ShadowTolerance& tolerance_;
};

} // namespace

ShadowTolerance map_shadow_tolerance(double texel) {
    ShadowTolerance tolerance;
    tolerance.raise_m = 0.03; // ShadowSettings::tolerance_m
    tolerance.raise_share = tolerance.aside_share = 1.5 * texel;
    tolerance.map_begins_m = 0.06;
    return tolerance;
}

ShadowTolerance volume_shadow_tolerance() {
    ShadowTolerance tolerance;
    tolerance.gap_m = 2e-3;
    tolerance.gap_share = 2e-4;
    return tolerance;
}

void ShadowTally::add(const ShadowTally& other) {
    if (wrong() == 0)
        first_wrong = other.first_wrong;
    lit += other.lit;
    dark += other.dark;
    acne += other.acne;
    leaks += other.leaks;
    unsure += other.unsure;
    not_finite += other.not_finite;
}

std::string ShadowTally::text() const {
    return fmt::format("{} of {} lit pixels rendered too dark, {} of {} dark ones too bright, {} in doubt{}", acne, lit, leaks, dark,
                       unsure, first_wrong.empty() ? "" : ", first " + first_wrong);
}

ShadowTrial::ShadowTrial(StabilityBench& bench, const Scene& scene, const ShadowSettings& settings)
    : scene_(scene), renderer_(bench.device(), scene, renderer_settings(settings)), unshadowed_(bench.device(), scene, unshadowed()) {}

ShadowTally ShadowTrial::tally(const Moment& moment, const View& view, const ShadowTolerance& tolerance,
                               const std::vector<glm::dvec3>& seen_from) {
    const Frame frame = renderer_.draw(moment, view, {.illuminance = true, .depth = true, .ids = true}),
                free = unshadowed_.draw(moment, view, {.illuminance = true});
    const Twin twin(scene_, false);
    const Beholder beholder(twin, moment, tolerance);
    ShadowTally tally;
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const double drawn = static_cast<double>(frame.illuminance_lx.at(x, y));
            if (!std::isfinite(drawn)) {
                ++tally.not_finite;
                tally.first_wrong = fmt::format("pixel {} {}: {}", x, y, drawn);
                continue;
            }
            std::vector<TwinPixel> places;
            for (const auto& [dx, dy] :
                 {std::pair(0.0, 0.0), std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(-1.0, 1.0), std::pair(1.0, 1.0)}) {
                places.push_back(twin.pixel(moment, view, x + 0.5 + dx * beside_centre_px, y + 0.5 + dy * beside_centre_px));
                if (places.back().id != frame.ids.at(x, y) || places.back().id == 0)
                    break;
            }
            if (places.back().id == 0 || places.front().illuminance_lx < 1e-4)
                continue;
            const bool ground = is_ground(scene_.materials[scene_.meshes[places.front().id - 1].batches.front().material].kind);
            const double depth_m = static_cast<double>(frame.depth_m.at(x, y));
            const bool same_place =
                std::abs(depth_m - places.front().depth_m) < 1e-3 * places.front().depth_m + 1e-4 &&
                std::ranges::all_of(places,
                                    [&](const TwinPixel& place) { return glm::dot(place.normal, places.front().normal) > 0.999; }) &&
                std::abs(static_cast<double>(free.illuminance_lx.at(x, y)) - places.front().illuminance_lx) <
                    of_free_light * places.front().illuminance_lx; // of two sides in one place the same
            if (places.back().id != frame.ids.at(x, y) || !same_place || (tolerance.ground_alone && !ground)) {
                ++tally.unsure;
                continue;
            }
            double least = 0.0, most = 0.0, unhidden = 0.0;
            bool any_hidden = false;
            for (std::size_t i = 0; i < moment.lamps.size(); ++i) {
                const LitLamp& lamp = moment.lamps[i];
                const TwinPixel& here = places.front();
                const glm::dvec3 lamp_m = lamp.pose.position_m - moment.ego.position_m, to_lamp = lamp_m - here.point_m;
                const double e = intensity_towards_cd(lamp, moment.ego.position_m + here.point_m) *
                                 std::max(0.0, photometry::incidence(here.normal, to_lamp)) / glm::dot(to_lamp, to_lamp);
                unhidden += e;
                if (!(e > 0.0))
                    continue;
                const Seen seen = beholder.sees(places, ground, lamp, seen_from.empty() ? lamp_m : seen_from[i] - moment.ego.position_m);
                least += seen == Seen::yes ? e : 0.0;
                most += seen == Seen::no ? 0.0 : e;
                any_hidden = any_hidden || seen == Seen::no;
            }
            if (least == 0.0 && most == unhidden) {
                ++tally.unsure;
                continue;
            }
            const bool acne = drawn<least - of_free_light * unhidden, leak = drawn> most + of_free_light * unhidden;
            ++(any_hidden ? tally.dark : tally.lit);
            if ((acne || leak) && tally.wrong() == 0)
                tally.first_wrong = fmt::format("pixel {} {} on {}, {:.3g} m away: {:.3g} lx for {:.3g} to {:.3g}", x, y,
                                                scene_.meshes[places.front().id - 1].name, places.front().depth_m, drawn, least, most);
            tally.acne += acne ? 1 : 0;
            tally.leaks += leak ? 1 : 0;
        }
    return tally;
}

void judge_tally(Found& worst, const ShadowTally& tally, const std::string& where, Tried tried) {
    const bool nothing = tried == Tried::either ? tally.lit + tally.dark == 0 : tally.lit == 0 || tally.dark == 0;
    worst.add(nothing ? std::numeric_limits<double>::quiet_NaN() : tally.wrong(), fmt::format("{}: {}", where, tally.text()),
              tally.lit + tally.dark);
}

ShadowSettings shadows_by(ShadowMethod method) {
    ShadowSettings settings;
    settings.method = method;
    return settings;
}

CandelaTable even_table(double half_width_deg, double half_height_deg) {
    CandelaTable table = constant_table(10000.0);
    table.h_deg = {-half_width_deg, half_width_deg};
    table.v_deg = {-half_height_deg, half_height_deg};
    return table;
}

void add_triangles(Scene& scene, const std::string& name, std::uint32_t material, const glm::dvec3& origin_m, const Triangles& triangles) {
    Mesh mesh{name, origin_m, {}, {}, {}};
    for (const std::array<glm::dvec3, 3>& t : triangles) {
        const glm::dvec3 across = glm::cross(t[1] - t[0], t[2] - t[0]);
        const glm::vec3 normal(glm::length(across) > 1e-12 ? glm::normalize(across) : glm::dvec3(0.0, 0.0, 1.0));
        for (const glm::dvec3& corner : t) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.push_back({glm::vec3(corner), normal});
        }
    }
    mesh.batches = {{material, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    scene.meshes.push_back(std::move(mesh));
}

Triangles box(const glm::dvec3& half_m, double yaw_rad) {
    const glm::dvec3 x = half_m.x * glm::dvec3(std::cos(yaw_rad), std::sin(yaw_rad), 0.0),
                     y = half_m.y * glm::dvec3(-std::sin(yaw_rad), std::cos(yaw_rad), 0.0), z(0.0, 0.0, half_m.z);
    Triangles triangles;
    const auto add_face = [&](const glm::dvec3& out, const glm::dvec3& a, const glm::dvec3& b) { // a x b along out
        triangles.push_back({out - a - b, out + a - b, out + a + b});
        triangles.push_back({out - a - b, out + a + b, out - a + b});
    };
    add_face(x, y, z);
    add_face(-x, z, y);
    add_face(y, z, x);
    add_face(-y, x, z);
    add_face(z, x, y);
    add_face(-z, y, x);
    return triangles;
}

Triangles turned_round(Triangles triangles) {
    for (std::array<glm::dvec3, 3>& t : triangles)
        std::swap(t[1], t[2]);
    return triangles;
}

} // namespace fernlicht::stability
