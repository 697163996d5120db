// Views of one moment: the light is the same in all of them, a mirror exchanges left and right, and shadow maps are drawn once.
#include "scenarios/drives/drive.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/light/light.h"
#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"
#include "tests/renderer/device_test.h"
#include "tests/renderer/reference/rooms.h"
#include "tests/scenarios/models/written_gltf.h"
#include "tests/trial.h"

namespace fernlicht {
namespace {

/// A road 160 m long to the front and the rear, and a car 20 m ahead that casts shadows.
Scene road_with_car() {
    Scene scene{.materials = {{.name = "road", .kind = SurfaceKind::road}},
                .meshes = {quads("road", 0, {}, {{{-160, -40, 0}, {160, -40, 0}, {160, 40, 0}, {-160, 40, 0}}})}};
    add_model(scene, car_body({}), {{24.0, 1.5, 0.0}, glm::dmat3(1.0)}, 1.0, SurfaceKind::vehicle);
    return scene;
}

/// Two low beams above the car's origin, or so far ahead of it.
Moment low_beams(double ahead_m = 0.0) {
    static const auto file = std::make_shared<const LampFile>(lamp_of_model(lamp_models().at(0)));
    Moment moment;
    for (const double side : {0.6, -0.6})
        moment.lamps.push_back({.file = file, .pose = {{ahead_m, side, 0.65}, glm::dmat3(1.0)}});
    return moment;
}

Moment lit() {
    Moment moment = low_beams(3.6);
    moment.daylight.horizontal_illuminance_lx = 0.2; // so that mirrors see something
    return moment;
}

std::vector<View> six() {
    const std::string library = FERNLICHT_SOURCE_DIR "/scenarios/library/";
    return read_drive(tests::written("drive.yaml", "fernlicht: 1\nroad: " + library +
                                                       "roads/straight.xodr\nspeed_mps: 10\nduration_s: 1\nview_set: " + library +
                                                       "views/six.yaml\nlamp_sets: {a: {source: filament, file: " + library +
                                                       "lamps/halogen-low.ies}}\n"))
        .views;
}

glm::dvec2 pixel_of(const Camera& camera, const View& view, const glm::dvec3& point_m) {
    const glm::dvec4 clip = camera.clip_from_ego * glm::dvec4(point_m, 1.0);
    if (clip.w <= 0.0)
        return {-1.0, -1.0};
    return {(clip.x / clip.w + 1.0) * 0.5 * view.width_px, (1.0 - clip.y / clip.w) * 0.5 * view.height_px};
}

using Views = DeviceTest;
using Tessellation = DeviceTest;

TEST_F(Views, TheShippedSetShowsWhatMirrorsMust) {
    const std::vector<View> views = six();
    ASSERT_EQ(views.size(), 7U) << "six and the map";
    const auto sees = [&](const char* name, const glm::dvec3& point_m) {
        const auto view = std::ranges::find(views, name, &View::name);
        EXPECT_NE(view, views.end()) << name;
        const glm::dvec2 at = pixel_of(camera_of(Moment{}, *view), *view, point_m);
        return at.x >= 0.0 && at.x <= view->width_px && at.y >= 0.0 && at.y <= view->height_px;
    };
    const double eye_x = 1.3;
    // UN R46, class I: the road from 60 m behind the eye to the horizon, 20 m wide.
    for (const double y : {-10.0, 0.0, 10.0})
        EXPECT_TRUE(sees("mirror-inside", {eye_x - 60.0, y, 0.0})) << y;
    EXPECT_TRUE(sees("mirror-inside", {-2000.0, 0.0, 1.0}));
    // Class III: from 30 m behind the eye 5 m wide beside the car, from 4 m behind 1 m wide.
    for (const double side : {1.0, -1.0}) {
        const char* name = side > 0.0 ? "mirror-left" : "mirror-right";
        for (const auto& [behind, wide] : {std::pair(30.0, 5.0), std::pair(4.0, 1.0)})
            for (const double y : {0.9, 0.9 + wide})
                EXPECT_TRUE(sees(name, {eye_x - behind, side * y, 0.0})) << name << " " << behind << " " << y;
        EXPECT_TRUE(sees(name, {-2000.0, side * 20.0, 1.0})) << name;
        EXPECT_FALSE(sees(name, {20.0, side * 2.0, 0.0})) << name << " looks back";
    }
    // The fronts join: a point at the edge of one is at the other's.
    for (const double h : {20.0, -20.0}) {
        const glm::dvec3 edge = views[0].position_m + 50.0 * glm::dvec3(std::cos(radians(h)), std::sin(radians(h)), 0.0);
        const View& beside = *std::ranges::find(views, h > 0.0 ? "front-left" : "front-right", &View::name);
        const double x0 = pixel_of(camera_of(Moment{}, views[0]), views[0], edge).x,
                     x1 = pixel_of(camera_of(Moment{}, beside), beside, edge).x;
        EXPECT_NEAR(std::min(x0, views[0].width_px - x0), 0.0, 0.5);
        EXPECT_NEAR(std::min(x1, beside.width_px - x1), 0.0, 0.5);
    }
}

TEST_F(Views, AMirrorExchangesLeftAndRight) {
    const Scene scene = road_with_car();
    Renderer renderer(device_, scene, {});
    View view{.position_m = {1.3, 0.35, 1.2}, .yaw_rad = 0.15, .width_px = 160, .height_px = 120};
    const FrameOutputs outputs{.illuminance = true, .depth = true, .ids = true};
    const Frame plain = renderer.draw(lit(), view, outputs);
    view.mirrored = true;
    const Frame mirror = renderer.draw(lit(), view, outputs);
    int differ = 0, seen = 0, changed = 0;
    for (const auto& [x, y] : each_pixel(view)) {
        const int other = view.width_px - 1 - x;
        differ +=
            plain.ids.at(x, y) != mirror.ids.at(other, y) || std::abs(plain.illuminance_lx.at(x, y) - mirror.illuminance_lx.at(other, y)) >
                                                                 1e-3F * (1.0F + plain.illuminance_lx.at(x, y))
                ? 1
                : 0;
        changed += plain.ids.at(x, y) != mirror.ids.at(x, y) ? 1 : 0;
        seen += plain.ids.at(x, y) == 2 ? 1 : 0;
    }
    EXPECT_GT(seen, 100) << "the car";
    EXPECT_GT(changed, 100) << "it stands on the other side";
    EXPECT_LT(differ, 60) << "pixels on edges alone"; // of 19 200
}

/// Of a closed body nothing is lost but pixels on edges; of one turned inside out only its farther side is seen.
TEST_F(Views, FrontsAloneShowAClosedBodyAlsoInAMirror) {
    const Scene both = road_with_car();
    Scene fronts = both, inside_out = both;
    for (Scene* const scene : {&fronts, &inside_out})
        for (Mesh& mesh : scene->meshes)
            mesh.closed = mesh.name != "road";
    for (Mesh& mesh : inside_out.meshes)
        for (std::size_t i = 0; mesh.closed && i + 2 < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i], mesh.indices[i + 1]);
    for (const char* const technique : {"photometric", "photometric-unpruned", "full"})
        for (const bool mirrored : {false, true}) {
            View view{.position_m = {1.3, 0.35, 1.2}, .yaw_rad = 0.15, .width_px = 160, .height_px = 120};
            view.mirrored = mirrored;
            const auto drawn = [&](const Scene& scene) {
                Renderer renderer(device_, scene, {.technique = technique});
                return renderer.draw(lit(), view, {.colour = true, .depth = true, .ids = true});
            };
            const Frame a = drawn(both), b = drawn(fronts), c = drawn(inside_out);
            int seen = 0, differ = 0, farther = 0;
            for (const auto& [x, y] : each_pixel(view)) {
                seen += a.ids.at(x, y) >= 2 ? 1 : 0;
                differ += a.ids.at(x, y) != b.ids.at(x, y) || a.depth_m.at(x, y) != b.depth_m.at(x, y) ? 1 : 0;
                farther += a.ids.at(x, y) >= 2 && c.depth_m.at(x, y) > a.depth_m.at(x, y) + 0.1F ? 1 : 0;
            }
            EXPECT_GT(seen, 100) << technique;
            EXPECT_LE(differ, seen / 100) << technique << (mirrored ? ", mirrored" : "");
            EXPECT_GT(farther, seen / 2) << technique << (mirrored ? ", mirrored" : "") << ": the test would not see culled fronts";
        }
}

/// What a pixel of one view shows lies in another view among the pixels round its place there: same point, same light.
TEST_F(Views, TheLightIsTheSameInAll) {
    const Scene scene = road_with_car();
    Renderer renderer(device_, scene, {});
    const Moment moment = lit();
    std::vector<View> views = six();
    views.pop_back(); // the map
    View wide;        // sees what all of the front ones see
    wide.position_m = {1.8, 0.0, 1.5};
    wide.vertical_fov_rad = radians(60.0);
    wide.width_px = 1200;
    wide.height_px = 600;
    View back = wide;
    back.position_m = {2.0, 0.2, 1.4};
    back.yaw_rad = pi;
    const FrameOutputs outputs{.illuminance = true, .depth = true, .ids = true};
    for (const View& view : views) {
        const View& reference = view.mirrored ? back : wide;
        const Frame all = renderer.draw(moment, reference, outputs), frame = renderer.draw(moment, view, outputs);
        const Camera camera = camera_of(moment, view), other = camera_of(moment, reference);
        int compared = 0, outside = 0;
        double worst = 0.0;
        for (int y = 1; y < view.height_px; y += 5)
            for (int x = 1; x < view.width_px; x += 5) {
                if (frame.ids.at(x, y) == 0)
                    continue;
                const Ray ray = pixel_ray(camera, view, x + 0.5, y + 0.5);
                const glm::dvec3 point =
                    ray.origin_m + ray.direction * (static_cast<double>(frame.depth_m.at(x, y)) / glm::dot(ray.direction, camera.axis));
                const glm::dvec2 at = pixel_of(other, reference, point);
                if (at.x < 2.0 || at.y < 2.0 || at.x > reference.width_px - 2.0 || at.y > reference.height_px - 2.0)
                    continue;
                const int cx = static_cast<int>(at.x), cy = static_cast<int>(at.y);
                double least = 1e30, most = -1e30;
                bool same_body = true;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        same_body = same_body && all.ids.at(cx + dx, cy + dy) == frame.ids.at(x, y);
                        least = std::min(least, static_cast<double>(all.illuminance_lx.at(cx + dx, cy + dy)));
                        most = std::max(most, static_cast<double>(all.illuminance_lx.at(cx + dx, cy + dy)));
                    }
                const double depth = static_cast<double>(all.depth_m.at(cx, cy)), here = glm::dot(point - other.eye_m, other.axis);
                if (!same_body || std::abs(depth - here) > 0.05 * here)
                    continue; // another thing stands before it there
                ++compared;
                const double lx = static_cast<double>(frame.illuminance_lx.at(x, y));
                const double off = std::max({0.0, least - lx, lx - most}) / std::max(lx, 0.05);
                worst = std::max(worst, off);
                outside += off > 0.01 ? 1 : 0;
            }
        EXPECT_GT(compared, 300) << view.name;
        EXPECT_LE(outside, compared / 500) << view.name << ": worst " << worst << " of " << compared;
    }
}

