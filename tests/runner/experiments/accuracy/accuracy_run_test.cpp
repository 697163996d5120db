// Accuracy through the program: a real drive in, files out; and what it says of pictures that are wrong by a known amount.
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/accuracy/technique_sweep.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"
#include "tests/trial.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

json checked_accuracy(const std::filesystem::path& file) { return tests::checked(content_of(file), accuracy_members); }

/// What `accuracy` finds, its files in `folder`/out; `said`: what it prints.
json results_of(const TemporaryFolder& folder, const std::string& flags, const std::string& drives, std::string* said = nullptr) {
    const std::string text = printed("accuracy --quiet " + flags + " --out " + (folder / "out ") + drives);
    if (said)
        *said = text;
    return checked_accuracy(folder / "out/accuracy.json");
}

double error_of(const json& diagrams, std::size_t diagram, std::size_t row) {
    return diagrams.at(diagram).at("rows").at(row).at("error").at("value").get<double>();
}

const json& row_of(const json& rows, const std::string& label) { return tests::entry(rows, "label", label); }

TEST(AccuracyRun, HoldsTechniquesAgainstTheReference) {
    const TemporaryFolder folder;
    const json accuracy =
        results_of(folder,
                   "--count 1 --rounds 6 --max-samples 32 --resolutions 128x96,64x48 --shadow-maps 256x128 --beams float,64x32x8 "
                   "--techniques plain,full,light-map-2d,photometric",
                   library_file("drives/straight.yaml"));
    const json& all = accuracy.at("drives").at(0).at("configurations");
    ASSERT_EQ(all.size(), 8U); // four techniques, two of them at another resolution and with other beams
    const json &ours = row_of(all, "photometric"), &full = row_of(all, "full");
    EXPECT_LT(ours.at("road").at("relative").at("median"),
              0.005);                                            // what 32 samples leave
    EXPECT_GT(full.at("road").at("relative").at("median"), 0.5); // the cosine is missing
    EXPECT_GT(full.at("road").at("mean"), 0.5);
    EXPECT_GT(row_of(all, "photometric, beams 64x32x8").at("road").at("relative").at("median"),
              3.0 * ours.at("road").at("relative").at("median").get<double>());
    EXPECT_LT(row_of(all, "photometric, beams 64x32x8").at("texture_bytes"), ours.at("texture_bytes"));
    for (const json& reach : ours.at("reach"))
        EXPECT_LT(std::abs(reach.at("worst_m").get<double>()), 1.0);
    EXPECT_GT(row_of(all, "full").at("reach").at(0).at("worst_m"), 10.0);
    EXPECT_EQ(full.at("target").at("not_measured"), "technique full does not compute the illuminance of targets");
    EXPECT_EQ(row_of(all, "plain").at("road").at("not_measured"), "technique plain does not compute an illuminance");
    EXPECT_EQ(ours.at("frame_s").size(), 6U);
    EXPECT_TRUE(ours.at("road").contains("area_m2") && ours.at("target").contains("area_m2"));
    for (const char* not_of_road : {"whole_view", "luminance"}) { // a count of pixels is no area
        EXPECT_FALSE(ours.at(not_of_road).contains("area_m2") || ours.at(not_of_road).contains("percent_of_area_beyond"));
        EXPECT_TRUE(ours.at(not_of_road).contains("percent_of_pixels_beyond"));
    }
    const json& drive = accuracy.at("drives").at(0);
    EXPECT_LT(drive.at("twin").at("flat").at("relative").at("p99"), 1e-4);
    EXPECT_GT(drive.at("twin").at("flat").at("pixels"), 1000);
    const json& prices = drive.at("simplifications");
    EXPECT_GT(prices.at(0).at("road").at("relative").at("median"), 1.0); // no cosine
    EXPECT_LT(prices.at(1).at("road").at("mean"), 0.0);                  // 1 + d^2 is too dark
    EXPECT_LT(prices.at(1).at("road").at("relative").at("p95"), 0.1);
    EXPECT_GT(prices.at(6).at("road").at("relative").at("median"), prices.at(5).at("road").at("relative").at("median")); // 8 bits on top
    const json& techniques = accuracy.at("diagrams").at(0);
    for (const json& row : techniques.at("rows"))
        EXPECT_EQ(row.at("error").is_null() ? 0 : 1, (row.at("on_front").get<bool>() ? 1 : 0) + (row.at("beaten_by").is_null() ? 0 : 1));
    EXPECT_GT(row_of(techniques.at("rows"), "full").at("error").at("value"), 50.0);
    EXPECT_EQ(row_of(techniques.at("rows"), "full").at("seconds").at("timings"), 6);
    EXPECT_EQ(row_of(techniques.at("rows"), "full").at("seconds").at("interval"), "95 % interval of the median");
    EXPECT_THAT(content_of(folder / "out/accuracy.html"), HasSubstr("medians of 6 rounds with their 95 % intervals"));
    EXPECT_THAT(accuracy.at("missing"), IsEmpty());
    EXPECT_FALSE(row_of(techniques.at("rows"), "plain").at("on_front"));
    EXPECT_EQ(accuracy.at("diagrams").at(1).at("rows").size(), 4U);
    for (const char* name : {"accuracy.csv", "accuracy.html", "techniques-straight-1-128x96.svg", "techniques-straight-1-128x96.png"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));
    EXPECT_THAT(content_of(folder / "out/accuracy.html"), HasSubstr("not measured"));
}

