// Leaving out what a moment does not need must not change a bit; switching it on must change a pixel, and off must save work.
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/control_play.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/drives/story/apply_storyboard.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/renderer/shadow_scene.h"

#include <filesystem>
#include <random>
#include <set>

namespace fernlicht {
namespace {

std::shared_ptr<const LampFile> round_beam(double peak_cd, double half_deg) {
    const std::vector<double> angles = tests::steps(-half_deg, half_deg, half_deg / 20.0);
    return tests::file_of(tests::table_of(
        angles, angles, [&](double h, double v) { return peak_cd * std::exp(-4.0 * (h * h + v * v) / (half_deg * half_deg)); }));
}

/// What a random scene may hold; each can be switched by itself.
struct Features {
    bool lamp = true, second_lamp = true, caster = true, sky = true, retro = true, emissive = true, texture = true;
};

struct RandomScene {
    Scene scene;
    Moment moment;
};

/// A road, some boards before and beside the car, all drawn from `seed`; what is switched off leaves the rest as it is.
RandomScene random_scene(std::uint64_t seed, const Features& on) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
    };
    RandomScene out;
    Material road{"road", SurfaceKind::road, glm::vec3(0.1F)};
    Material board{"board", SurfaceKind::board, glm::vec3(0.4F, 0.3F, 0.2F)};
    Material lantern{"lantern", SurfaceKind::object, glm::vec3(0.2F)};
    const float rl = static_cast<float>(between(50.0, 200.0));
    const glm::vec3 shine(static_cast<float>(between(1.0, 20.0)));
    board.retro_rl = on.retro ? rl : 0.0F;
    lantern.emission_cdm2 = on.emissive ? shine : glm::vec3(0.0F);
    const auto mode = static_cast<TextureMode>(random() % 4);
    SurfaceTexture picture{"noise", 16, 16, {}};
    for (int i = 0; i < 16 * 16 * 4; ++i)
        picture.rgba.push_back(static_cast<std::uint8_t>(random() % 256));
    if (on.texture) {
        road.texture = 0;
        road.texture_mode = mode;
        road.blend_colour = {0.3F, 0.2F, 0.1F};
        out.scene.textures.push_back(picture);
    }
    out.scene.materials = {road, board, lantern};
    Mesh ground{"ground", {30.0, 0.0, 0.0}, {}, {}, {}};
    add_flat(ground, 0, {-40, -30, 0}, {80, -30, 0}, {80, 30, 0}, {-40, 30, 0});
    out.scene.meshes.push_back(ground);
    const auto upright = [&](std::uint32_t material, double x, double y, double size) {
        Mesh mesh{"upright", {x, y, 0.0}, {}, {}, {}};
        const auto s = static_cast<float>(size);
        add_flat(mesh, material, {0, -s, 0}, {0, -s, 2 * s}, {0, s, 2 * s}, {0, s, 0}); // faces the car
        out.scene.meshes.push_back(mesh);
    };
    const double x = between(9.0, 13.0), y = between(-1.0, 1.0);
    if (on.caster)
        upright(0, x, y, 0.4);
    upright(1, between(35.0, 45.0), between(2.5, 4.0), 0.8);
    upright(2, between(30.0, 40.0), between(-4.0, -2.5), 0.8);
    out.moment.daylight.horizontal_illuminance_lx = on.sky ? between(0.5, 5.0) : 0.0;
    const auto file = round_beam(between(5000.0, 20000.0), between(15.0, 40.0));
    LampColour colour;
    for (const double side : {0.6, -0.6}) {
        const bool shines = side > 0.0 ? on.lamp : on.second_lamp;
        out.moment.lamps.push_back({side > 0.0 ? "left" : "right",
                                    file,
                                    {glm::dvec3(3.5, side, between(0.5, 0.9)), axes_from_angles(0.0, -0.02, 0.0)},
                                    shines ? 1.0 : 0.0,
                                    colour,
                                    0.0});
    }
    return out;
}

class PruningTest : public DeviceTest {
  protected:
    Frame draw(const RandomScene& s, const char* technique, Work* work = nullptr) {
        RendererSettings settings{.technique = technique};
        settings.tone_mapper.l_max_cdm2 = 20.0;
        Renderer renderer(device_, s.scene, settings);
        if (work != nullptr)
            *work = renderer.count(s.moment, driver_view(160, 120, 40.0), all_results);
        return renderer.draw(s.moment, driver_view(160, 120, 40.0), all_results);
    }
};

TEST_F(PruningTest, PrunedAndUnprunedGiveTheSameBytesOverRandomScenes) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        std::mt19937_64 random(seed);
        const auto toss = [&] { return random() % 2 == 0; };
        const Features on{toss(), toss(), toss(), toss(), toss(), toss(), toss()};
        const RandomScene s = random_scene(seed, on);
        expect_same_frames(draw(s, "photometric"), draw(s, "photometric-unpruned"), "seed " + std::to_string(seed));
    }
}

