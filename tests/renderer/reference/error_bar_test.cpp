// Error bars are as wide as the errors: a bar too wide is as wrong as one too narrow.
#include "tests/renderer/reference/rooms.h"

#include "renderer/reference/embree_scene.h"
#include "renderer/reference/pixel_estimate.h"
#include "renderer/reference/sampling.h"

#include <atomic>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <tbb/global_control.h>

namespace fernlicht {
namespace {

struct Scores {
    std::vector<double> z; ///< (mean - truth) / error
    double bias = 0.0;     ///< (mean of the means - truth) / its standard error
};

/// For seeds 1 to 1000, of the middle one of a picture of nine pixels: how many samples it gets is for the most part decided by the others.
Scores scores(const Scene& scene, const Moment& moment, const View& view, ReferenceSettings settings, double truth) {
    const Reference reference(scene);
    Scores scores;
    std::vector<double> means;
    for (settings.seed = 1; settings.seed <= 1000; ++settings.seed) {
        const Estimate e = reference.render(moment, view, lux, settings).illuminance_lx;
        means.push_back(static_cast<double>(e.mean.at(1, 1)));
        scores.z.push_back((means.back() - truth) / static_cast<double>(e.standard_error.at(1, 1)));
    }
    const auto [mean, error] = reference::mean_of(means);
    scores.bias = (mean - truth) / error;
    return scores;
}

/// Chi-square over 20 bins that are equally probable for Student's t, scaled to variance 1; 19 degrees of freedom.
double chi_square_of_bins(const std::vector<double>& z, double freedom) {
    std::array<double, 20> count{};
    const boost::math::students_t student(freedom);
    for (const double score : z)
        count[std::min<std::size_t>(
            19, static_cast<std::size_t>(20.0 * boost::math::cdf(student, score * std::sqrt(freedom / (freedom - 2.0)))))] += 1.0;
    const double expected = static_cast<double>(z.size()) / 20.0;
    double sum = 0.0;
    for (const double c : count)
        sum += (c - expected) * (c - expected) / expected;
    return sum;
}

double sum_of_squares(const std::vector<double>& z) {
    double sum = 0.0;
    for (const double score : z)
        sum += score * score;
    return sum;
}

/// Both at 0.1 %: shape by bins (quantile 0.999 of chi-square with 19 degrees of freedom), width by the sum of squares (quantiles 0.0005
/// and 0.9995 with 1000 degrees of freedom, as if z were normal: Student's tails would allow more).
bool pass(const std::vector<double>& z, double freedom) {
    const double squares = sum_of_squares(z);
    return chi_square_of_bins(z, freedom) < 43.82 && squares > 859.4 && squares < 1153.7;
}

std::vector<double> times(std::vector<double> z, double factor) {
    for (double& score : z)
        score *= factor;
    return z;
}

constexpr double of_direct_light = 7.0, of_paths = 15.0; // degrees of freedom: 8 and 16 replicates

void expect_right(const Scores& scores, double freedom) {
    const auto& [z, bias] = scores;
    const std::string found =
        fmt::format("bins {:.1f}, sum of squares {:.0f}, bias {:.1f}", chi_square_of_bins(z, freedom), sum_of_squares(z), bias);
    testing::Test::RecordProperty("found", found); // docs/reference.md
    EXPECT_TRUE(pass(z, freedom)) << found;
    EXPECT_LT(std::abs(bias), 3.29) << found;
    EXPECT_FALSE(pass(times(z, 1.2), freedom)) << "the test would not see bars that are too narrow";
    EXPECT_FALSE(pass(times(z, 1.0 / 1.2), freedom)) << "the test would not see bars that are too wide";
}

TEST(ReferenceErrorBars, HoldUnderALamp) {
    Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 0.65}, 0, -90))}};
    const double lumen = 1000.0 * solid_angle({0, 0, 0.65}, {{1, 0.25, 0}, {1.5, 0.25, 0}, {1.5, 0.75, 0}, {1, 0.75, 0}});
    expect_right(scores(level_ground(20.0, lambert(0.2)), moment, map_about({1.25, 0.5}, 0.75, 3), ReferenceSettings{}, lumen / 0.25),
                 of_direct_light);
}

