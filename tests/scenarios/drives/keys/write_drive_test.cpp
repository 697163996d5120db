// The resolved drive: what write_drive writes, read_drive reads back, to the last bit.
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/write_fields.h"
#include "tests/scenarios/drives/drive_fixture.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <random>

namespace fernlicht {
namespace {

/// Each drive has read its files for itself: what is read alike becomes one.
void share_files(const Drive& a, Drive& b) {
    const auto share = [&](std::shared_ptr<const LampFile>& file) {
        const auto from = std::ranges::find(b.lamp_sources, file, &LampSource::file);
        for (const LampSource& to : a.lamp_sources)
            if (file && from->path == to.path && from->options == to.options) {
                EXPECT_EQ(file->table, to.file->table);
                file = to.file;
                return;
            }
    };
    for (LampSet& lamp_set : b.lamp_sets) {
        std::ranges::for_each(lamp_set.lamps, share, &MountedLamp::file);
        std::ranges::for_each(lamp_set.changes, share, &LampChange::file);
    }
    std::ranges::for_each(b.street_lamps, share, &StreetLampRow::file);
}

void expect_same(const Drive& a, Drive b) {
    share_files(a, b);
    EXPECT_EQ(std::tie(a.name, a.title, a.road_file, a.via, a.speed, a.duration_s, a.step_s, a.bumper_m, a.wheelbase_m, a.technique),
              std::tie(b.name, b.title, b.road_file, b.via, b.speed, b.duration_s, b.step_s, b.bumper_m, b.wheelbase_m, b.technique));
    EXPECT_EQ(std::tie(a.start.road, a.start.lane, a.start.s_m), std::tie(b.start.road, b.start.lane, b.start.s_m));
    EXPECT_EQ(a.daylight, b.daylight);
    EXPECT_EQ(a.weather, b.weather);
    EXPECT_EQ(a.vehicle, b.vehicle);
    EXPECT_TRUE(std::ranges::equal(a.street_lamps, b.street_lamps, [](const StreetLampRow& x, const StreetLampRow& y) {
        return std::tie(x.name, x.file, x.first_m, x.last_m, x.every_m, x.beside_m, x.height_m, x.arm_m, x.tilt_rad, x.level, x.colour,
                        x.on_objects) == std::tie(y.name, y.file, y.first_m, y.last_m, y.every_m, y.beside_m, y.height_m, y.arm_m,
                                                  y.tilt_rad, y.level, y.colour, y.on_objects);
    }));
    EXPECT_TRUE(std::ranges::equal(a.lamp_sets, b.lamp_sets, [](const LampSet& x, const LampSet& y) {
        return std::tie(x.name, x.lamps, x.changes, x.levelling, x.swivel) == std::tie(y.name, y.lamps, y.changes, y.levelling, y.swivel);
    }));
    EXPECT_EQ(a.views, b.views);
    EXPECT_EQ(a.capture, b.capture);
    EXPECT_EQ(a.tone_mapper, b.tone_mapper);
    EXPECT_EQ(a.extent, b.extent);
    EXPECT_EQ(a.probes, b.probes);
    EXPECT_EQ(a.seeing, b.seeing);
    EXPECT_EQ(a.limits, b.limits);
    EXPECT_EQ(a.shadows, b.shadows);
    EXPECT_EQ(std::tie(a.beams, a.textured, a.dressing, a.seed), std::tie(b.beams, b.textured, b.dressing, b.seed));
}

/// Any drive that the format can hold; numbers with all their digits.
class AnyDrive {
  public:
    AnyDrive(unsigned seed, std::vector<LampSource> sources) : random_(seed), sources_(std::move(sources)) {}