TEST_F(Views, ShadowMapsAreDrawnOnceForAllViewsOfAMoment) {
    const Scene scene = road_with_car();
    Renderer renderer(device_, scene, {});
    std::vector<View> views = six();
    const Moment moment = lit();
    int passes = 0;
    for (const View& view : views)
        passes += renderer.count(moment, view, {.colour = true}).passes;
    EXPECT_EQ(passes, static_cast<int>(views.size()) + 2) << "a pass for each view and for the shadow map of each lamp";
}

// A model is lit alike however finely it is cut into triangles; for techniques that light vertices, how far they are off.

/// A level plane, 5 to 65 m ahead and 6 m to each side, of 2 * along * across triangles: written as glTF, and read.
Scene plane(int along, int across) {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i <= along; ++i)
        for (int k = 0; k <= across; ++k) {
            const double x = 5.0 + 60.0 * i / along, y = -6.0 + 12.0 * k / across;
            positions.push_back({static_cast<float>(y), 0.0F, static_cast<float>(x)}); // glTF: x left, y up, z forward
        }
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (across + 1) + k); };
    for (int i = 0; i < along; ++i)
        for (int k = 0; k < across; ++k)
            indices.insert(indices.end(), {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / fmt::format("plane_{}_{}.glb", along, across);
    test::WrittenGltf(positions, indices).write_glb(file);
    const Model model = read_model(file);
    std::filesystem::remove(file);
    EXPECT_EQ(model.triangles(), static_cast<std::size_t>(2 * along * across));
    Scene scene;
    add_model(scene, model, {}, 1.0, SurfaceKind::terrain);
    scene.materials.at(0).albedo = glm::vec3(0.2F);
    return scene;
}

/// Root of the mean square of the difference to double precision, over that of the light itself.
double error_of(const Frame& frame, const std::vector<double>& truth) {
    double error = 0.0, light = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double lx = static_cast<double>(frame.illuminance_lx.data()[i]);
        error += (lx - truth[i]) * (lx - truth[i]);
        light += truth[i] * truth[i];
    }
    return std::sqrt(error / light);
}