/// A short moment of a drive that leaves the method to us: what is drawn by is named wherever it is shown.
TEST(AccuracyRun, NamesTheShadowMethodThatAutoChose) {
    const TemporaryFolder folder;
    std::ofstream(folder / "auto.yaml") << "fernlicht: 1\nname: auto-1\nroad: \"" << library_file("roads/straight.xodr")
                                        << "\"\nspeed_kmh: 72\nrate_hz: 10\nduration_s: 0.2\nshadows: auto\nlamp_sets:\n  one: {file: \""
                                        << library_file("lamps/halogen-low.ies") << "\"}\n";
    std::string said;
    const json accuracy = results_of(folder,
                                     "--diagrams shadows --count 1 --rounds 1 --max-samples 16 --resolutions 64x48 --beams float "
                                     "--techniques photometric --shadow-maps 64x64",
                                     folder / "auto.yaml", &said);
    const std::string choice = "auto chose none: nothing stands in a beam in any of 2 moments";
    EXPECT_THAT(said, HasSubstr("Shadows where no method is named: " + choice));
    const json& drive = accuracy.at("drives").at(0);
    EXPECT_EQ(drive.at("shadow_choice"), choice);
    EXPECT_EQ(row_of(drive.at("configurations"), "photometric").at("shadows"), "none");
    EXPECT_EQ(row_of(drive.at("configurations"), "photometric, shadows map").at("shadows"), "map");
    ASSERT_EQ(accuracy.at("diagrams").size(), 2U);
    for (const json& diagram : accuracy.at("diagrams")) {
        EXPECT_EQ(row_of(diagram.at("rows"), "photometric, shadows none").at("parameters").at("shadows"), "none");
        EXPECT_THAT(diagram.at("notes").dump(), HasSubstr("shadows where no method is named: none, the drive's own (" + choice));
    }
    EXPECT_THAT(content_of(folder / "out/accuracy.html"), HasSubstr("Shadows where no method is named: " + choice));
}

TEST(AccuracyRun, ShadowMethodsStandBesideTheTechniques) {
    const TemporaryFolder folder;
    const json accuracy = results_of(folder,
                                     "--diagrams shadows --count 1 --rounds 1 --max-samples 16 --resolutions 64x48 --beams float "
                                     "--techniques photometric,light-map-2d --shadow-maps 256x128",
                                     library_file("drives/shelter.yaml"));
    const json& rows = accuracy.at("diagrams").at(0).at("rows");
    EXPECT_EQ(rows.size(), 1 + shadow_method_names().size()); // light-map-2d; photometric by the drive's own and each other method
    EXPECT_EQ(row_of(rows, "photometric, shadows none").at("parameters").at("shadows"), "none");
    EXPECT_EQ(row_of(rows, "photometric, shadows map").at("parameters").at("shadows"), "map"); // the drive's own, named like the others
    EXPECT_THAT(accuracy.at("diagrams").at(0).at("notes").dump(), HasSubstr("shadows where no method is named: map, the drive's own\""));
    EXPECT_TRUE(accuracy.at("drives").at(0).at("shadow_choice").is_null());
    // Held against the light with shadows, in which light without any is too bright.
    const json& all = accuracy.at("drives").at(0).at("configurations");
    EXPECT_GT(row_of(all, "photometric, shadows none").at("whole_view").at("mean"),
              row_of(all, "photometric").at("whole_view").at("mean").get<double>());
    for (const json& reach : row_of(all, "photometric").at("reach")) // of the own lamps, in both: another car comes towards us here
        EXPECT_TRUE(reach.at("surface") != "road" || std::abs(reach.at("worst_m").get<double>()) < 1.0) << reach;
}