    Drive make() {
        Drive drive;
        drive.name = name();
        drive.title = text();
        drive.road_file = sources_.front().path.parent_path() / "road.xodr";
        drive.start = {coin() ? "" : text(), whole(-5, 5), number(0.0, 1000.0)};
        drive.via = several<std::string>(3, [&] { return text(); });
        double time_s = 0.0;
        drive.speed = several<SpeedPoint>(4, [&] { return SpeedPoint{time_s += number(0.1, 3.0), number(0.0, 150.0)}; });
        drive.speed.push_back({time_s + 1.0, 20.0 / 3.6});
        drive.duration_s = number(0.5, 100.0);
        drive.step_s = number(0.001, 1.0);
        drive.daylight = {name(), number(0.0, 27000.0)};
        if (coin())
            (coin() ? drive.daylight.sun : drive.daylight.moon) = DirectLight{number(-6.0, 6.0), number(-0.01, 1.5), number(0.0, 1e5)};
        if (coin()) {
            drive.daylight.clock = SkyClock{2026,
                                            whole(1, 12),
                                            whole(1, 28),
                                            whole(0, 86399),
                                            2.0,
                                            number(-90.0, 90.0),
                                            number(-180.0, 180.0),
                                            SkyCover::overcast,
                                            number(0.0, 60.0)};
            drive.daylight = daylight_at({drive.daylight.name, 0.0, {}, {}, drive.daylight.clock}, 0.0);
        }
        if (coin())
            drive.street_lamps = {{"row",
                                   sources_.front().file,
                                   number(0.0, 9.0),
                                   number(10.0, 1e3),
                                   number(1.0, 99.0),
                                   number(-9.0, 9.0),
                                   number(1.0, 20.0),
                                   number(0.0, 3.0),
                                   number(-0.5, 0.5),
                                   number(0.0, 1.0),
                                   {}}};
        if (coin()) {
            StreetLampRow row;
            row.name = "posts";
            row.file = sources_.front().file;
            row.on_objects = {"lamp post", "It's \"quoted\": a, b"};
            row.height_m = coin() ? number(1.0, 20.0) : 0.0;
            row.colour = {};
            drive.street_lamps.push_back(row);
        }
        if (coin())
            drive.weather = {number(0.0, 1.0), number(0.0, 1.0), number(0.0, 0.9), number(0.0, 1.0)};
        drive.bumper_m = number(2.0, 5.0);
        drive.wheelbase_m = number(2.0, 4.0);
        for (int i = 0; i <= whole(0, 2); ++i)
            drive.lamp_sets.push_back(lamp_set("v" + std::to_string(i)));
        if (coin())
            add_vehicle(drive);
        drive.lamp_sources = sources_;
        for (int i = 0; i <= whole(0, 6); ++i)
            drive.views.push_back(coin() ? camera(i) : map(i));
        drive.capture = {number(0.0, 10.0), coin(), coin(), coin()};
        const bool logarithmic = coin(); // linear has no s
        drive.tone_mapper = {logarithmic ? ToneMapperKind::logarithmic : ToneMapperKind::linear,
                             logarithmic ? number(1.0, 99.0) : ToneMapper{}.s,
                             number(0.1, 1e4),
                             {}};
        drive.technique = name();
        if (coin())
            drive.extent =
                ExtentParameters{{number(0.1, 9.0), 1e-6}, number(0.0, 2.0), number(50.0, 300.0), number(5.0, 30.0), number(0.3, 2.0), {}};
        for (int i = 0; i < whole(0, 3); ++i)
            drive.probes.push_back({"p" + std::to_string(i), number(-9.0, 200.0), number(-9.0, 9.0), number(0.0, 2.0)});
        if (coin())
            drive.seeing.sensors =
                SensorParameters{{number(1.0, 9.0)}, {}, {{"s", number(0.0, 99.0), Across::right_edge, number(0.0, 2.0)}}};
        if (coin())
            drive.seeing.glare =
                GlareParameters{{{"o", number(0.0, 99.0), number(0.5, 2.0)}},
                                coin() ? std::optional(MirrorParameters{{number(9.0, 99.0)}, {1.0, number(0.0, 1.0), 1.2}}) : std::nullopt,
                                VeilingEquation::stiles_holladay,
                                number(20.0, 80.0)};
        if (coin())
            drive.seeing.visibility = VisibilityParameters{
                {default_targets()[1], {"t", number(0.1, 1.0), 2, number(0.0, 1.0), number(5.0, 20.0), {Across::left_edge}}},
                number(0.0, 0.1)};
        if (coin())
            drive.seeing.homogeneity = HomogeneityParameters{number(0.1, 3.0), number(20.0, 90.0), number(1.1, 2.0)};
        if (coin())
            drive.seeing.places = PlaceParameters{coin(), coin(), true, {number(10.0, 90.0)}};
        drive.limits = several<Limit>(3, [&] {
            return Limit{text(), number(-5.0, 0.0), coin() ? std::optional(number(0.0, 1e9)) : std::nullopt};
        });
        drive.shadows.method = shadow_method_names()[drive.seed % shadow_method_names().size()].method;
        if (drive.shadows.any() && coin()) { // nothing of what follows is written for none
            drive.shadows.width = coin() ? 1024 : 16;
            drive.shadows.tolerance_m = number(0.001, 1.0);
        }
        if (coin())
            drive.beams = coin() ? eight_bit_texels : BeamTexels{2 + static_cast<int>(drive.seed % 100), 33, coin() ? 16 : 32};
        drive.textured = coin();
        drive.dressing = coin() ? Dressing::dressed : coin() ? Dressing::none : Dressing::plain;
        drive.seed = random_();
        return drive;
    }

