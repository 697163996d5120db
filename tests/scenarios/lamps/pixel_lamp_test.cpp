// Lamps of pixels: what they add up to, what they do over time, and what is wrong with their files.
#include "scenarios/lamps/level_track.h"
#include "scenarios/lamps/pixel_lamp.h"
#include "scenarios/values/picture_decoding.h"
#include "tests/scenarios/lamps/lamp_trial.h"
#include "tests/shipped.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

const std::string head = "fernlicht_pixel_lamp: 1\n";
std::string raster(const std::string& more = "cd: 1000") {
    return head + "raster: {pixels: [4, 3], h_deg: [-8, 8], v_deg: [-3, 3], spread_deg: [0.5, 0.25], " + more + "}\n";
}

class Pixels : public LampTrial {
  protected:
    std::shared_ptr<const LampFile> lamp(const std::string& text) const {
        return std::make_shared<const LampFile>(read("pixels.yaml", text));
    }
    std::string levels_refusal(const std::string& text) const {
        FilesRead opened;
        return tests::refusal_of([&] { read_levels(write("levels.csv", text), lamp(raster()), opened); }, "");
    }
};

std::vector<float> only(std::size_t pixel, float level = 1.0F, std::size_t count = 12) {
    std::vector<float> levels(count, 0.0F);
    levels[pixel] = level;
    return levels;
}

/// A box 4 degrees wide and 2 high, blurred by 0.5 and 0.25 degrees. At a corner a quarter of it is left; beyond one edge by a standard
/// deviation 0.158655 of it, Phi(-1).
TEST_F(Pixels, OneIsABlurredBox) {
    const auto file = lamp(raster());
    const CandelaTable one = file->pixels->table(only(5)); // second row, second column: H -4 to 0, V -1 to 1
    const auto at = [&](double h, double v) { return intensity_cd(one, h, v) / 1000.0; };
    EXPECT_NEAR(at(-2.0, 0.0), std::pow(std::erf(4.0 / std::sqrt(2.0)), 2), 1e-5);
    EXPECT_NEAR(at(0.0, 0.0), 0.5, 1e-3);
    EXPECT_NEAR(at(0.0, 1.0), 0.25, 1e-3);
    EXPECT_NEAR(at(0.5, 0.0), 0.158655, 1e-3);
    EXPECT_NEAR(at(-2.0, 1.25), 0.158655, 2e-3);
    EXPECT_EQ(at(4.0, 0.0), 0.0) << "beyond five standard deviations of blur";
    const AngleBox box = file->pixels->lights(5);
    EXPECT_EQ(box, (AngleBox{-4.0, 0.0, -1.0, 1.0}));
    EXPECT_EQ(file->pixels->lights(0), (AngleBox{-8.0, -4.0, 1.0, 3.0})) << "the first is at the top left";
}

TEST_F(Pixels, TogetherTheyLightTheFieldEvenly) {
    const auto file = lamp(raster());
    for (double h = -5.0; h <= 5.0; h += 0.7)
        EXPECT_NEAR(intensity_cd(file->table, h, 1.2), 1000.0, 1e-3) << h;
    EXPECT_NEAR(intensity_cd(file->table, 8.0, 0.0), 500.0, 1.0) << "the field's own border is blurred";
    // 16 by 6 degrees of 1000 cd near the horizon; blur takes nothing away.
    EXPECT_NEAR(flux_lm(file->table), 1000.0 * radians(16.0) * 2.0 * std::sin(radians(3.0)), 0.02);
    EXPECT_EQ(file->format, "pixel lamp, 12 pixels");
}

TEST_F(Pixels, LightAddsUp) {
    for (const std::string& text : {raster(), raster("cd: 1000, crosstalk: 0.3, dead: [[0, 0], [3, 2]]")}) {
        const auto file = lamp(text);
        CandelaTable total = file->pixels->table(std::vector<float>(12, 0.0F));
        std::vector<float> levels;
        for (std::size_t i = 0; i < 12; ++i) {
            levels.push_back(static_cast<float>(i) / 16.0F);
            const CandelaTable one = file->pixels->table(only(i, levels.back()));
            for (std::size_t k = 0; k < total.cd.size(); ++k)
                total.cd[k] += one.cd[k];
        }
        const CandelaTable at_once = file->pixels->table(levels);
        for (std::size_t k = 0; k < total.cd.size(); ++k)
            ASSERT_NEAR(at_once.cd[k], total.cd[k], 1e-9);
    }
}