TEST(AccuracyRun, OneRoundMakesNobodySurelyFaster) {
    const TemporaryFolder folder;
    std::string said;
    const json accuracy = results_of(folder,
                                     "--count 1 --rounds 1 --max-samples 16 --resolutions 64x48 --shadow-maps 256x128 "
                                     "--beams float --techniques full,full-no-sun,merged-beams,photometric",
                                     library_file("drives/straight.yaml"), &said);
    EXPECT_THAT(said, HasSubstr(", perhaps"));
    EXPECT_THAT(said, HasSubstr("straight-1, halogen: 1 moment. The reference"));
    const std::string page = content_of(folder / "out/accuracy.html");
    EXPECT_THAT(page, HasSubstr("Times are of one round, whose spread is unknown: nobody is surely faster"));
    EXPECT_THAT(page, Not(HasSubstr(">beaten by "))); // of a row, which would be sure
    int beaten = 0;
    for (const json& row : accuracy.at("diagrams").at(0).at("rows")) {
        beaten += row.at("beaten_by").is_null() ? 0 : 1;
        EXPECT_FALSE(row.at("beaten_surely"));
        EXPECT_EQ(row.at("seconds").at("interval"), "one timing");
    }
    EXPECT_GT(beaten, 0);
}

/// Interrupted at `sign`; the JSON is checked against its schema.
json interrupted(const TemporaryFolder& folder, const std::string& flags, const std::string& sign) {
    const Outcome run = run_interrupted(
        "accuracy --count 3 --max-samples 16 --resolutions 64x48 --shadow-maps 256x128 --beams float --techniques full,photometric " +
            flags + " --log-json --out " + (folder / "out ") + library_file("drives/straight.yaml"),
        sign);
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("missing: drive straight-1: "));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));
    json accuracy = checked_accuracy(folder / "out/accuracy.json");
    EXPECT_EQ(accuracy.at("interrupted"), "interrupted by the user");
    EXPECT_THAT(content_of(folder / "out/accuracy.html"), HasSubstr(accuracy.at("missing").at(0).get<std::string>()));
    return accuracy;
}

TEST(AccuracyRun, InterruptedKeepsWhatWasCompared) {
    const TemporaryFolder folder;
    // Steps of a moment: from above, from the seat, two ways. After six the second moment's ways are next.
    const json accuracy = interrupted(folder, "--rounds 8", ": 6/20 ");
    const json& drive = accuracy.at("drives").at(0);
    ASSERT_EQ(drive.at("configurations").size(), 2U);
    for (const json& found : drive.at("configurations")) {
        EXPECT_GE(found.at("moments"), 1);
        EXPECT_LT(found.at("moments"), 3);
        EXPECT_GT(found.at("road").at("pixels"), 100);
    }
    EXPECT_THAT(accuracy.at("missing").at(0).get<std::string>(), HasSubstr("of 3 moments were compared"));
    EXPECT_THAT(accuracy.at("missing").at(1).get<std::string>(), HasSubstr("all times"));
}

TEST(AccuracyRun, InterruptedKeepsTheRoundsTaken) {
    const TemporaryFolder folder;
    const json accuracy = interrupted(folder, "--rounds 988", " 100/1000 "); // 12 steps for the errors
    const json& found = accuracy.at("drives").at(0).at("configurations").at(0);
    EXPECT_EQ(found.at("moments"), 3);
    EXPECT_GT(found.at("frame_s").size(), 0U);
    EXPECT_LT(found.at("frame_s").size(), 988U);
    EXPECT_TRUE(row_of(accuracy.at("diagrams").at(0).at("rows"), "full").at("not_measured").is_null());
    EXPECT_THAT(accuracy.at("missing").at(0).get<std::string>(), HasSubstr("of 988 rounds were taken"));
}

