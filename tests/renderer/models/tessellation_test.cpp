// A model is lit alike however finely it is cut into triangles; for techniques that light vertices, how far they are off.
#include "renderer/renderer.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/light/light.h"
#include "scenarios/models/placed_model.h"
#include "tests/scenarios/models/written_gltf.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

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

Moment low_beams() {
    static const auto file = std::make_shared<const LampFile>(lamp_of_model(lamp_models().at(0)));
    Moment moment;
    for (const double side : {0.6, -0.6}) {
        LitLamp lamp;
        lamp.name = side > 0.0 ? "left" : "right";
        lamp.file = file;
        lamp.pose = {{0.0, side, 0.65}, axes_from_angles(0.0, 0.0, 0.0)};
        moment.lamps.push_back(std::move(lamp));
    }
    return moment;
}

View map_of_plane() {
    View view;
    view.name = "map";
    view.projection = Projection::map;
    view.map_ahead_m = 65.0;
    view.map_behind_m = -5.0;
    view.map_left_m = view.map_right_m = 6.0;
    view.width_px = 48;
    view.height_px = 240;
    return view;
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

TEST(Tessellation, ThePlaneOfTwoTrianglesHasTheLuxOfThatOfTwentyThousand) {
    Device device = open_device("auto");
    const Scene coarse = plane(1, 1), fine = plane(200, 50);
    const Moment moment = low_beams();
    const View view = map_of_plane();
    std::vector<double> truth;
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x)
            truth.push_back(surface_illuminance_lx(
                moment, {65.0 - 60.0 * (y + 0.5) / view.height_px, 6.0 - 12.0 * (x + 0.5) / view.width_px, 0.0}, {0.0, 0.0, 1.0}));
    ASSERT_GT(*std::ranges::max_element(truth), 5.0);
    const auto drawn = [&](const Scene& scene, const std::string& technique) {
        RendererSettings settings;
        settings.technique = technique;
        return Renderer(device, scene, settings).draw(moment, view, {.illuminance = true});
    };
    const Frame two = drawn(coarse, "photometric"), many = drawn(fine, "photometric");
    EXPECT_LT(error_of(two, truth), 1e-4);
    EXPECT_LT(error_of(many, truth), 1e-4);
    double most = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(two.illuminance_lx.data()[i] - many.illuminance_lx.data()[i])));
    EXPECT_LT(most, 0.01) << "lx";
    RecordProperty("photometric_most_difference_lx", fmt::format("{:.3g}", most));
    // What vertices light depends on where they are: told, and that it is so.
    for (const std::string technique : {"vertex-spots", "vertex-projective"}) {
        const Frame few = drawn(coarse, technique), lot = drawn(fine, technique);
        std::vector<double> own;
        for (const float lx : lot.illuminance_lx.pixels())
            own.push_back(static_cast<double>(lx));
        const double apart = error_of(few, own);
        RecordProperty(technique, fmt::format("2 triangles are {:.3g} (rms) from 20000", apart));
        EXPECT_GT(apart, 0.5) << technique;
    }
}

} // namespace
} // namespace fernlicht