TEST(ReferenceErrorBars, HoldAcrossAShadowsEdge) {
    // A wall across at a slant, half as high as the lamp: the edge of its shadow is the wall's line, twice as far.
    Scene scene = level_ground(30.0, lambert(0.2));
    scene.materials.push_back(lambert(0.2, SurfaceKind::object));
    const glm::dvec3 a{3.5, -2.0, 0.0}, b{4.5, 2.0, 0.0}, up{0.0, 0.0, 1.0};
    scene.meshes.push_back(quads("wall", 1, {}, {{b, a, a + up, b + up}}));
    Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 2}, 0, 0))}};
    // The pixel is x = 7 to 8.5, y = -0.75 to 0.75; on the edge x = 8 + y / 4, and nearer by what rays to the lamp are raised, 4 to 1.
    const double x = 8.0 - 4.0 * reference::EmbreeScene::raised({}).z;
    const double lumen = 1000.0 * solid_angle({0, 0, 2}, {{x - 0.1875, -0.75, 0}, {8.5, -0.75, 0}, {8.5, 0.75, 0}, {x + 0.1875, 0.75, 0}});
    expect_right(scores(scene, moment, map_about({7.75, 0.0}, 2.25, 3), ReferenceSettings{}, lumen / 2.25), of_direct_light);
}

TEST(ReferenceErrorBars, HoldWhereLightBounces) {
    ReferenceSettings settings{.integrator = Integrator::path, .target_error = 0.02};
    expect_right(scores(plates(0.0, 0.0, 100.0), {}, map_about({0, 0}, 1.5, 3), settings, pi * 100.0 * plates_factor), of_paths);
}

TEST(ReferenceErrorBars, HoldInARoomWhereLightGoesOnAndOn) {
    Material wall = lambert(0.6, SurfaceKind::road, 1.0);
    ReferenceSettings settings{.integrator = Integrator::path, .target_error = 0.02};
    expect_right(
        scores(closed_room(wall), {}, camera({0.2, 0.1, -0.3}, 20, 10, 60, 3), settings, pi / (1.0 - static_cast<double>(wall.albedo.x))),
        of_paths);
}

TEST(ReferencePixels, LightThatIsNearlyLinearIsKnownByTheFirstSixteenSamples) {
    // 10 m below a lamp and 3 m beside its axis the light changes by 1.4 % over a pixel of 5 cm, which would make 16 independent samples
    // err by 0.1 %; its bend makes it 1e-5.
    const Scene ground = level_ground(20.0, lambert(0.2));
    const Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 10}, 0, -90))}};
    const ReferenceImage image = Reference(ground).render(moment, map_about({3.0, 0.0}, 0.4, 16), lux, {});
    for (std::size_t i = 0; i < image.samples.size(); ++i) {
        EXPECT_EQ(image.samples.pixels()[i], 16U);
        EXPECT_LT(image.illuminance_lx.standard_error.pixels()[i], 2e-5F * image.illuminance_lx.mean.pixels()[i]);
    }
}

TEST(ReferencePixels, FindASliverOfWhatANeighbourShows) {
    // The shadow of a wall across ends 1 % before the pixel does; 128 samples would miss the light once in four.
    Scene scene = level_ground(30.0, lambert(0.2));
    scene.materials.push_back(lambert(0.2, SurfaceKind::object));
    const glm::dvec3 a{4.0, -6.0, 0.0}, b{4.0, 6.0, 0.0}, up{0.0, 0.0, 1.0};
    scene.meshes.push_back(quads("wall", 1, {}, {{b, a, a + up, b + up}}));
    const Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 2}, 0, 0))}};
    const double truth = 1000.0 * solid_angle({0, 0, 2}, {{8.0, -0.75, 0}, {8.015, -0.75, 0}, {8.015, 0.75, 0}, {8.0, 0.75, 0}}) / 2.25;
    ReferenceSettings settings;
    for (settings.seed = 1; settings.seed <= 50; ++settings.seed) {
        const ReferenceImage image = Reference(scene).render(moment, map_about({8.015 - 0.75, 0.0}, 2.25, 3), lux, settings);
        EXPECT_NEAR(static_cast<double>(image.illuminance_lx.mean.at(1, 1)), truth, 0.1 * truth) << settings.seed;
    }
}

TEST(ReferenceErrorBars, AreStudentsWithVarianceOne) {
    std::array<double, 16> means{};
    for (std::size_t i = 0; i < 16; ++i)
        means[i] = i % 2 == 0 ? 4.0 : 6.0;
    const auto [mean, error] = reference::mean_of(means);
    EXPECT_DOUBLE_EQ(mean, 5.0);
    EXPECT_NEAR(error, std::sqrt(16.0 / (16.0 * 15.0) * 15.0 / 13.0), 1e-12); // each differs by 1 from the mean
    EXPECT_EQ(reference::samples_for(0.01, 0.005, 1.0, 1, 256), 8);           // 0.01 / sqrt(8) = 0.0035 < 0.00375
    EXPECT_EQ(reference::samples_for(0.01, 0.005, 2.0, 1, 256), 4);
    EXPECT_EQ(reference::samples_for(1.0, 0.005, 1.0, 1, 256), 256);
    EXPECT_EQ(reference::samples_for(0.0, 0.005, 1.0, 4, 256), 4);
}