TEST(AccuracyRun, StudiesWhatIsNoTechnique) {
    const TemporaryFolder folder;
    const json accuracy = results_of(folder, "--diagrams extent,metrics,reference", library_file("drives/straight.yaml"));
    EXPECT_THAT(accuracy.at("drives"), IsEmpty());
    const json& diagrams = accuracy.at("diagrams");
    ASSERT_EQ(diagrams.size(), 4U); // the reference's two ways, grid, comparisons
    const auto error = [&](std::size_t diagram, std::size_t row) { return error_of(diagrams, diagram, row); };
    EXPECT_LT(error(0, 3), 0.25 * error(0, 0)); // 64 times the samples: an eighth or less, if all goes as the root
    EXPECT_LT(error(1, 2), 0.75 * error(1, 0)); // 256, and 128 where 16 are asked for: paths take no fewer
    EXPECT_GT(error(2, 0), error(2, 3));        // cells of 4 m and 0.5 m
    EXPECT_EQ(error(3, 0), 0.0);                // every pixel
    EXPECT_GT(error(3, 7), 0.0);
}

/// A foggy and wet road; a dry one with lamps beside it; one with nothing to weigh.
TEST(AccuracyRun, WeighsWhatIsInTheAirAndOnTheRoad) {
    const TemporaryFolder folder;
    const std::string head = "fernlicht: 1\nroad: " + library_file("roads/straight.xodr") +
                             "\nspeed_kmh: 50\nduration_s: 0.4\nrate_hz: 10\n" +
                             "lamp_sets: {halogen: {file: " + library_file("lamps/halogen-low.ies") + "}}\n";
    const std::string foggy = folder / "foggy.yaml", lit = folder / "lit.yaml";
    std::ofstream(foggy) << head << "name: foggy\nweather: {fog: {visibility_m: 200}, wetness: 1}\n";
    std::ofstream(lit) << head << "name: lit\nstreet_lamps: {row: {file: " << library_file("lamps/street-6000lm.ies")
                       << ", first_m: 40, last_m: 60}}\n";
    const json diagrams = results_of(folder, "--diagrams weather", foggy + " " + lit).at("diagrams");
    ASSERT_EQ(diagrams.size(), 3U);
    const auto error = [&](std::size_t diagram, std::size_t row) { return error_of(diagrams, diagram, row); };
    EXPECT_EQ(diagrams.at(0).at("name"), "fog-foggy");
    EXPECT_LT(error(0, 6), 0.5 * error(0, 0)); // 256 midpoints and 4
    EXPECT_GT(error(0, 7), 20.0);              // left out
    for (std::size_t diagram = 1; diagram < 3; ++diagram) {
        const std::size_t last = diagrams.at(diagram).at("rows").size() - 1;
        EXPECT_GT(error(diagram, last), 1.5 * error(diagram, 0)) << diagram; // leaving it out costs more than drawing it
    }
    EXPECT_GE(error(2, 4), error(2, 0)); // from 5 lx on, from 0.005 lx on

    const Outcome clear =
        run_program("accuracy --quiet --diagrams weather --out " + (folder / "clear ") + library_file("drives/straight.yaml"));
    EXPECT_EQ(clear.exit_code, 1) << "nothing to measure";
}

TEST(AccuracyRun, RefusesWhatItCannotUse) {
    const std::string drive = library_file("drives/straight.yaml");
    for (const std::string& flags :
         tests::each_of({{"", "--techniques no-such|--techniques full,full|--techniques photometric,|--techniques ,full|"
                              "--resolutions 8x8|--resolutions 64|--resolutions 64x48,,32x24|--lamp-set neon|--count 100000|"
                              "--count 0|--count x|--target-error 0|--beams 64x32|--beams 64x32x12|--beams 1x1x8|--beams float,|"
                              "--shadow-maps 64x64,|--diagrams all,nonsense|--diagrams ,extent|--no-such-flag"}})) {
        const TemporaryFolder folder;
        const std::string said = printed("accuracy --quiet " + flags + " --out " + (folder / "out ") + drive, 2);
        EXPECT_TRUE(said.starts_with("fernlicht: ")) << said;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << flags;
    }
}

class PictureErrors : public testing::Test {
  protected:
    /// Drawn by photometric, then made `factor` times as bright.
    ConfigurationResult drawn(float factor) {
        ReferenceSettings settings;
        settings.footprint = Footprint::centre; // no noise: what is found was planted
        Drive measured = stage.drive;
        measured.extent->thresholds_lx = {1.0, 5.0};
        const std::vector<Moment> moments = moments_at({5}, stage, stage.drive.lamp_sets.front());
        ReferencePictures references(stage, measured, device, moments, settings);
        const View view = at_size(*driver_view(stage.drive), 128, 96);
        references.add_driver(0, view);
        references.add_map(0);
        Renderer renderer(device, stage.scene, {});
        const Draw draw = [&](const Moment& moment, const View& at, const FrameOutputs& outputs) {
            Frame frame = renderer.draw(moment, at, outputs);
            for (Image<float>* picture : {&frame.illuminance_lx, &frame.target_lx, &frame.luminance_cdm2})
                for (float& value : picture->pixels())
                    value *= factor;
            return [frame] { return frame; };
        };
        ConfigurationErrors errors(references, renderer.technique(), {"photometric", 128, 96, {}, {}, ""}, view, 1.0);
        errors.add(0, draw);
        return errors.finish();
    }