TEST_F(Pixels, NeighboursSendWhatAPixelLoses) {
    const auto file = lamp(raster("cd: 1000, crosstalk: 0.2"));
    const CandelaTable one = file->pixels->table(only(5));
    EXPECT_NEAR(intensity_cd(one, -2.0, 0.0), 800.0, 0.2);
    for (const auto& [h, v] : {std::pair(-6.0, 0.0), {2.0, 0.0}, {-2.0, 2.0}, {-2.0, -2.0}})
        EXPECT_NEAR(intensity_cd(one, h, v), 50.0, 0.1) << h << ' ' << v;
    EXPECT_NEAR(flux_lm(one), flux_lm(lamp(raster())->pixels->table(only(5))), 1e-3) << "but for the cosine of V";
}

TEST_F(Pixels, DeadOnesStayDark) {
    const auto file = lamp(raster("cd: 1000, dead: [[1, 1]]"));
    EXPECT_LT(intensity_cd(file->table, -2.0, 0.0), 1.0);
    EXPECT_NEAR(intensity_cd(file->table, 2.0, 0.0), 1000.0, 0.1);
    EXPECT_THAT(file->notes, testing::Contains("1 of 12 pixels dead"));
}

TEST_F(Pixels, AProfileSaysWhatEachShines) {
    write("all.csv", "# unit: cd\nV\\H; -8; 8\n-3; 0; 1600\n3; 0; 1600\n"); // 100 cd a degree
    const auto file = lamp(raster("profile: all.csv"));
    EXPECT_NEAR(intensity_cd(file->pixels->table(only(4)), -6.0, 0.0), 200.0, 0.1);
    EXPECT_NEAR(intensity_cd(file->pixels->table(only(7)), 6.0, 0.0), 1400.0, 0.5);
    EXPECT_EQ(file->opened.size(), 2U) << "the profile counts among the files";
}

TEST_F(Pixels, SegmentsAndABaseAddUpAsTheirFilesSay) {
    write("a.csv", "# unit: cd\nV\\H; -6; -2; 0\n-1; 0; 900; 0\n2; 0; 400; 0\n");
    write("b.csv", "# unit: cd\nV\\H; -1; 3; 6\n-2; 0; 700; 0\n1; 0; 500; 0\n");
    write("base.csv", "# unit: cd\nV\\H; -10; 10\n-4; 100; 100\n4; 100; 100\n");
    const auto file = lamp(head + "base: base.csv\nsegments: [{file: a.csv}, {file: b.csv, lights: {h_deg: [0, 5], v_deg: [-1, 1]}}]\n");
    const CandelaTable mixed = file->pixels->table(std::vector{0.5F, 1.0F});
    EXPECT_NEAR(intensity_cd(mixed, -2.0, -1.0), 100.0 + 0.5 * 900.0, 1e-9);
    EXPECT_NEAR(intensity_cd(mixed, 3.0, 1.0), 100.0 + 500.0, 1e-9);
    EXPECT_EQ(file->pixels->lights(0), (AngleBox{-2.0, -2.0, -1.0, 2.0})) << "where it has 5 % of its peak";
    EXPECT_EQ(file->pixels->lights(1), (AngleBox{0.0, 5.0, -1.0, 1.0}));
    EXPECT_EQ(file->opened.size(), 4U);
}

/// Of two programs that write the same place with another last digit.
TEST_F(Pixels, AxesThatDifferByARoundingAreOne) {
    write("a.csv", "# unit: cd\nV\\H; -6; -2; 0\n-1; 0; 900; 0\n2; 0; 400; 0\n");
    write("b.csv", "# unit: cd\nV\\H; -6.000000001; -1.999999999; 0\n-1.000000001; 300; 100; 0\n2; 0; 400; 0\n");
    const auto file = lamp(head + "segments: [{file: a.csv}, {file: b.csv}]\n");
    EXPECT_EQ(file->table.h_deg, (std::vector{-6.0, -2.0, 0.0}));
    EXPECT_EQ(file->table.v_deg, (std::vector{-1.0, 2.0}));
    EXPECT_NEAR(intensity_cd(file->table, -6.0, -1.0), 300.0, 1e-9);
    EXPECT_NEAR(intensity_cd(file->table, -2.0, -1.0), 1000.0, 1e-9);
}

