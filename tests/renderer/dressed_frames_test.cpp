// What dressing changes in a frame, and what it must not.
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/roads/road_network.h"
#include "tests/renderer/device_test.h"
#include "tests/renderer/views.h"

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
