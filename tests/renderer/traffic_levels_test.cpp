// How coarsely pairs of lamps are drawn: the error is bounded, by shares of levels and by what merging two beams does.
#include "renderer/traffic_levels.h"

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

TEST(TrafficLevels, SharesAddUpToOneAndRunWithoutSteps) {
    for (const bool pair : {false, true})
        for (const bool interpolated : {false, true})
            for (double b = 0.0; b < 6.0; b += 0.01)
                for (double m = 0.0; m <= 6.0; m += 0.5) {
                    const TrafficShare s = traffic_share(b, m, 1.0, pair, interpolated),
                                       next = traffic_share(b + 0.01, m + 0.01, 1.0, pair, interpolated);
                    EXPECT_NEAR(s.each + s.merged + s.by_vertex + s.point, 1.0, 1e-12);
                    for (const double change :
                         {next.each - s.each, next.merged - s.merged, next.by_vertex - s.by_vertex, next.point - s.point})
                        EXPECT_LT(std::abs(change), 0.031) << b << " " << m;
                }
}

TEST(TrafficLevels, NoShareIsOffByMoreThanTheWorst) {
    double worst = 0.0;
    for (const bool pair : {false, true})
        for (const bool interpolated : {false, true})
            for (double b = 0.0; b < 20.0; b += 0.01)
                for (double m = 0.0; m <= (pair ? std::min(2.0 * b, 6.0) : 0.0); m += 0.02)
                    worst = std::max(worst, traffic_error_lx(traffic_share(b, m, 1.0, pair, interpolated), b, m, 1.0));
    EXPECT_LE(worst, worst_traffic_error + 1e-9);
    EXPECT_GT(worst, worst_traffic_error - 0.01) << "the bound is met";
}

double looked_up_cd(const BeamTexture& t, const glm::dvec3& w) {
    const glm::dvec2 angles(std::atan2(w.x, w.z), std::atan2(w.y, std::hypot(w.x, w.z)));
    const glm::dvec2 at = photometry::beam_position(angles, {t.h_first_rad, t.v_first_rad, 1.0 / t.h_step_rad, 1.0 / t.v_step_rad});
    if (photometry::beam_known(at, {t.width, t.height}) == 0.0)
        return 0.0;
    const glm::ivec2 base(std::min(static_cast<int>(at.x), t.width - 2), std::min(static_cast<int>(at.y), t.height - 2));
    const auto cd = [&](int x, int y) {
        return static_cast<double>(t.cd[static_cast<std::size_t>(y) * static_cast<std::size_t>(t.width) + static_cast<std::size_t>(x)]);
    };
    return photometry::bilinear(cd(base.x, base.y), cd(base.x + 1, base.y), cd(base.x, base.y + 1), cd(base.x + 1, base.y + 1),
                                at - glm::dvec2(base));
}

/// Random receivers before random pairs, in double: the bound holds for each, and is not far off for some.
TEST(TrafficLevels, MergingIsOffByNoMoreThanItsBound) {
    for (const char* name : {"halogen-low", "xenon-low"}) {
        const LampFile file = read_lamp(std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/") + name + ".ies");
        const BeamTexture texture = make_beam_texture(file.table);
        const TrafficBeam beam(texture);
        std::mt19937_64 random(7);
        const auto between = [&](double a, double b) { return a + (b - a) * std::uniform_real_distribution<double>()(random); };
        double worst = 0.0, min_share = 1.0;
        for (int i = 0; i < 200'000; ++i) {
            const double d = std::exp(between(std::log(4.0), std::log(400.0)));
            const double h = radians(between(-30.0, 30.0)), v = radians(i % 3 == 0 ? between(-12.0, 6.0) : between(-2.0, 0.5));
            const glm::dvec3 at = d * glm::dvec3(std::sin(h) * std::cos(v), std::sin(v), std::cos(h) * std::cos(v));
            const glm::dvec3 half(between(0.05, 0.9), between(-0.05, 0.05), between(-0.05, 0.05));
            glm::dvec3 n = glm::normalize(glm::dvec3(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)));
            if (glm::dot(n, at) > 0.0)
                n = -n;
            const auto lx = [&](const glm::dvec3& from, double factor) {
                const glm::dvec3 to = at - from;
                const double r = glm::length(to);
                return factor * looked_up_cd(texture, to) * std::max(0.0, -glm::dot(n, to) / r) / (r * r);
            };
            const double off = std::abs(lx(half, 0.5) + lx(-half, 0.5) - lx({}, 1.0));
            const double near = d - glm::length(half), lx_a_cd = 1.0 / (near * near);
            const BeamWindow window{h, h, v, v};
            // E_midway <= max_lx must hold, and does for the brightest direction between the lamps.
            const double a = glm::length(half) / near, most = lx_a_cd * beam.max_cd({h - 1.5 * a, h + 1.5 * a, v - a, v + a});
            const double bound = beam.merging_lx(glm::length(half) / near, std::abs(half.y) / near, window, lx_a_cd, most);
            EXPECT_LE(off, bound * (1.0 + 1e-9) + 1e-12) << name << " " << d << " m, " << h << " " << v;
            worst = std::max(worst, off > 0.0 ? off / bound : 0.0);
            min_share = std::min(min_share, most > 0.0 ? bound / most : 1.0);
        }
        EXPECT_GT(worst, 0.2) << "the bound is of the error's size";
        EXPECT_LT(min_share, 0.05) << "and far lamps merge";
    }
}

TEST(TrafficLevels, NothingIsBrighterThanTheMostOfItsWindow) {
    const LampFile file = read_lamp(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies");
    const BeamTexture texture = make_beam_texture(file.table);
    const TrafficBeam beam(texture);
    EXPECT_NEAR(beam.max_cd() / static_cast<double>(*std::ranges::max_element(texture.cd)), 1.0, 1e-7);
    std::mt19937_64 random(3);
    const auto between = [&](double a, double b) { return a + (b - a) * std::uniform_real_distribution<double>()(random); };
    for (int i = 0; i < 20'000; ++i) {
        const double h = radians(between(-60.0, 60.0)), v = radians(between(-20.0, 20.0)), size = radians(between(0.0, 3.0));
        const double inside_h = h + between(0.0, size), inside_v = v + between(0.0, size);
        const glm::dvec3 w(std::sin(inside_h) * std::cos(inside_v), std::sin(inside_v), std::cos(inside_h) * std::cos(inside_v));
        EXPECT_LE(looked_up_cd(texture, w), beam.max_cd({h, h + size, v, v + size}) * (1.0 + 1e-9));
    }
}

} // namespace
} // namespace fernlicht