TEST_F(Pixels, AMirroredLampIsTheOtherWayRound) {
    const auto file = lamp(raster("cd: 1000, dead: [[0, 1]]"));
    const LampFile other = read_lamp(write("pixels.yaml", raster("cd: 1000, dead: [[0, 1]]")), {.mirrored = true});
    const std::vector<float> levels = only(6);
    EXPECT_EQ(other.table.cd, mirrored(file->table).cd);
    EXPECT_NEAR(intensity_cd(other.pixels->table(levels), 2.0, 0.0), 1000.0, 0.2) << "a place in the picture stays";
    EXPECT_LT(intensity_cd(other.table, 6.0, 0.0), 1.0);
}

TEST_F(Pixels, WhatIsWrongIsSaid) {
    const auto said = [&](const std::string& text) { return refusal("pixels.yaml", text); };
    EXPECT_EQ(said(raster()), "");
    EXPECT_THAT(said(head), HasSubstr("raster: missing, expected raster or segments"));
    EXPECT_THAT(said("fernlicht_pixel_lamp: 2\n"), HasSubstr("1, the version of pixel lamps"));
    EXPECT_THAT(said(raster("cd: 1, dead: [[4, 0]]")), HasSubstr("pixel [4, 0], expected pixels below [4, 3]"));
    EXPECT_THAT(said(raster("cd: 1, profile: x.csv")), HasSubstr("a profile beside cd"));
    EXPECT_THAT(said(raster("crosstalk: 0.1")), HasSubstr("cd: missing, expected cd or profile"));
    EXPECT_THAT(said(raster("profile: none.csv")), HasSubstr("there is no file"));
    EXPECT_THAT(said(head + "segments: [{file: none.csv}]\n"), HasSubstr("there is no file"));
    EXPECT_THAT(said(head + "segments: [{file: pixels.yaml}]\n"), HasSubstr("a pixel lamp, expected a lamp file with one table"))
        << "itself";
    write("a.csv", "# unit: cd\nV\\H; -6; -2; 0\n-1; 0; 900; 0\n2; 0; 400; 0\n");
    EXPECT_THAT(said(head + "segments: [{file: a.csv, lights: {h_deg: [1, 3], v_deg: [-1, 1]}}]\n"),
                HasSubstr("lights beside its table, expected some of H -6 to 0, V -1 to 2 degrees"));
    EXPECT_THAT(said(raster() + "slew: 3\n"), HasSubstr("'slew_per_s', the nearest known key"));
    EXPECT_THAT(said(head + "raster: {pixels: [4096, 4096], h_deg: [-20, 20], v_deg: [-10, 10], spread_deg: [0.05, 0.05], cd: 1}\n"),
                HasSubstr("4096 x 4096 pixels with their blur need a table of"));
    EXPECT_THAT(said(head + "raster: {pixels: [4, 4], h_deg: [-20, 20], v_deg: [-90, 90], spread_deg: [0.1, 0.3], cd: 1}\n"),
                HasSubstr("with their blur the pixels light from V -91"));
    EXPECT_THAT(said(head + "raster: {pixels: [400, 2], h_deg: [-20, 20], v_deg: [-10, 10], spread_deg: [2, 0.1], cd: 1}\n"),
                HasSubstr("2 degrees, of pixels 0.1 degrees wide, expected at most the width of 16 pixels"));
    EXPECT_THAT(said(head + "raster: {pixels: [2, 2], h_deg: [2, -2], v_deg: [-1, 1], spread_deg: [0.1, 0.1], cd: 1}\n"),
                HasSubstr("edges that do not ascend"));
}

/// Full at first; at 1 s asked for darkness, which takes 0.1 s to arrive and 0.5 s to come; at 1.3 s, two fifths of the way, back.
TEST_F(Pixels, LevelsLagAndSlew) {
    LevelTrack track(lamp(raster() + "latency_s: 0.1\nslew_per_s: 2\nsteps: 4\n"));
    const std::vector<float> full(12, 1.0F);
    track.ask(0.0, full);
    track.ask(1.0, std::vector<float>(12, 0.1F)); // nearest step: dark
    track.ask(1.3, full);
    const auto level = [&](double time_s) { return static_cast<double>(track.levels(time_s)[3]); };
    EXPECT_EQ(level(1.1), 1.0);
    EXPECT_NEAR(level(1.2), 0.8, 1e-6);
    EXPECT_NEAR(level(1.4), 0.4, 1e-6);
    EXPECT_NEAR(level(1.5), 0.6, 1e-6);
    EXPECT_EQ(level(1.75), 1.0);
    EXPECT_NEAR(level(1.2), 0.8, 1e-6) << "back in time";
    EXPECT_EQ(track.at(0.5), track.at(0.9)) << "the same file while nothing moves";
    EXPECT_NE(track.at(1.2), track.at(1.3));
    EXPECT_EQ(track.at(0.5)->table, track.lamp()->table);
    EXPECT_NEAR(intensity_cd(track.at(1.2)->table, 0.0, 0.0), 800.0, 0.1);
    EXPECT_EQ(track.at(1.2)->state_of, track.at(1.4)->state_of);
}

