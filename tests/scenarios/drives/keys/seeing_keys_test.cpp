// measure's sensors and glare: read, refused, written back.
#include "tests/scenarios/drives/drive_fixture.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class SeeingKeys : public DriveFixture {
  protected:
    SeeingParameters seeing(const std::string& measure) { return read(minimal + "measure: {" + measure + "}\n").seeing; }
    std::string refused(const std::string& measure) { return refusal(minimal + "measure: {" + measure + "}\n"); }
};

TEST_F(SeeingKeys, AreOffUnlessAsked) {
    EXPECT_EQ(read(minimal).seeing, SeeingParameters{});
    EXPECT_EQ(seeing("extent: true"), SeeingParameters{});
    EXPECT_THAT(write_drive(read(minimal)), testing::AllOf(testing::Not(HasSubstr("sensors")), testing::Not(HasSubstr("glare"))));
}

TEST_F(SeeingKeys, AreReadAndHaveDefaults) {
    const SeeingParameters short_form = seeing("sensors: {points: {edge: {at_m: 90}}}, glare: {oncoming: {a: {at_m: 80}}, mirrors: true}");
    EXPECT_EQ(short_form.sensors->points, (std::vector<Sensor>{{"edge", 90.0, Across::own_centre, 0.25}}));
    EXPECT_EQ(short_form.sensors->thresholds_lx, SensorParameters{}.thresholds_lx);
    EXPECT_EQ(short_form.glare->oncoming, (std::vector<GlareObserver>{{"a", 80.0, 1.1, 0.0}}));
    EXPECT_EQ(short_form.glare->mirrors, MirrorParameters{});
    EXPECT_EQ(short_form.glare->equation, VeilingEquation::cie_general);
    EXPECT_EQ(short_form.glare->adaptation_cdm2, std::nullopt);
    const SeeingParameters long_form = seeing(
        "sensors: {thresholds_lx: [5], distances_m: [], points: {e: {at_m: 1, across: left-edge, above_m: 1.5}}}, glare: {oncoming: {a: "
        "{at_m: 80, eye_height_m: 2, look_ahead_m: 30}}, mirrors: {gaps_m: [10], eye_m: [1, 0, 1.5], reflectance: 0.4, places: {m: [2, 1, "
        "1]}}, equation: "
        "age-adjusted, age_years: 60, pigmentation: 1.2, adaptation_cdm2: 0.3, distances_m: [50], thresholds_lx: [2], thresholds_percent: "
        "[15], "
        "thresholds_de_boer: [4]}");
    EXPECT_EQ(long_form.sensors, (SensorParameters{{5.0}, {}, {{"e", 1.0, Across::left_edge, 1.5}}}));
    const GlareParameters expected{{{"a", 80.0, 2.0, 30.0}},
                                   MirrorParameters{{10.0}, {1.0, 0.0, 1.5}, 0.4, {{"m", {2.0, 1.0, 1.0}}}},
                                   VeilingEquation::age_adjusted,
                                   60.0,
                                   1.2,
                                   0.3,
                                   {50.0},
                                   {2.0},
                                   {15.0},
                                   {4.0}};
    EXPECT_EQ(long_form.glare, expected);
}

TEST_F(SeeingKeys, TolerancesAreStatedOrAssumed) {
    const ToleranceParameters assumed = seeing("tolerances: true").tolerances.value();
    EXPECT_EQ(assumed, ToleranceParameters{});
    EXPECT_EQ(tolerance_of(assumed, ToleranceKind::pitch).sigma, 0.1);
    EXPECT_EQ(tolerance_of(assumed, ToleranceKind::flux).sigma, 5.0);
    EXPECT_EQ(tolerance_of(assumed, ToleranceKind::height).sigma, 10.0);
    EXPECT_FALSE(tolerance_of(assumed, ToleranceKind::load).counts());
    const ToleranceParameters given =
        seeing("tolerances: {pitch_deg: 0.05, yaw_deg: {from: -1, to: 0.5, source: line 3}, roll_deg: {sigma: 0}, flux_percent: {mean: -2, "
               "sigma: 3}, limits: [{reading: reach_1lx_road_own_m, at_least: 20}], draws: 500, cars: 50, rendered: true, seed: 9}")
            .tolerances.value();
    EXPECT_EQ(given.pitch_deg->sigma, 0.05);
    EXPECT_TRUE(given.pitch_deg->source.empty());
    EXPECT_EQ(std::tie(given.yaw_deg->from, given.yaw_deg->to, given.yaw_deg->source),
              std::tuple(std::optional(-1.0), std::optional(0.5), "line 3"));
    EXPECT_FALSE(given.roll_deg->counts());
    EXPECT_EQ(given.flux_percent->mean, -2.0);
    EXPECT_EQ(std::tuple(given.limits.size(), given.draws, given.cars, given.rendered, given.seed), std::tuple(1U, 500, 50, true, 9));
    const Drive drive = read(minimal + "measure: {tolerances: {yaw_deg: {from: -1, to: 0.5, source: line 3}, height_mm: 4, roll_deg: 0, "
                                       "load_kg: {mean: 60, sigma: 0}}}\n");
    EXPECT_EQ(read(write_drive(drive)).seeing, drive.seeing);

    EXPECT_THAT(refused("tolerances: {yaw_deg: {from: -1}}"), HasSubstr("yaw_deg"));
    EXPECT_THAT(refused("tolerances: {yaw_deg: {from: -1, to: 1, sigma: 0.1}}"), HasSubstr("from beside sigma or mean"));
    EXPECT_THAT(refused("tolerances: {yaw_deg: {from: 1, to: -1}}"), HasSubstr("from 1 above to -1"));
    EXPECT_THAT(refused("tolerances: {pitch_deg: -0.1}"), HasSubstr("pitch_deg"));
    EXPECT_THAT(refused("tolerances: {load_kg: {mean: 60}}"), HasSubstr("sigma"));
    EXPECT_THAT(refused("tolerances: {flux_percent: {source: supplier}}"), HasSubstr("sigma"));
    EXPECT_TRUE(seeing("tolerances: {load_kg: {mean: 60, sigma: 0}}").tolerances->load_kg->counts()) << "all cars, by as much";
    EXPECT_THAT(refused("tolerances: {draws: 100, cars: 200}"), HasSubstr("200 cars in full of 100 drawn"));
    EXPECT_THAT(refused("tolerances: {limits: [{reading: a, at_least: 1}, {reading: a, at_most: 2}]}"), HasSubstr("second limit on a"));
}

