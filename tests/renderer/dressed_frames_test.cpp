// What dressing changes in a frame, and what it must not.
#include "renderer/twin.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/roads/road_network.h"
#include "tests/renderer/device_test.h"
#include "tests/renderer/reference/rooms.h"

namespace fernlicht {
namespace {

/// The village at two moments, lit by its first lamp set.
class DressedFrames : public DeviceTest {
  protected:
    struct Street {
        Scene scene;
        std::vector<Moment> moments;
        std::vector<std::string> notes;
    };
    Street street(const char* dressing) const {
        DriveEdits edits;
        edits.values = {{"dressing", dressing}};
        Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/village.yaml", edits);
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start, drive.via);
        Street out;
        out.scene = staged_scene(drive, network, route);
        out.notes = drive.notes;
        State state = start(drive);
        for (int tick = 0; tick <= 80; ++tick, state = advance(state, drive))
            if (tick == 20 || tick == 80)
                out.moments.push_back(moment_at(state, drive, route, drive.lamp_sets.front()));
        return out;
    }
};

/// A floor 0.5 m below ground that is measured alone, under a lamp of 1000 cd.
TEST_F(DeviceTest, GroundThatIsMeasuredAloneIsInMapsAndNotInViews) {
    constexpr std::uint32_t floor_id = 1, ground_id = 2;
    const Quad square{{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
    Scene scene{.materials = {lambert(0.2, SurfaceKind::object), lambert(0.2)},
                .meshes = {quads("floor", 0, {0, 0, -0.5}, {square}), quads("ground", 1, {}, {square})}};
    scene.meshes.back().measured_alone = true;
    scene.meshes.back().casts = false;
    const Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 0.65}, 0, -90))}};
    const Twin twin(scene, true);
    const Reference reference(scene);
    for (const bool map : {true, false}) {
        const View view = map ? map_about({1.0, 0.5}, 2.0, 8) : camera({-2.0, 0.0, 1.5}, 0, -40, 30, 8);
        const std::uint32_t id = map ? ground_id : floor_id;
        const ReferenceImage truth = reference.render(moment, view, everything, ReferenceSettings{.footprint = Footprint::centre});
        for (const auto& [x, y] : each_pixel(8, 8)) {
            const TwinPixel pixel = twin.pixel(moment, view, x + 0.5, y + 0.5);
            ASSERT_EQ(pixel.id, id);
            EXPECT_EQ(truth.ids.at(x, y), id);
            const double h = map ? 0.65 : 1.15, d2 = pixel.point_m.x * pixel.point_m.x + pixel.point_m.y * pixel.point_m.y + h * h;
            EXPECT_NEAR(pixel.illuminance_lx, 1000.0 * h / std::pow(d2, 1.5), 1e-6 * pixel.illuminance_lx);
            EXPECT_NEAR(truth.illuminance_lx.mean.at(x, y), pixel.illuminance_lx, 1e-5 * pixel.illuminance_lx);
        }
        for (const char* technique : {"photometric", "photometric-unpruned", "photometric-naive", "full"}) {
            RendererSettings settings;
            settings.technique = technique;
            Renderer renderer(device_, scene, settings);
            const Frame frame = renderer.draw(moment, view, renderer.available(all_results));
            for (const auto& [x, y] : each_pixel(8, 8)) {
                ASSERT_EQ(frame.ids.at(x, y), id) << technique;
                if (technique != std::string_view("full")) { // whose light is another
                    const TwinPixel pixel = twin.pixel(moment, view, x + 0.5, y + 0.5);
                    EXPECT_NEAR(frame.illuminance_lx.at(x, y), pixel.illuminance_lx, pixel.bound_lx) << technique;
                }
            }
        }
    }
}

TEST_F(DressedFrames, PrunedAndUnprunedGiveTheSameBytes) {
    const Street dressed = street("dressed");
    RendererSettings settings;
    Renderer pruned(device_, dressed.scene, settings);
    settings.technique = "photometric-unpruned";
    Renderer unpruned(device_, dressed.scene, settings);
    for (const Moment& moment : dressed.moments)
        for (const View& view : {driver_view(320, 240, 30.0, -1.0), map_view(80.0, 5.0, 20.0, 160, 320)})
            expect_same_frames(pruned.draw(moment, view, all_results), unpruned.draw(moment, view, all_results),
                               view.name + ", " + std::to_string(moment.time_s) + " s");
}

TEST_F(DressedFrames, LanesAreLitAsInPlainOnesAndHousesAreNot) {
    const Street none = street("none"), plain = street("plain"), dressed = street("dressed");
    Renderer first(device_, plain.scene, {}), second(device_, dressed.scene, {}), bare(device_, none.scene, {});
    View map = map_view(120.0, 0.0, 4.4, 48, 480);
    map.map_right_m = 1.4; // both lanes; beyond them stand parked cars
    const View driver = driver_view(320, 240, 40.0, -1.0);
    for (std::size_t i = 0; i < plain.moments.size(); ++i) {
        const Frame a = first.draw(plain.moments[i], map, all_results), b = second.draw(dressed.moments[i], map, all_results);
        // Patches lie 1 mm above the road: 0.15 % of the lamps' height, and 0.0014 degrees at 40 m, where light falls tenfold in 0.7
        // degrees.
        for (const auto& [expected, found] : {std::pair(&a.illuminance_lx, &b.illuminance_lx), std::pair(&a.target_lx, &b.target_lx)})
            for (std::size_t k = 0; k < expected->pixels().size(); ++k)
                ASSERT_NEAR(found->pixels()[k], expected->pixels()[k], 0.01F * expected->pixels()[k] + 1e-3F) << "both lanes, to 120 m";
        const Frame c = first.draw(plain.moments[i], driver, all_results), d = second.draw(dressed.moments[i], driver, all_results),
                    e = bare.draw(none.moments[i], driver, all_results);
        EXPECT_NE(c.luminance_cdm2, d.luminance_cdm2);
        EXPECT_NE(c.luminance_cdm2, e.luminance_cdm2);
    }
    const auto has = [](const Scene& scene, const char* name) {
        return std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) { return mesh.name.starts_with(name); });
    };
    EXPECT_TRUE(has(plain.scene, "house") && has(dressed.scene, "house") && !has(none.scene, "house"));
    EXPECT_TRUE(has(dressed.scene, "pedestrian") && !has(plain.scene, "pedestrian"));
    EXPECT_TRUE(std::ranges::none_of(dressed.notes, [](const std::string& note) { return note.find("shade the own lane") != note.npos; }))
        << "the street is straight";
}

} // namespace
} // namespace fernlicht