  private:
    double number(double least, double greatest) { return std::uniform_real_distribution(least, greatest)(random_); }
    int whole(int least, int greatest) { return std::uniform_int_distribution(least, greatest)(random_); }
    bool coin() { return whole(0, 1) == 1; }
    std::optional<double> maybe(double least, double greatest) { return coin() ? std::optional(number(least, greatest)) : std::nullopt; }
    template <class T> std::vector<T> several(int most, const auto& make) {
        std::vector<T> result;
        for (int i = whole(0, most); i > 0; --i)
            result.push_back(make());
        return result;
    }
    std::string name() {
        return std::vector<std::string>{"a", "null", "-1", "true", "1.5", "x_9.y", "A-b"}[static_cast<std::size_t>(whole(0, 6))];
    }
    std::string text() {
        return std::vector<std::string>{"plain",
                                        "with \"quotes\" and \\",
                                        "ümläut €",
                                        "a: b # c",
                                        "line\nbreak\ttab\r\x01\x7f",
                                        " spaces  ",
                                        "- [x] {y} *z &w !v |u >t %s @r",
                                        "\xe2\x80\xa8 \xc2\x85 .",
                                        "~",
                                        "12"}[static_cast<std::size_t>(whole(0, 9))];
    }
    const LampSource& source() { return sources_[static_cast<std::size_t>(whole(0, static_cast<int>(sources_.size()) - 1))]; }
    glm::dvec3 position() { return {number(-9.0, 9.0), number(-9.0, 9.0), number(0.0, 3.0)}; }
    LampColour colour() { return {{number(-0.1, 2.0), number(0.0, 2.0), number(0.0, 2.0)}, number(0.5, 3.0), number(1000.0, 9000.0)}; }
    SourceKind kind() { return std::vector{SourceKind::filament, SourceKind::arc, SourceKind::led}[static_cast<std::size_t>(whole(0, 2))]; }