TEST_F(SeeingKeys, VisibilityHomogeneityAndPlaces) {
    const SeeingParameters short_form = seeing("visibility: true, homogeneity: true, places: [kerb, markings]");
    EXPECT_EQ(short_form.visibility, VisibilityParameters{});
    EXPECT_EQ(short_form.homogeneity, HomogeneityParameters{});
    EXPECT_EQ(short_form.places, (PlaceParameters{true, false, true}));
    EXPECT_EQ(seeing("visibility: false, homogeneity: false"), SeeingParameters{});
    const SeeingParameters long_form = seeing("visibility: {targets: {card: true, sign: {size_m: 0.3, squares: 2, reflectance: 0.1, level: "
                                              "9, across: [left-edge]}}, dark_cdm2: 0.1, "
                                              "age_years: 60, time_s: 2, k: 3, ahead_m: 90, step_m: 0.5, distances_m: [40]}, homogeneity: "
                                              "{min_lx: 2, ahead_m: 70, patch_factor: 1.2}, places: {what: [boards], distances_m: [33]}");
    EXPECT_EQ(long_form.visibility,
              (VisibilityParameters{
                  {default_targets()[0], {"sign", 0.3, 2, 0.1, 9.0, {Across::left_edge}}}, 0.1, 60.0, 2.0, 3.0, 90.0, 0.5, {40.0}}));
    EXPECT_EQ(seeing("visibility: {targets: [pedestrian-light, card]}").visibility.value().targets,
              (std::vector<VisibilityTarget>{default_targets()[2], default_targets()[0]}));
    EXPECT_THAT(refused("visibility: {targets: [cart]}"),
                HasSubstr("found 'cart', expected one of card, pedestrian-dark, pedestrian-light"));
    EXPECT_THAT(refused("visibility: {targets: [card, card]}"), HasSubstr("'card' twice"));
    EXPECT_THAT(refused("visibility: {targets: {sign: true}}"), HasSubstr("true stands for card, pedestrian-dark, pedestrian-light alone"));
    EXPECT_THAT(refused("visibility: {targets: {card: {reflectance: 0.1, level: 7}}}"), HasSubstr("one of the usual targets"));
    EXPECT_THAT(refused("visibility: {targets: {sign: {reflectance: 0.1}}}"), HasSubstr("sign.level: missing"));
    EXPECT_EQ(long_form.homogeneity, (HomogeneityParameters{2.0, 70.0, 1.2}));
    EXPECT_EQ(long_form.places, (PlaceParameters{false, true, false, {33.0}}));
    EXPECT_THAT(refused("places: [kerbs]"), HasSubstr("measure.places[0]: found 'kerbs'"));
    EXPECT_THAT(refused("places: {distances_m: [3]}"), HasSubstr("measure.places.what: missing"));
    EXPECT_THAT(refused("visibility: {age_years: 20}"), HasSubstr("measure.visibility.age_years: found '20'"));
    EXPECT_THAT(refused("visibility: {target: [card]}"), HasSubstr("unknown key, expected 'targets'"));
    EXPECT_THAT(refused("homogeneity: {patch_factor: 1}"), HasSubstr("measure.homogeneity.patch_factor"));
}