TEST_F(Pixels, TheFirstLevelsHoldFromTheBeginning) {
    LevelTrack track(lamp(raster() + "latency_s: 0.5\nslew_per_s: 1\n"));
    track.ask(0.0, only(2));
    EXPECT_EQ(track.levels(0.0), only(2));
}

TEST_F(Pixels, LevelsComeFromAFile) {
    FilesRead opened;
    std::string text = "# columns of a row, then the next\ntime_s";
    for (int i = 0; i < 12; ++i)
        text += fmt::format(";p{}", i);
    text += "\n0;1;1;1;1;1;1;1;1;1;1;1;1\n0.5;0;0;0;0;0;0.25;0;0;0;0;0;0\n";
    const auto track = read_levels(write("levels.csv", text), lamp(raster()), opened);
    EXPECT_EQ(track->levels(0.49), std::vector<float>(12, 1.0F));
    EXPECT_EQ(track->levels(7.0), only(5, 0.25F));
    EXPECT_EQ(opened.size(), 1U);
}

TEST_F(Pixels, LevelsComeFromPictures) {
    Image<float> picture(4, 3, 0.0F);
    picture.at(1, 1) = 0.25F;
    write("one.exr", encode_texture(picture, "level", {}));
    FilesRead opened;
    const auto track = read_levels(write("levels.csv", "time_s, picture\n0, one.exr\n"), lamp(raster()), opened);
    EXPECT_EQ(track->levels(7.0), only(5, 0.25F));
    EXPECT_EQ(opened.size(), 2U);
    write("wide.exr", encode_texture(Image<float>(5, 3, 0.0F), "level", {}));
    EXPECT_THAT(levels_refusal("time_s, picture\n0, wide.exr\n"), HasSubstr("found 5 x 3 pixels, expected 4 x 3, as the lamp has"));
    EXPECT_THAT(levels_refusal("time_s, picture\n0, none.exr\n"), HasSubstr("levels.csv:2: there is no file"));
    EXPECT_EQ(levels_refusal("Time_s, Picture\n0, one.exr\n"), "");
    EXPECT_THAT(levels_refusal("time_s, image\n0, one.exr\n"), HasSubstr("found a column 'image', expected `picture`, or a level for"));
    write("depth.exr", encode_texture(picture, "Z", {}));
    EXPECT_THAT(levels_refusal("time_s, picture\n0, depth.exr\n"), HasSubstr("found channels Z, expected `level`, `Y`"));
}

TEST_F(Pixels, WhatIsWrongWithLevelsIsSaid) {
    const std::string dark = ";0;0;0;0;0;0;0;0;0;0;0;0\n";
    EXPECT_EQ(levels_refusal("0" + dark), "");
    EXPECT_THAT(levels_refusal("# nothing\n"), HasSubstr("holds no levels"));
    EXPECT_THAT(levels_refusal("0;1\n"), HasSubstr("levels.csv:1: found 2 cells, expected 13: a time and a level for each pixel"));
    EXPECT_THAT(levels_refusal("1" + dark + "1" + dark), HasSubstr("levels.csv:2: time_s: found 1, expected a time after 1 s"));
    EXPECT_THAT(levels_refusal("-1" + dark), HasSubstr("a time from 0 on"));
    EXPECT_THAT(levels_refusal("0;0;0;0;0;0;0;0;0;0;0;0;1.5\n"), HasSubstr("column 13: found 1.5, expected a level from 0 to 1"));
    EXPECT_THAT(levels_refusal("0;x;0;0;0;0;0;0;0;0;0;0;1\n"), HasSubstr("column 2"));
}

TEST_F(Pixels, RandomBytesDoNotFellTheReader) { must_survive_random_bytes("pixels.yaml", head + "raster: {", 11, 80); }

} // namespace
} // namespace fernlicht
