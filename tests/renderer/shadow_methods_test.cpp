// Shadow methods that draw depth maps: where edges lie, that nothing shades itself, and that the bytes do not depend on what is left out.
#include "renderer/reference/reference.h"
#include "tests/renderer/shadow_scene.h"

#include <numeric>

namespace fernlicht {
namespace {

using namespace tests;

/// The same light everywhere within 30 degrees to the sides, 8 up and 14 down.
std::shared_ptr<const LampFile> evenly_bright() {
    return file_of(table_of(steps(-30.0, 30.0, 1.0), steps(-14.0, 8.0, 1.0), [](double, double) { return 10000.0; }));
}

void add_sheet(Scene& scene, const char* name, std::uint32_t material, const glm::dvec3& at, const glm::vec3& a, const glm::vec3& b) {
    Mesh mesh{name, at, {}, {}, {}};
    add_flat(mesh, material, {}, a, a + b, b);
    scene.meshes.push_back(std::move(mesh));
}

/// Of a width, upright, facing the car; its left side at y.
struct Post {
    double x = 0.0, y = 0.0, width = 0.3, height = 1.5;
};

/// A road, posts, and a wall across the road.
Scene road_with(const std::vector<Post>& posts, double wall_x = 0.0) {
    Scene scene{.materials = {{"road", SurfaceKind::road, glm::vec3(0.1F)}, {"board", SurfaceKind::board, glm::vec3(0.4F)}}};
    add_sheet(scene, "road", 0, {-5.0, -30.0, 0.0}, {300.0F, 0.0F, 0.0F}, {0.0F, 60.0F, 0.0F});
    for (const Post& post : posts)
        add_sheet(scene, "post", 1, {post.x, post.y, 0.0}, {0.0F, static_cast<float>(-post.width), 0.0F},
                  {0.0F, 0.0F, static_cast<float>(post.height)});
    if (wall_x > 0.0)
        add_sheet(scene, "wall", 1, {wall_x, 20.0, 0.0}, {0.0F, -40.0F, 0.0F}, {0.0F, 0.0F, 4.0F});
    return scene;
}

/// A road in waves, whose crests the light grazes: crests shade what lies behind them, and must not shade themselves.
Scene road_in_waves(double height_m, double length_m) {
    Scene scene{.materials = {{"road", SurfaceKind::road, glm::vec3(0.1F)}}};
    Mesh mesh{"waves", {0.0, 0.0, 0.0}, {}, {}, {}};
    const double k = 2.0 * pi / length_m;
    for (int i = 0; i <= 200; ++i) {
        const double x = -5.0 + i, z = 0.5 * height_m * (std::cos(k * x) - 1.0);
        const glm::vec3 normal(glm::normalize(glm::dvec3(0.5 * height_m * k * std::sin(k * x), 0.0, 1.0)));
        for (const double y : {-4.0, 4.0})
            mesh.vertices.push_back({glm::vec3(glm::dvec3(x, y, z)), normal, {}});
        const auto a = static_cast<std::uint32_t>(2 * i);
        if (i < 200)
            mesh.indices.insert(mesh.indices.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
    }
    mesh.batches = {{0, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

constexpr double lamp_x = 2.2, lamp_z = 0.65;

ShadowSettings method(ShadowMethod which) { return {.method = which}; }

Moment with_lamps(const std::vector<double>& sides) {
    Moment moment;
    const auto file = evenly_bright();
    for (std::size_t i = 0; i < sides.size(); ++i)
        moment.lamps.push_back(
            {.name = i == 0 ? "left" : "right", .file = file, .pose = {{lamp_x, sides[i], lamp_z}, axes_from_angles(0.0, -0.01, 0.0)}});
    return moment;
}

/// Where the edge of the shadow of something at (x, y) lies at `at_x`, of light from a place at `side`.
double shadow_y(double side, double x, double y, double at_x, double from_x = lamp_x) {
    return side + (y - side) * (at_x - from_x) / (x - from_x);
}

class ShadowMethodTest : public DeviceTest {
  protected:
    Frame draw(const Scene& scene, const Moment& moment, const View& view, const ShadowSettings& shadows,
               const char* technique = "photometric", const FrameOutputs& outputs = {.illuminance = true}) {
        RendererSettings settings{.technique = technique, .shadows = shadows};
        settings.tone_mapper.l_max_cdm2 = 20.0;
        Renderer renderer(device_, scene, settings);
        return renderer.draw(moment, view, outputs);
    }

    /// On the road in the row of the picture nearest to x: y where the lamp's share is one half, nearest to `about`.
    static double edge(const Frame& drawn, const Frame& free, const Moment& moment, const View& view, double x, double about) {
        const Camera camera = camera_of(moment, view);
        const auto on_road = [&](double px, double py) {
            const Ray ray = pixel_ray(camera, view, px, py);
            return ray.origin_m - ray.direction * (ray.origin_m.z / ray.direction.z);
        };
        int row = 0;
        double nearest = 1e9;
        for (int py = 0; py < view.height_px; ++py) {
            const glm::dvec3 p = on_road(0.5 * view.width_px, py + 0.5);
            if (p.x > 0.0 && std::abs(p.x - x) < nearest) {
                nearest = std::abs(p.x - x);
                row = py;
            }
        }
        double best = 1e9;
        const auto share = [&](int px) {
            const double f = static_cast<double>(free.illuminance_lx.at(px, row));
            return f > 0.0 ? static_cast<double>(drawn.illuminance_lx.at(px, row)) / f : 1.0;
        };
        for (int px = 0; px + 1 < view.width_px; ++px) {
            const double a = share(px) - 0.5, b = share(px + 1) - 0.5;
            if ((a < 0.0) == (b < 0.0))
                continue;
            const double y = on_road(px + 0.5 + a / (a - b), row + 0.5).y;
            if (std::abs(y - about) < std::abs(best - about))
                best = y;
        }
        return best;
    }
};

class MapMethods : public ShadowMethodTest, public testing::WithParamInterface<ShadowMethod> {};

TEST_P(MapMethods, PrunedAndUnprunedGiveTheSameBytesTwice) {
    const Scene scene = road_with({{12.0, 0.4}, {25.0, -2.0, 0.1, 3.0}, {60.0, 1.0, 0.5}}, 120.0);
    Moment moment = with_lamps({0.6, -0.6});
    for (const bool one_is_off : {false, true}) {
        moment.lamps.back().intensity_factor = one_is_off ? 0.0 : 1.0;
        for (const double ahead : {1.5, -8.0}) {
            View view = driver_view(160, 120);
            view.position_m.x = ahead;
            const Frame a = draw(scene, moment, view, method(GetParam()), "photometric", all_results);
            for (const char* technique : {"photometric", "photometric-unpruned"}) {
                const Frame b = draw(scene, moment, view, method(GetParam()), technique, all_results);
                expect_same_frames(a, b, technique);
            }
        }
    }
}

/// One lamp, so that each method has the same truth: rays.
TEST_P(MapMethods, NothingShadesItselfAndNothingLeaks) {
    const Scene posts = road_with({{8.0, 0.9}, {25.0, -1.0}, {60.0, 2.0, 0.8}}, 110.0), waves = road_in_waves(2.0, 60.0);
    const Moment moment = with_lamps({0.6});
    for (const auto& [of, from_beside] :
         {std::pair(&posts, false), std::pair(&posts, true), std::pair(&waves, false), std::pair(&waves, true)}) {
        const Scene& scene = *of;
        View view = driver_view(200, 150);
        if (of == &waves) {
            view.position_m = {from_beside ? -8.0 : 1.5, 0.35, 4.0}; // over the crests
            view.pitch_rad = radians(-6.0);
        } else if (from_beside) {
            view.position_m = {15.0, 14.0, 4.0};
            view.yaw_rad = radians(-70.0);
            view.pitch_rad = radians(-12.0);
            view.vertical_fov_rad = radians(50.0);
        }
        const Frame drawn = draw(scene, moment, view, method(GetParam()));
        const Twin lit(scene, false), shaded(scene, true);
        int dark = 0, total = 0, wrong = 0;
        for (const auto& [x, y] : each_pixel(view, 1)) {
            const TwinPixel pixel = lit.pixel(moment, view, x + 0.5, y + 0.5);
            const double free = pixel.illuminance_lx;
            if (pixel.id == 0 || free < 0.01)
                continue;
            const auto is_dark = [&](const glm::dvec3& offset) {
                const glm::dvec3 from = pixel.point_m + offset, way = moment.lamps[0].pose.position_m - from;
                const auto hit = lit.cast(moment, {from, glm::normalize(way)}, 1e-4, Twin::Met::casters);
                return hit && hit->distance_m < glm::length(way);
            };
            // Beyond doubt: two texels to each side, and up to twice the height that a look-up is raised by.
            const glm::dvec3 way = moment.lamps[0].pose.position_m - pixel.point_m;
            const double texel = glm::length(way) * 2.0 * std::tan(radians(30.0)) / 1022.0, raise = std::max(0.03, 1.5 * texel);
            const glm::dvec3 across = glm::normalize(glm::cross(way, glm::dvec3(0.0, 0.0, 1.0)));
            const glm::dvec3 up = glm::normalize(glm::cross(across, way));
            const bool truth = is_dark(1e-3 * pixel.normal);
            bool sure = true;
            for (const glm::dvec3& offset : {raise * pixel.normal, 2.0 * raise * pixel.normal, raise * pixel.normal + 2.0 * texel * across,
                                             raise * pixel.normal - 2.0 * texel * across, raise * pixel.normal + 2.0 * texel * up,
                                             raise * pixel.normal - 2.0 * texel * up})
                sure = sure && is_dark(offset) == truth;
            if (!sure)
                continue;
            ++total;
            dark += truth ? 1 : 0;
            wrong += (static_cast<double>(drawn.illuminance_lx.at(x, y)) < 0.5 * free) != truth ? 1 : 0;
        }
        EXPECT_GT(dark, 50) << from_beside << " " << scene.meshes[0].name;
        EXPECT_GT(total, 500) << from_beside << " " << scene.meshes[0].name;
        EXPECT_EQ(wrong, 0) << from_beside << " " << scene.meshes[0].name << ": " << dark << " dark of " << total;
    }
}

TEST_P(MapMethods, EdgesLieWhereRaysSayWithinATexel) {
    const Moment moment = with_lamps({0.6});
    const View view = driver_view(1600, 1200);
    for (const auto& [x, at] : {std::pair(5.0, 10.0), std::pair(20.0, 30.0), std::pair(60.0, 80.0)}) {
        const Post post{x, -0.1, 0.3}; // its other side's shadow lies behind it
        const Scene scene = road_with({post});
        const Frame free = draw(scene, moment, view, method(ShadowMethod::none)), drawn = draw(scene, moment, view, method(GetParam()));
        const double texel_m = (at - lamp_x) * 2.0 * std::tan(radians(30.0)) / 1022.0;
        const double truth = shadow_y(0.6, x, post.y - post.width, at), found = edge(drawn, free, moment, view, at, truth);
        EXPECT_NEAR(found, truth, texel_m + 0.01) << x << " m, " << at << " m";
    }
}

/// What is low throws a shadow as long as it should, and light passes below what hangs low: over many places of the caster among a map's
/// texels the ground behind it has as much light as rays say.
TEST_P(MapMethods, LowBodiesShadeLevelGroundAsFarAsRaysSay) {
    const Moment moment = with_lamps({0.6});
    const View behind = map_view(95.0, -31.5, 4.0, 32, 254);
    struct Board {
        float bottom, top; ///< m
    };
    for (const Board board : {Board{0.0F, 0.12F}, Board{0.0F, 0.4F}, Board{0.3F, 0.6F}}) {
        double free = 0.0, drawn = 0.0, right = 0.0;
        for (int k = 0; k < 12; ++k) {
            Scene scene = road_with({});
            add_sheet(scene, "board", 1, {30.0 + 0.11 * k, 20.0, board.bottom}, {0.0F, -40.0F, 0.0F},
                      {0.0F, 0.0F, board.top - board.bottom});
            const auto sum = [](const Image<float>& lux) { return std::accumulate(lux.pixels().begin(), lux.pixels().end(), 0.0); };
            ShadowSettings by = method(GetParam());
            by.lamp_places = 1;
            free += sum(draw(scene, moment, behind, method(ShadowMethod::none)).illuminance_lx);
            drawn += sum(draw(scene, moment, behind, by).illuminance_lx);
            right +=
                sum(Reference(scene).render(moment, behind, {.illuminance = true}, {.footprint = Footprint::centre}).illuminance_lx.mean);
        }
        EXPECT_GT(free - right, 0.05 * free);
        EXPECT_NEAR((free - drawn) / (free - right), 1.0, 0.05) << board.bottom << " to " << board.top << " m";
    }
}

/// Targets above the ground are not raised, so that ground must hide them from where it is.
TEST_P(MapMethods, CrestsHideTargetsAsFarAsRaysSay) {
    const Moment moment = with_lamps({0.6});
    const View behind = map_view(90.0, -20.0, 3.0, 12, 280);
    for (const LightPass pass : {LightPass::shader, LightPass::cpu}) {
        if (pass == LightPass::cpu && !device_.info().software)
            continue;
        double free = 0.0, drawn = 0.0, right = 0.0;
        for (int k = 0; k < 6; ++k) {
            const Scene scene = road_in_waves(1.0 + 0.05 * k, 42.0 + k);
            const auto sum = [](const Image<float>& lux) { return std::accumulate(lux.pixels().begin(), lux.pixels().end(), 0.0); };
            RendererSettings settings{.shadows = method(GetParam()), .light_pass = pass};
            settings.shadows.lamp_places = 1;
            drawn += sum(Renderer(device_, scene, settings).draw(moment, behind, {.illuminance = true, .target = true}).target_lx);
            settings.shadows.method = ShadowMethod::none;
            free += sum(Renderer(device_, scene, settings).draw(moment, behind, {.illuminance = true, .target = true}).target_lx);
            right += sum(Reference(scene).render(moment, behind, {.target = true}, {.footprint = Footprint::centre}).target_lx.mean);
        }
        EXPECT_GT(free - right, 0.1 * free);
        EXPECT_NEAR((free - drawn) / (free - right), 1.0, 0.02) << light_pass_name(pass);
    }
}

std::string method_test_name(const testing::TestParamInfo<ShadowMethod>& one) {
    std::string text(name(one.param));
    std::erase(text, '-');
    return text;
}
INSTANTIATE_TEST_SUITE_P(All, MapMethods,
                         testing::Values(ShadowMethod::map, ShadowMethod::one_map, ShadowMethod::perspective_map,
                                         ShadowMethod::light_space_map, ShadowMethod::soft_map),
                         method_test_name);

/// Both lamps' shadows fall as from midway: the edge lies (z / z_c - 1) times the lamp's distance from midway beside its own.
TEST_F(ShadowMethodTest, OneMapForAllErrsByTheParallaxFromMidway) {
    const View above = map_view(24.0, -16.0, 3.0, 1200, 160);
    const Post post{12.0, 0.2, 0.4};
    const Scene scene = road_with({post});
    Moment moment = with_lamps({0.6, -0.6});
    const double at = 20.0, between = shadow_y(0.0, post.x, post.y, at), left = shadow_y(0.6, post.x, post.y, at);
    EXPECT_NEAR(between - left, 0.6 * ((at - lamp_x) / (post.x - lamp_x) - 1.0), 1e-9);
    EXPECT_GT(between - left, 0.4);
    const auto found = [&](ShadowMethod which, double about) {
        return edge(draw(scene, moment, above, method(which)), draw(scene, moment, above, method(ShadowMethod::none)), moment, above, at,
                    about);
    };
    EXPECT_NEAR(found(ShadowMethod::one_map, between), between, 0.03);
    moment.lamps.back().intensity_factor = 0.0;
    EXPECT_NEAR(found(ShadowMethod::one_map, left), left, 0.03) << "with one lamp on, midway is that lamp";
    EXPECT_NEAR(found(ShadowMethod::map, left), left, 0.03);
}

/// A strip of road across the edge of a shadow, 4 mm a pixel.
View strip_at(double x, double y, int width_px) {
    return {.projection = Projection::map,
            .width_px = width_px,
            .height_px = 4,
            .map_ahead_m = x + 0.1,
            .map_behind_m = -(x - 0.1),
            .map_left_m = y + 0.002 * width_px,
            .map_right_m = -(y - 0.002 * width_px)};
}

/// Share of a disc on one side of a chord at u radii from its centre.
double disc_share(double u) {
    const double c = std::clamp(u, -1.0, 1.0);
    return 0.5 + (c * std::sqrt(1.0 - c * c) + std::asin(c)) / pi;
}

struct Penumbra {
    double rms = 0.0, width_error_m = 0.0; ///< of the share seen; of the 10 to 90 % width
};

double width_of(const std::vector<double>& share, double pixel_m) {
    const auto crossing = [&](double level) {
        for (std::size_t i = 0; i + 1 < share.size(); ++i)
            if ((share[i] < level) != (share[i + 1] < level))
                return static_cast<double>(i) + (level - share[i]) / (share[i + 1] - share[i]);
        return 0.0;
    };
    return std::abs(crossing(0.9) - crossing(0.1)) * pixel_m;
}

TEST_F(ShadowMethodTest, PenumbraeConvergeToTheReferenceOfADisc) {
    const Post post{6.0, -0.1, 0.3};
    const Scene scene = road_with({post});
    const Moment moment = with_lamps({0.6});
    constexpr double at = 14.0, radius = 0.06, z_post = 6.0 - lamp_x, z = at - lamp_x;
    const double about = shadow_y(0.6, post.x, post.y - post.width, at);
    const View view = strip_at(at, about, 240);
    const FrameOutputs outputs{.illuminance = true};
    ReferenceSettings rays{.footprint = Footprint::centre, .target_error = 0.002, .min_samples = 1024, .lamp_radius_m = radius};
    const Reference reference(scene);
    const ReferenceImage shaded = reference.render(moment, view, outputs, rays);
    rays.shadows = false;
    const ReferenceImage free = reference.render(moment, view, outputs, rays);
    std::vector<double> truth;
    for (int px = 0; px < view.width_px; ++px)
        truth.push_back(static_cast<double>(shaded.illuminance_lx.mean.at(px, 2)) /
                        static_cast<double>(free.illuminance_lx.mean.at(px, 2)));
    // The reference itself, against the area of a disc that an upright edge leaves: half the penumbra is radius (z / z_c - 1) wide.
    const Camera camera = camera_of(moment, view);
    for (int px = 0; px < view.width_px; ++px) {
        const double y = pixel_ray(camera, view, px + 0.5, 2.5).origin_m.y, x = pixel_ray(camera, view, px + 0.5, 2.5).origin_m.x;
        const double edge_y = shadow_y(0.6, post.x, post.y - post.width, x), half = radius * ((x - lamp_x) / z_post - 1.0);
        EXPECT_NEAR(truth[static_cast<std::size_t>(px)], disc_share((edge_y - y) / half), 0.02) << px;
    }
    const Frame unshaded = draw(scene, moment, view, method(ShadowMethod::none));
    const auto penumbra = [&](const ShadowSettings& settings) {
        const Frame frame = draw(scene, moment, view, settings);
        std::vector<double> share;
        Penumbra p;
        for (int px = 0; px < view.width_px; ++px) {
            share.push_back(static_cast<double>(frame.illuminance_lx.at(px, 2)) / static_cast<double>(unshaded.illuminance_lx.at(px, 2)));
            p.rms += std::pow(share.back() - truth[static_cast<std::size_t>(px)], 2) / view.width_px;
        }
        p.rms = std::sqrt(p.rms);
        p.width_error_m = width_of(share, 0.004) - width_of(truth, 0.004);
        return p;
    };
    const Penumbra hard = penumbra(method(ShadowMethod::map));
    EXPECT_NEAR(width_of(truth, 0.004), 1.374 * radius * (z / z_post - 1.0), 0.01); // a disc's 10 to 90 %: 2 * 0.687 radii
    EXPECT_GT(hard.rms, 0.05);
    EXPECT_LT(hard.width_error_m, -0.1);
    double before = 1.0;
    for (const int places : {1, 4, 16, 64}) {
        ShadowSettings settings = method(ShadowMethod::soft_map);
        settings.lamp_radius_m = radius;
        settings.lamp_places = places;
        const Penumbra p = penumbra(settings);
        EXPECT_LT(p.rms, before);
        before = 1.05 * p.rms;
        if (places == 1) { // a single place is the lamp's middle
            EXPECT_NEAR(p.rms, hard.rms, 0.02);
        }
        if (places == 16) {
            EXPECT_LT(p.rms, 0.04);
            EXPECT_LT(std::abs(p.width_error_m), 0.02);
        }
    }
    EXPECT_LT(before, 0.03);
}

/// A lamp that creeps ahead and aside, and turns a little: maps are drawn again only beyond the bound, and edges stay within it.
TEST_F(ShadowMethodTest, KeptMapsStayWithinTheirBound) {
    const Post post{20.0, -1.0, 0.4};
    const Scene scene = road_with({post});
    constexpr double at = 40.0, texel = 2.0 * 0.5773502691896257 / 1022.0;
    for (const double bound : {0.0, 2.0}) {
        RendererSettings settings;
        settings.shadows.redraw_texels = bound;
        Renderer renderer(device_, scene, settings);
        settings.shadows.method = ShadowMethod::none;
        Renderer without(device_, scene, settings);
        int drawn = 0;
        double worst_texels = 0.0, moved = 0.0;
        for (int tick = 0; tick < 40; ++tick) {
            Moment moment = with_lamps({0.6});
            Pose& pose = moment.lamps[0].pose;
            const double side = 0.6 + 0.004 * tick;
            moved = 0.01 * tick;
            moment.ego.position_m.x = moved;
            pose.position_m = {lamp_x + moved, side, lamp_z};
            pose.axes = axes_from_angles(0.0002 * (tick % 3), -0.01, 0.0);
            const double truth = shadow_y(side, post.x, post.y - post.width, at + moved, lamp_x + moved);
            const View view = strip_at(at, truth, 600);
            drawn += renderer.count(moment, view, {.illuminance = true}).shadow_maps_drawn;
            const Frame frame = renderer.draw(moment, view, {.illuminance = true});
            const Frame again = renderer.draw(moment, view, {.illuminance = true});
            EXPECT_EQ(frame.illuminance_lx, again.illuminance_lx);
            const Frame free = without.draw(moment, view, {.illuminance = true});
            const double found = edge(frame, free, moment, view, at, truth);
            worst_texels = std::max(worst_texels, std::abs(found - truth) / (texel * (at - lamp_x)));
        }
        EXPECT_LT(worst_texels, 1.0 + bound);
        if (bound == 0.0)
            EXPECT_EQ(drawn, 40);
        else
            EXPECT_TRUE(drawn > 1 && drawn < 20) << drawn;
    }
}

} // namespace
} // namespace fernlicht