    AxleParameters axle() {
        return {number(1.0, 100.0), number(1e5, 1e6), number(0.0, 1e4), number(1e3, 1e6), // springs that bear 5 t
                number(1e3, 1e6),   number(1e3, 1e6), number(0.01, 9.0)};
    }
    ActuatorParameters actuator() {
        return {number(0.1, 50.0),
                number(0.0, 2.0),
                number(0.01, 9.0),
                coin() ? 0.0 : -number(0.01, 0.5),
                number(0.01, 0.5),
                number(0.001, 0.1),
                coin() ? 0.0 : number(0.0, 0.1)};
    }
    void add_vehicle(Drive& drive) {
        VehicleParameters car{number(500.0, 5000.0),
                              number(0.3, 0.7),
                              number(0.0, 2.0),
                              number(1e3, 1e4),
                              number(1e3, 1e4),
                              axle(),
                              axle(),
                              number(0.1, 1.0),
                              number(0.1, 1.5),
                              number(0.2, 0.5),
                              number(0.0, 1.0),
                              number(0.0, 1.0),
                              number(0.0, 3.0),
                              number(0.0, 0.1),
                              {},
                              coin() ? Solver::rosenbrock : Solver::dormand_prince,
                              number(1e-12, 1e-2)};
        for (int i = 0; i < whole(0, 3); ++i)
            car.road_steps.push_back({10.0 * i + number(0.0, 9.0), number(-0.1, 0.1)});
        if (coin()) {
            car.roll = RollParameters{number(100.0, 1e4), number(-1.0, -0.6), number(1.0, 2.0), number(1e6, 1e7), number(1e6, 1e7)};
            car.front.tyre_spring_n_per_m = car.rear.tyre_spring_n_per_m = number(1e6, 1e8); // or it falls over
        }
        if (coin())
            car.roughness = Roughness{static_cast<RoadClass>(whole(0, 7)), whole(0, 1000)};
        for (int i = 0; i < whole(0, 3); ++i)
            car.load_steps.push_back({10.0 * i + number(1.0, 9.0), number(-100.0, 100.0), number(-100.0, 100.0)});
        drive.vehicle = car;
        for (LampSet& lamp_set : drive.lamp_sets) {
            if (coin())
                lamp_set.levelling = LevellingParameters{coin() ? LevellingControl::slow : LevellingControl::dynamic, actuator()};
            if (coin())
                lamp_set.swivel = SwivelParameters{number(0.0, 5.0), actuator()};
        }
    }
    LampSet lamp_set(const std::string& named) {
        LampSet result{named, {}, {}};
        for (const char* lamp : {"left", "right", "null"}) {
            MountedLamp mounted;
            mounted.name = lamp;
            mounted.file = source().file;
            mounted.position_m = position();
            mounted.yaw_rad = number(-3.0, 3.0);
            mounted.pitch_rad = coin() ? number(-1.5, 1.5) : radians(number(-2.0, 2.0));
            mounted.roll_rad = coin() ? 0.0 : number(-1e-9, 1e-9);
            mounted.level = number(0.0, 1.0);
            mounted.voltage_v = number(12.0, 13.8);
            mounted.reference_voltage_v = number(12.0, 13.8);
            mounted.source = kind();
            mounted.colour = colour();
            mounted.photometric_distance_m = number(0.0, 25.0);
            result.lamps.push_back(mounted);
        }
        double time_s = 0.0;
        for (int i = 0; i < whole(0, 3); ++i)
            result.changes.push_back(change(time_s += coin() ? 0.0 : number(0.0, 2.0)));
        return result;
    }
    LampChange change(double time_s) {
        LampChange result{
            time_s, coin() ? "left" : "null", number(0.0, 1.0), maybe(-1.5, 1.5), maybe(-3.0, 3.0), maybe(-3.0, 3.0), nullptr, {}, {}};
        if (coin())
            result.file = source().file;
        if (coin())
            result.colour = colour();
        if (result.colour && coin())
            result.source = kind();
        return result;
    }
    View camera(int i) {
        View view;
        view.name = "view-" + std::to_string(i);
        view.position_m = position();
        view.yaw_rad = number(-6.0, 6.0);
        view.pitch_rad = number(-1.5, 1.5);
        view.roll_rad = number(-6.0, 6.0);
        view.vertical_fov_rad = number(0.01, 3.0);
        view.width_px = whole(1, 16384);
        view.height_px = whole(1, 16384);
        return view;
    }
    View map(int i) {
        View view;
        view.name = "map-" + std::to_string(i);
        view.projection = Projection::map;
        view.map_ahead_m = number(1.0, 500.0);
        view.map_behind_m = number(-0.5, 50.0);
        view.map_left_m = number(1.0, 50.0);
        view.map_right_m = number(0.0, 50.0);
        view.width_px = whole(1, 16384);
        view.height_px = whole(1, 16384);
        return view;
    }