TEST_F(SeeingKeys, AreWrittenAsTheyWereRead) {
    for (const char* measure :
         {"sensors: {points: {'1.5': {at_m: 0.1, across: right-edge}, 'null': {at_m: 2, across: oncoming-centre}}}",
          "glare: {oncoming: {a: {at_m: 80.3}}, mirrors: true, equation: stiles-holladay}", "glare: {mirrors: {places: {x: [1, 2, 3]}}}",
          ("visibility: {targets: {'1': {reflectance: 0.3, level: 8.5, across: [own-centre, right-edge]}, card: true}, k: 2.61}, "
           "homogeneity: {ahead_m: 77.7}, places: [boards, markings]"),
          "extent: false, probes: {p: {ahead_m: 3}}, glare: {oncoming: {a: {at_m: 1}}, thresholds_lx: [], distances_m: []}"}) {
        const Drive drive = read(minimal + "measure: {" + measure + "}\n");
        EXPECT_EQ(read(write_drive(drive)).seeing, drive.seeing) << measure;
    }
}

TEST_F(SeeingKeys, TheDazzledDriverMayHaveALampOfHisOwn) {
    const std::string lamp = FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/xenon-low.ies", glare = "measure: {glare: {mirrors: true, ";
    const Drive drive = read(minimal + glare + "adaptation_lamp: " + lamp + "}}\n");
    ASSERT_TRUE(drive.adaptation_lamp);
    EXPECT_EQ(drive.adaptation_lamp->table.cd, read_lamp(lamp, {}).table.cd);
    EXPECT_EQ(std::ranges::count(drive.opened, std::filesystem::path(lamp), &FileRead::path), 1) << "among what decides the results";
    EXPECT_EQ(read(minimal).adaptation_lamp, nullptr);
    const Drive mirrored = read(minimal + glare + "adaptation_lamp: {file: " + lamp + ", mirrored: true}}}\n");
    EXPECT_NE(mirrored.adaptation_lamp->table.cd, drive.adaptation_lamp->table.cd);
    for (const Drive* each : {&drive, &mirrored}) {
        const Drive again = read(write_drive(*each));
        EXPECT_EQ(again.seeing, each->seeing);
        EXPECT_EQ(again.adaptation_lamp->table.cd, each->adaptation_lamp->table.cd);
    }
    EXPECT_THAT(refused("glare: {mirrors: true, adaptation_cdm2: 1, adaptation_lamp: " + lamp + "}"),
                HasSubstr("measure.glare.adaptation_lamp: adaptation_lamp beside adaptation_cdm2, expected one of them"));
    EXPECT_THAT(refused("glare: {mirrors: true, adaptation_lamp: none.ies}"),
                HasSubstr("measure.glare.adaptation_lamp: there is no file none.ies"));
}

TEST_F(SeeingKeys, RefuseWhatTheyCannotUse) {
    EXPECT_THAT(refused("glare: {}"), HasSubstr("measure.glare: glare without eyes, expected oncoming"));
    EXPECT_THAT(refused("glare: {mirrors: false}"), HasSubstr("glare without eyes"));
    EXPECT_THAT(refused("glare: {oncoming: {a: {at: 3}}}"), HasSubstr("unknown key, expected 'at_m'"));
    EXPECT_THAT(refused("glare: {oncoming: {a: {}}}"), HasSubstr("measure.glare.oncoming.a.at_m: missing"));
    EXPECT_THAT(refused("glare: {mirrors: true, equation: cie}"), HasSubstr("measure.glare.equation: found 'cie'"));
    EXPECT_THAT(refused("glare: {mirrors: true, age_years: 5}"), HasSubstr("measure.glare.age_years: found '5'"));
    EXPECT_THAT(refused("glare: {mirrors: {eye_m: [1, 1, 1], places: {m: [1, 1, 1]}}}"), HasSubstr("a mirror in the driver's eye"));
    EXPECT_THAT(refused("glare: {mirrors: {places: {}}}"), HasSubstr("measure.glare.mirrors.places"));
    EXPECT_THAT(refused("glare: {mirrors: true, thresholds_de_boer: [0.5]}"), HasSubstr("thresholds_de_boer"));
    for (const char* edges : {"[15]", "[15, 15]", "[60, 30]"})
        EXPECT_THAT(refused(fmt::format("glare: {{mirrors: true, ranges_m: {}}}", edges)), HasSubstr("edges that make no ranges")) << edges;
    EXPECT_EQ(seeing("glare: {mirrors: true, ranges_m: []}").glare->ranges_m.size(), 0U);
    EXPECT_THAT(refused("sensors: {}"), HasSubstr("measure.sensors.points: missing"));
    EXPECT_THAT(refused("sensors: {points: {a: {at_m: 3, across: kerb}}}"), HasSubstr("found 'kerb'"));
    EXPECT_THAT(refused("sensors: {points: {a: {at_m: -3}}}"), HasSubstr("measure.sensors.points.a.at_m: found '-3'"));
    EXPECT_THAT(refused("sensor: {}"), StartsWith("drive.yaml:7:11: measure.sensor: unknown key, expected 'sensors'"));
}

} // namespace
} // namespace fernlicht