TEST(ReferencePoints, AreNetsWithOnePointInEachElementaryInterval) {
    for (const std::uint64_t key : {1ULL, 99ULL, 123456789ULL})
        for (std::uint32_t pair = 0; pair < 3; ++pair)
            for (int across = 0; across <= 6; ++across) {
                std::set<std::pair<int, int>> taken;
                for (std::uint32_t i = 0; i < 64; ++i) {
                    const glm::dvec2 p = reference::PointNet(key).point(i, pair);
                    ASSERT_TRUE(p.x > 0.0 && p.x < 1.0 && p.y > 0.0 && p.y < 1.0);
                    taken.insert({static_cast<int>(p.x * (1 << across)), static_cast<int>(p.y * (64 >> across))});
                }
                EXPECT_EQ(taken.size(), 64U) << key << " " << pair << " " << across;
            }
}

TEST(ReferencePoints, OfDifferentKeysAreUniformAndIndependent) {
    // The first point of 6400 nets in 8 x 8 cells: chi-square with 63 degrees of freedom, quantile 0.999. So for pairs of neighbouring
    // keys.
    std::array<double, 64> alone{}, pairs{};
    for (std::uint64_t key = 0; key < 6400; ++key) {
        const glm::dvec2 p = reference::PointNet(reference::mixed(5, key)).point(0, 0),
                         q = reference::PointNet(reference::mixed(5, key + 1)).point(0, 0);
        alone[static_cast<std::size_t>(p.x * 8) * 8 + static_cast<std::size_t>(p.y * 8)] += 1.0;
        pairs[static_cast<std::size_t>(p.x * 8) * 8 + static_cast<std::size_t>(q.x * 8)] += 1.0;
    }
    for (const auto& counts : {alone, pairs}) {
        double sum = 0.0;
        for (const double c : counts)
            sum += (c - 100.0) * (c - 100.0) / 100.0;
        EXPECT_LT(sum, 103.4);
    }
}

TEST(ReferenceLanes, AnglesAreThoseOfTheLibrary) {
    reference::Lanes y{}, x{}, angle{};
    double worst = 0.0;
    for (std::uint32_t k = 0; k < 4000; ++k) {
        for (std::size_t i = 0; i < reference::packet_size; ++i) {
            const glm::dvec2 p = reference::PointNet(3).point(16 * k + static_cast<std::uint32_t>(i), 0);
            const double turn = 2.0 * pi * p.x, length = std::pow(10.0, 12.0 * p.y - 6.0);
            y[i] = length * std::sin(turn), x[i] = length * std::cos(turn) * (i % 4 == 0 ? 1e-9 : 1.0);
        }
        reference::angles(y, x, angle);
        for (std::size_t i = 0; i < reference::packet_size; ++i)
            worst = std::max(worst, std::abs(angle[i] - std::atan2(y[i], x[i])));
    }
    EXPECT_LT(worst, 1e-15); // two units in the last place of pi
    y = {0.0, 0.0, 1.0, -1.0, 0.0, 1.0};
    x = {0.0, 1.0, 0.0, 0.0, -1.0, 1.0};
    reference::angles(y, x, angle);
    const std::array<double, 6> truth{0.0, 0.0, 0.5 * pi, -0.5 * pi, pi, 0.25 * pi};
    for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_DOUBLE_EQ(angle[i], truth[i]) << i;
}

/// Embree looks at the rays of idle lanes too: Debian's asserts that all are finite.
TEST(ReferenceLanes, IdleOnesMayHoldAnything) {
    const Scene room = closed_room(lambert(0.5));
    const reference::EmbreeScene embree(room, {0, 0, 0});
    for (const double anything : {0.0, 1e306, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        std::array<Ray, reference::packet_size> rays;
        std::array<glm::dvec3, reference::packet_size> from_m, to_m;
        rays.fill({glm::dvec3(anything), glm::dvec3(anything)}), from_m.fill(glm::dvec3(anything)), to_m.fill(glm::dvec3(-anything));
        rays[3] = {glm::dvec3(0.0), {1, 0, 0}}, from_m[3] = {0, 0, 0}, to_m[3] = {0.1, 0, 0};
        std::array<reference::SurfaceHit, reference::packet_size> hits;
        EXPECT_EQ(embree.cast(rays, 1U << 3U, false, hits), 1U << 3U) << anything;
        EXPECT_EQ(embree.visible(from_m, to_m, 1U << 3U), 1U << 3U) << anything;
    }
}

/// All but the times.
void expect_same_bytes(const ReferenceImage& a, const ReferenceImage& b) {
    EXPECT_EQ(a.illuminance_lx.mean, b.illuminance_lx.mean);
    EXPECT_EQ(a.illuminance_lx.standard_error, b.illuminance_lx.standard_error);
    EXPECT_EQ(a.luminance_cdm2.mean, b.luminance_cdm2.mean);
    EXPECT_EQ(a.target_lx.mean, b.target_lx.mean);
    EXPECT_EQ(std::tuple(a.ids, a.samples, a.mixed, a.rays), std::tuple(b.ids, b.samples, b.mixed, b.rays));
}

struct Room {
    Scene scene = closed_room(lambert(0.5));
    Moment moment;
    View view = camera({0, 0, 0}, 30, 10, 70, 34);
    ReferenceSettings settings;

    Room() {
        moment.lamps = {even_lamp(10.0, looking({0.3, -0.2, 0.1}, 40, 30))};
        settings.integrator = Integrator::path;
        settings.target_error = 0.1;
    }
};

TEST(ReferenceBytes, AreTheSameForAnyNumberOfThreads) {
    const Room room;
    const auto drawn = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return Reference(room.scene).render(room.moment, room.view, everything, room.settings);
    };
    const ReferenceImage one = drawn(1);
    expect_same_bytes(one, drawn(2));
    expect_same_bytes(one, drawn(7));
    ReferenceSettings other = room.settings;
    other.seed = 2;
    EXPECT_NE(Reference(room.scene).render(room.moment, room.view, everything, other).illuminance_lx.mean, one.illuminance_lx.mean);
}