    std::mt19937 random_;
    std::vector<LampSource> sources_;
};

class WriteDrive : public DriveFixture {
  protected:
    Drive back(const Drive& drive) {
        write_file(folder / "resolved.yaml", write_drive(drive));
        return read_drive(folder / "resolved.yaml");
    }
};

TEST_F(WriteDrive, AnyDriveComesBackToTheBit) {
    std::vector<LampSource> sources;
    for (const char* file : {"low.ies", "other.ies"})
        for (const BetweenSamples rule : {BetweenSamples::linear_cd, BetweenSamples::log_cd}) {
            LampReadOptions options;
            options.rule = rule;
            options.type_c_axis = rule == BetweenSamples::log_cd ? TypeCAxis::horizontal : TypeCAxis::automatic;
            sources.push_back({folder / file, options, std::make_shared<const LampFile>(read_lamp(folder / file, options))});
        }
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        const Drive drive = AnyDrive(seed, sources).make();
        const Drive again = back(drive);
        expect_same(drive, again);
        EXPECT_EQ(write_drive(drive), write_drive(again));
        if (HasFailure())
            break;
    }
}

TEST_F(WriteDrive, ADriveWithFlagsAppliedComesBack) {
    DriveEdits edits;
    edits.lamps = {{"", folder / "other.ies"}};
    edits.resolution = {{64, 48}};
    edits.capture_all = true;
    const Drive drive = read(minimal + "changes: [{at_s: 1, file: low.ies, source: arc, level: 0.5}]\n", edits);
    expect_same(drive, back(drive));
}

TEST_F(WriteDrive, LampsAreOfTheDriveWhoseTextIsWrittenLast) {
    const Drive outer = read(minimal);
    std::string text = minimal;
    const Drive inner = read(text.replace(text.find("low.ies"), 7, "other.ies"));
    const LampsAreOf lamps(outer);
    const std::string alone = write_fields(drive_fields(), outer, 0);
    EXPECT_THAT(alone, testing::HasSubstr("low.ies"));
    EXPECT_THAT(write_drive(inner), testing::HasSubstr("other.ies")) << "while those of another are told";
    EXPECT_EQ(write_fields(drive_fields(), outer, 0), alone) << "which go on";
}

TEST_F(WriteDrive, DegreesWhereTheyAreExact) {
    const std::string text = write_drive(read(minimal + "views: {v: {yaw_deg: 0.3, pitch_deg: -1}}\n"));
    EXPECT_THAT(text, testing::HasSubstr("yaw_deg: 0.3\n"));
    EXPECT_THAT(text, testing::HasSubstr("pitch_deg: -1\n"));
}

TEST_F(WriteDrive, TextureOptionsComeBack) {
    Drive drive = read(minimal);
    LampReadOptions& options = drive.lamp_sources.front().options;
    options.texture_scale_lx = 50.0 / 3.0;
    options.texture_distance_m = 10.0;
    options.texture_h_extent_deg[0] = -20.1;
    options.texture_h_extent_deg[1] = 20.2;
    const LampReadOptions again = back(drive).lamp_sources.front().options;
    EXPECT_EQ(again.texture_scale_lx, 50.0 / 3.0);
    EXPECT_EQ(again.texture_distance_m, 10.0);
    EXPECT_EQ(again.texture_h_extent_deg[0], -20.1);
    EXPECT_EQ(again.texture_h_extent_deg[1], 20.2);
    EXPECT_EQ(again.texture_v_extent_deg[0], again.texture_v_extent_deg[1]);
}

/// Drives that say nothing of shadows keep their text, and what is accepted of them, whatever methods and keys come to be.
TEST_F(WriteDrive, UsualShadowsAreOneWord) { EXPECT_THAT(write_drive(read(minimal)), testing::HasSubstr("\nshadows: true\n")); }

} // namespace
} // namespace fernlicht