TEST_F(PruningTest, EachFeatureChangesAPixelAndSavesWorkWhenItIsOff) {
    struct Switch {
        const char* name;
        bool Features::*feature;
    };
    const Switch switches[] = {
        {"second lamp", &Features::second_lamp}, {"caster", &Features::caster},  {"sky", &Features::sky}, {"retro", &Features::retro},
        {"emissive", &Features::emissive},       {"texture", &Features::texture}};
    for (std::uint64_t seed = 101; seed <= 102; ++seed)
        for (const Switch& s : switches) {
            Features on, off;
            off.*s.feature = false;
            Work with, without;
            const Frame a = draw(random_scene(seed, on), "photometric", &with), b = draw(random_scene(seed, off), "photometric", &without);
            EXPECT_NE(a.luminance_cdm2, b.luminance_cdm2) << s.name << ", seed " << seed;
            const bool saves = without.passes < with.passes || without.samplers < with.samplers || without.draws < with.draws ||
                               without.calls < with.calls || without.features < with.features;
            EXPECT_TRUE(saves) << s.name << ", seed " << seed;
            EXPECT_LE(without.passes, with.passes) << s.name;
            EXPECT_LE(without.samplers, with.samplers) << s.name;
        }
}

TEST_F(PruningTest, UnprunedDoesMore) {
    const RandomScene s =
        random_scene(7, {.second_lamp = false, .caster = false, .sky = false, .retro = false, .emissive = false, .texture = false});
    Work pruned, all;
    draw(s, "photometric", &pruned);
    draw(s, "photometric-unpruned", &all);
    EXPECT_LT(pruned.samplers, all.samplers);
    EXPECT_LT(pruned.passes, all.passes);
    EXPECT_LT(pruned.features, all.features);
    EXPECT_LT(pruned.lamps, all.lamps);
}

/// Every shipped drive: moments at its start, middle and end and where other lamps are lit than in any before, eight at most; all views.
/// Of the adaptive drives one, whose lamps are those of the others: their shaders compile for most of a minute.
class ShippedDrives : public testing::TestWithParam<std::filesystem::path> {};

std::vector<std::filesystem::path> shipped_drives() {
    std::vector<std::filesystem::path> drives;
    for (const auto& entry : std::filesystem::directory_iterator(FERNLICHT_SOURCE_DIR "/scenarios/library/drives"))
        if (const std::string name = entry.path().stem().string(); !name.starts_with("adaptive-") || name == "adaptive-crest")
            drives.push_back(entry.path());
    std::ranges::sort(drives);
    return drives;
}

TEST_P(ShippedDrives, PrunedAndUnprunedGiveTheSameBytes) {
    Drive drive = read_drive(GetParam(), DriveEdits{.resolution = std::pair(320, 240)});
    const RoadNetwork network = read_opendrive(drive.road_file);
    apply_storyboard(drive, network);
    const Route route(network, drive.start, drive.via);
    const Scene scene = staged_scene(drive, network, route);
    Device device = open_device("auto");
    RendererSettings settings{.tone_mapper = drive.tone_mapper, .shadows = drive.shadows};
    Renderer pruned(device, scene, settings);
    settings.technique = "photometric-unpruned";
    Renderer unpruned(device, scene, settings);
    const int last = tick_count(drive) - 1;
    for (const LampSet& lamp_set : drive.lamp_sets) {
        std::vector<Moment> moments;
        std::set<std::vector<bool>> lit_before;
        State state = start(drive);
        for (int tick = 0; tick <= last; ++tick, state = advance(state, drive)) {
            const Moment moment = moment_at(state, drive, route, lamp_set);
            std::vector<bool> lit;
            for (const auto& lamp : moment.lamps)
                lit.push_back(lamp.intensity_factor > 0.0);
            const bool is_new = lit_before.insert(lit).second && moments.size() < 6;
            if (is_new || tick == last || tick == last / 2)
                moments.push_back(moment);
        }
        for (const View& view : drive.views) {
            pruned.prepare(moments, view, all_results);
            unpruned.prepare(moments, view, all_results);
        }
        const int compiled = pruned.compiled_programs();
        for (const Moment& moment : moments)
            for (const View& view : drive.views)
                expect_same_frames(pruned.draw(moment, view, all_results), unpruned.draw(moment, view, all_results),
                                   lamp_set.name + ", " + view.name + ", " + std::to_string(moment.time_s) + " s");
        EXPECT_EQ(pruned.compiled_programs(), compiled) << "nothing compiles once a drive is prepared";
        EXPECT_GT(compiled, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedDrives, testing::ValuesIn(shipped_drives()), [](const auto& one) {
    std::string name = one.param.stem().string();
    std::ranges::replace(name, '-', '_');
    return name;
});

} // namespace
} // namespace fernlicht