TEST(ReferenceBytes, AreTheSameWhenAPictureIsGoneOnWith) {
    const Room room;
    const Reference reference(room.scene);
    const ReferenceImage whole = reference.render(room.moment, room.view, everything, room.settings);
    EXPECT_TRUE(whole.complete);
    ReferenceImage part;
    int calls = 0;
    while (part.samples.empty() || !part.complete) {
        const std::size_t before = part.samples.size() - static_cast<std::size_t>(std::ranges::count(part.samples.pixels(), 0U));
        part = reference.render(
            room.moment, room.view, everything, room.settings,
            [&](const ReferenceImage&, std::size_t done) {
                EXPECT_GT(done, before);
                ++calls;
                return false;
            },
            std::move(part));
    }
    EXPECT_GE(calls, 1);
    expect_same_bytes(whole, part);
    EXPECT_THROW(reference.render(room.moment, camera({0, 0, 0}, 0, 0, 60, 5), everything, room.settings, {}, part), std::invalid_argument);
}

TEST(ReferenceBytes, AreTheSameWhenStoppedInTheMiddleOfATile) {
    const Room room;
    const Reference reference(room.scene);
    const ReferenceImage whole = reference.render(room.moment, room.view, everything, room.settings);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    int questions = 0;
    constexpr int answered_no = 5000; // a tile takes 12 a pixel and more: the first is drawn, the second begun
    const auto stop = [&] { return ++questions > answered_no; };
    ReferenceImage part = reference.render(room.moment, room.view, everything, room.settings, {}, {}, stop);
    EXPECT_FALSE(part.complete);
    EXPECT_LT(questions, answered_no + 20); // each of the 9 tiles asks once more and is left
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < part.samples.size(); ++i) {
        const bool is_drawn = part.samples.pixels()[i] != 0;
        drawn += is_drawn ? 1U : 0U;
        EXPECT_EQ(part.illuminance_lx.mean.pixels()[i], is_drawn ? whole.illuminance_lx.mean.pixels()[i] : 0.0F);
        EXPECT_EQ(part.ids.pixels()[i], is_drawn ? whole.ids.pixels()[i] : 0U);
    }
    EXPECT_GT(drawn, 0U);
    EXPECT_LT(drawn, part.samples.size());
    part = reference.render(room.moment, room.view, everything, room.settings, {}, std::move(part));
    EXPECT_TRUE(part.complete);
    expect_same_bytes(whole, part);
}

TEST(ReferenceBytes, AreNoneWhenStoppedWhileTheLightIsSolved) {
    Room room;
    room.settings.solver.photons = 1 << 22; // seconds, were it not stopped
    room.settings.solver.form_factor_rays = 1 << 16;
    for (const Integrator integrator : {Integrator::radiosity, Integrator::photon_map}) {
        room.settings.integrator = integrator;
        std::atomic<int> questions = 0;
        int told = 0;
        const ReferenceImage image = Reference(room.scene)
                                         .render(
                                             room.moment, room.view, everything, room.settings,
                                             [&](const ReferenceImage&, std::size_t done) {
                                                 ++told;
                                                 EXPECT_EQ(done, 0U);
                                                 return false;
                                             },
                                             {}, [&] { return ++questions > 3; });
        EXPECT_FALSE(image.complete);
        EXPECT_EQ(image.rays, 0U);
        EXPECT_EQ(told, 1); // so that a checkpoint can be written
        EXPECT_LT(questions, 100);
    }
}

} // namespace
} // namespace fernlicht