    Stage stage{read_drive(library_file("drives/straight.yaml"))};
    Device device = open_device("auto");
};

TEST_F(PictureErrors, AFrameTwoPerCentTooBrightShowsAsTwoPerCent) {
    const ConfigurationResult right = drawn(1.0F), bright = drawn(1.02F);
    ASSERT_TRUE(right.road && bright.road && bright.target && bright.whole);
    EXPECT_GT(right.road->pixels, 1000U);
    EXPECT_LT(right.road->error.p95, 1e-4);
    EXPECT_NEAR(bright.road->error.median, 0.02, 1e-4);
    EXPECT_NEAR(bright.road->error.p95, 0.02, 1e-3);
    EXPECT_NEAR(bright.target->error.median, 0.02, 1e-3);
    EXPECT_GT(bright.road->percent_beyond[0], 99.0);
    EXPECT_LT(bright.road->percent_beyond[1], 1.0);
    for (std::size_t i = 0; i < right.reach.size(); ++i) {
        EXPECT_LT(std::abs(right.reach[i].worst_m), 0.01);
        EXPECT_GT(bright.reach[i].worst_m, 0.0); // more light reaches farther
    }
}

TEST(RoadAreas, AddUpToTheRoadInView) {
    // A camera 10 m above a straight road, looking straight down: every pixel shows the same area.
    const Stage stage(read_drive(library_file("drives/straight.yaml")));
    Device device = open_device("auto");
    Renderer renderer(device, stage.scene, {});
    const Moment moment = moments_at({0}, stage, stage.drive.lamp_sets.front()).front();
    View view;
    view.position_m = {5.0, 0.0, 10.0};
    view.pitch_rad = -radians(90.0);
    view.vertical_fov_rad = 2.0 * std::atan(0.1); // 2 m high on the road
    view.width_px = view.height_px = 40;
    Image<float> areas = road_areas_m2(stage.scene, moment, view, renderer.draw(moment, view, {.depth = true, .ids = true}));
    double sum = 0.0;
    for (const float area : areas.pixels())
        sum += static_cast<double>(area);
    EXPECT_NEAR(sum, 4.0, 0.01); // a road of 2.5 % crossfall is 0.03 % larger
    view.pitch_rad = radians(30.0);
    areas = road_areas_m2(stage.scene, moment, view, renderer.draw(moment, view, {.depth = true, .ids = true}));
    for (const float area : areas.pixels())
        EXPECT_EQ(area, -1.0F); // the sky is no road
}

TEST(AccuracySweep, VariesOneAtATime) {
    const Drive drive = read_drive(library_file("drives/straight.yaml"));
    SweepRequest request;
    std::vector<std::string> names;
    for (const Configuration& c : configurations_of(request, drive))
        names.push_back(name_of(c));
    EXPECT_EQ(names.size(), techniques().size() + 2 * 2 + 3 + 2 * 4); // resolutions, shadow maps, beams
    EXPECT_THAT(names, testing::IsSupersetOf({"plain", "photometric, 512x384", "full, 256x192", "photometric, shadow maps 2048x1024",
                                              "full, beams 512x128x8", "photometric, beams 2048x1024x16"}));
    request.techniques = {"full", "photometric"};
    request.full = true;
    EXPECT_EQ(configurations_of(request, drive).size(), 3U * 4U * 5U + 3U * 5U); // shadow maps mean nothing to full
}

TEST(AccuracyDocument, SaysThatOthersDisturbedTheTimes) {
    AccuracyResult result;
    result.cores = 2;
    result.others.cores = 0.1;
    EXPECT_THAT(document_text(document(result)), testing::Not(HasSubstr("others used")));
    result.others.cores = 1.5;
    EXPECT_THAT(document_text(document(result)), HasSubstr("others used 1.50 of the machine's 2 cores"));
}

} // namespace
} // namespace fernlicht