TEST_F(Tessellation, ThePlaneOfTwoTrianglesHasTheLuxOfThatOfTwentyThousand) {
    const Scene coarse = plane(1, 1), fine = plane(200, 50);
    const Moment moment = low_beams();
    const View view = map_view(65.0, -5.0, 6.0, 48, 240);
    std::vector<double> truth;
    for (const auto& [x, y] : each_pixel(view))
        truth.push_back(surface_illuminance_lx(
            moment, {65.0 - 60.0 * (y + 0.5) / view.height_px, 6.0 - 12.0 * (x + 0.5) / view.width_px, 0.0}, {0.0, 0.0, 1.0}));
    ASSERT_GT(*std::ranges::max_element(truth), 5.0);
    const auto drawn = [&](const Scene& scene, const std::string& technique) {
        return Renderer(device_, scene, RendererSettings{.technique = technique}).draw(moment, view, {.illuminance = true});
    };
    const Frame two = drawn(coarse, "photometric"), many = drawn(fine, "photometric");
    EXPECT_LT(error_of(two, truth), 1e-4);
    EXPECT_LT(error_of(many, truth), 1e-4);
    double most = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(two.illuminance_lx.data()[i] - many.illuminance_lx.data()[i])));
    EXPECT_LT(most, 0.01) << "lx";
    // What vertices light depends on where they are: told, and that it is so.
    for (const std::string technique : {"vertex-spots", "vertex-projective"}) {
        const Frame few = drawn(coarse, technique), lot = drawn(fine, technique);
        std::vector<double> own;
        for (const float lx : lot.illuminance_lx.pixels())
            own.push_back(static_cast<double>(lx));
        const double apart = error_of(few, own);
        EXPECT_GT(apart, 0.5) << technique;
    }
}

} // namespace
} // namespace fernlicht
