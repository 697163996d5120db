#include "runner/experiments/film/film_layout.h"
#include "runner/files/film_file.h"
#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <regex>

namespace fernlicht {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string filmed_drive = library_file("drives/straight.yaml");
constexpr int film_width = 320, film_height = 240;

/// `more` may say otherwise how large, and which frames.
std::string film_line(const std::string& film, const std::string& more) {
    std::string line = fmt::format("film {} --film '{}' --backend software --quiet {}", filmed_drive, film, more);
    if (more.find("--resolution") == std::string::npos)
        line += fmt::format(" --resolution {}x{}", film_width, film_height);
    return more.find("--frames") == std::string::npos ? line + " --frames 0:4" : line;
}

Image<Rgb8> frame_of(const TemporaryFolder& folder, const std::string& name, int number) {
    return read_png(folder / fmt::format("{}-{:06}.png", name, number));
}

void film_frames(const TemporaryFolder& folder, const std::string& name, const std::string& more) {
    printed(film_line(folder / (name + "-%06d.png"), more));
}

Image<Rgb8> box_of(const Image<Rgb8>& frame, const PixelBox& box) { return part_of(frame, box.x, box.y, box.width, box.height); }

bool has_light(const Image<Rgb8>& picture) {
    return std::ranges::any_of(picture.pixels(), [](const Rgb8& p) { return p.r > 60; });
}

bool has_ffmpeg() { return run_shell("ffmpeg -version").exit_code == 0 && run_shell("ffprobe -version").exit_code == 0; }

TEST(FilmCommand, SameFramesTwiceWithEverythingOverThem) {
    const TemporaryFolder folder;
    const std::string all = "--overlay lux,isolux --overlay readings,speed";
    film_frames(folder, "once", all);
    film_frames(folder, "again", all);
    film_frames(folder, "bare", "");
    film_frames(folder, "plain", "--dressing plain --frames 0:0");
    EXPECT_NE(frame_of(folder, "plain", 0), frame_of(folder, "bare", 0)) << "the drive is dressed";
    EXPECT_THAT(run_program(film_line(folder / "x.mp4", "--dressing fancy")).output,
                HasSubstr("--dressing: found 'fancy', expected none, plain or dressed"));
    const FilmLayout layout = film_layout(FilmArrangement::automatic, 2, film_width, film_height, {.readings = true, .maps = true});
    for (int k = 0; k < 5; ++k) {
        const Image<Rgb8> frame = frame_of(folder, "once", k);
        EXPECT_EQ(frame, frame_of(folder, "again", k)) << k;
        for (const FilmPanelBoxes& boxes : layout.panels)
            for (const PixelBox& box : {boxes.title, boxes.picture, boxes.map})
                EXPECT_TRUE(has_light(box_of(frame, box))) << k << ", box at " << box.x << ", " << box.y;
        EXPECT_TRUE(has_light(box_of(frame, layout.footer))) << k;
        EXPECT_NE(frame, frame_of(folder, "bare", k)) << k;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "once-000005.png"));
    EXPECT_NE(frame_of(folder, "bare", 0), frame_of(folder, "bare", 4)) << "the car moves";
}

TEST(FilmCommand, PanelsStandWhereTheArrangementHasThem) {
    const TemporaryFolder folder;
    film_frames(folder, "beside", "--frames 2:2");
    film_frames(folder, "swapped", "--frames 2:2 --side-by-side --lamp-sets xenon,halogen");
    std::ofstream(folder / "again.yaml") << std::regex_replace(content_of(filmed_drive), std::regex("[.][.]/"), library_file(""));
    film_frames(folder, "grid", "--frames 2:2 --grid --lamp-sets xenon,halogen " + (folder / "again.yaml"));
    film_frames(folder, "wipe", "--frames 2:2 --wipe");
    film_frames(folder, "halogen", "--frames 2:2 --lamp-sets halogen");
    film_frames(folder, "xenon", "--frames 2:2 --lamp-sets xenon");
    const Image<Rgb8> beside = frame_of(folder, "beside", 2), swapped = frame_of(folder, "swapped", 2);
    const FilmLayout two = film_layout(FilmArrangement::side_by_side, 2, film_width, film_height, {});
    const PixelBox &left = two.panels[0].picture, &right = two.panels[1].picture;
    EXPECT_EQ(box_of(beside, left), box_of(swapped, right));
    EXPECT_EQ(box_of(beside, right), box_of(swapped, left));
    EXPECT_NE(box_of(beside, left), box_of(beside, right));
    const Image<Rgb8> grid = frame_of(folder, "grid", 2);
    const FilmLayout four = film_layout(FilmArrangement::grid, 4, film_width, film_height, {});
    EXPECT_EQ(box_of(grid, four.panels[0].picture), box_of(grid, four.panels[2].picture));
    EXPECT_NE(box_of(grid, four.panels[0].picture), box_of(grid, four.panels[1].picture));
    EXPECT_GT(four.panels[2].picture.y, four.panels[1].picture.y);

    const Image<Rgb8> wipe = frame_of(folder, "wipe", 2);
    const FilmLayout one = film_layout(FilmArrangement::wipe, 2, film_width, film_height, {});
    const FilmLayout alone = film_layout(FilmArrangement::automatic, 1, film_width, film_height, {});
    ASSERT_EQ(one.panels[0].picture, alone.panels[0].picture);
    for (const bool first : {true, false}) {
        PixelBox side = one.panels[first ? 0 : 1].shown;
        side.x += first ? 0 : 2; // beside the line between them
        side.width -= 2;
        EXPECT_EQ(box_of(wipe, side), box_of(frame_of(folder, first ? "halogen" : "xenon", 2), side)) << first;
        EXPECT_NE(box_of(wipe, side), box_of(frame_of(folder, first ? "xenon" : "halogen", 2), side)) << first;
    }
}

/// A house 300 m beside the road, seen by day through 4 degrees: finer than the drive's own view shows it.
TEST(FilmCommand, DressedSceneryIsAsFineAsTheFilmShowsIt) {
    const TemporaryFolder folder;
    const std::string object =
        R"(<objects><object id="1" name="house" type="building" s="110" t="300" zOffset="0" hdg="0" length="12" width="10" height="7"/></objects></road>)";
    std::ofstream(folder / "road.xodr") << std::regex_replace(content_of(library_file("roads/straight.xodr")), std::regex("</road>"),
                                                              object);
    const auto film_with = [&](const char* name, double fov_deg) {
        std::ofstream(folder / (std::string(name) + ".yaml")) << fmt::format(
            "fernlicht: 1\nname: house\ntone_mapper: {{kind: linear, l_max_cdm2: 10000}}\nroad: road.xodr\nroute: {{s_m: 110}}\nspeed_kmh: "
            "36\nduration_s: 1\ndressing: dressed\n"
            "daylight: {{name: day, date: 2026-06-18, time: 12:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, sky: clear}}\n"
            "lamp_sets: {{one: {{file: {}}}}}\nviews: {{driver: {{yaw_deg: 90, pitch_deg: 0.5, vertical_fov_deg: {}, resolution_px: [320, "
            "240]}}}}\n",
            library_file("lamps/xenon-low.ies"), fov_deg);
        printed(fmt::format("film '{}' --film '{}' --backend software --quiet --resolution 320x240 --vertical-fov 4 --frames 0:0",
                            folder / (std::string(name) + ".yaml"), folder / (std::string(name) + "-%06d.png")));
        return frame_of(folder, name, 0);
    };
    EXPECT_EQ(film_with("coarse", 40.0), film_with("fine", 4.0));
}

/// The filmed drive, with other lines for its lamp sets and more at its end.
std::string drive_beside(const TemporaryFolder& folder, const std::string& name, const std::string& lamp_sets, const std::string& more) {
    const std::string moved = std::regex_replace(content_of(filmed_drive), std::regex("[.][.]/"), library_file(""));
    const std::string with_lamps = std::regex_replace(moved, std::regex("  halogen:.*\n  xenon:.*\n"), lamp_sets);
    EXPECT_NE(with_lamps, moved);
    std::ofstream(folder / (name + ".yaml")) << with_lamps << more;
    return folder / (name + ".yaml");
}

std::string lamp_set_line(const std::string& name, const std::string& source, const std::string& file) {
    return fmt::format("  {}: {{source: {}, file: {}}}\n", name, source, library_file("lamps/" + file));
}

void film_drives(const TemporaryFolder& folder, const std::string& name, const std::string& drives) {
    printed(fmt::format("film {} --film '{}' --backend software --quiet --frames 2:2 --resolution {}x{}", drives,
                        folder / (name + "-%06d.png"), film_width, film_height));
}

/// Each drive alone would be adapted to its own lamps; beside one another they are shown by one white, in any order.
TEST(FilmCommand, DrivesThatDifferInLampsAreShownByOneWhite) {
    const TemporaryFolder folder;
    const std::string warm = drive_beside(folder, "warm", lamp_set_line("own", "filament", "halogen-low.ies"), ""),
                      cold = drive_beside(folder, "cold", lamp_set_line("own", "arc", "xenon-low.ies"), "");
    film_drives(folder, "one", warm + " " + cold);
    film_drives(folder, "other", cold + " " + warm);
    const FilmLayout two = film_layout(FilmArrangement::automatic, 2, film_width, film_height, {});
    const Image<Rgb8> one = frame_of(folder, "one", 2), other = frame_of(folder, "other", 2);
    const PixelBox &left = two.panels[0].picture, &right = two.panels[1].picture;
    EXPECT_EQ(box_of(one, left), box_of(other, right));
    EXPECT_EQ(box_of(one, right), box_of(other, left));
    EXPECT_NE(box_of(one, left), box_of(one, right));
}

/// As in a run, the sky is lit, and noise differs between lamp sets that give the same light.
TEST(FilmCommand, ShowsSkyAndNoiseAsARunDoes) {
    const TemporaryFolder folder;
    const std::string same = lamp_set_line("a", "arc", "xenon-low.ies") + lamp_set_line("b", "arc", "xenon-low.ies");
    film_drives(folder, "dark", drive_beside(folder, "dark", same, ""));
    film_drives(folder, "sky", drive_beside(folder, "sky", same, "display: {sky: {zenith_cdm2: 1}}\n"));
    film_drives(folder, "camera", drive_beside(folder, "camera", same, "display: {eye: {camera: {iso: 6400}}}\n"));
    const FilmLayout two = film_layout(FilmArrangement::automatic, 2, film_width, film_height, {});
    const PixelBox &left = two.panels[0].picture, &right = two.panels[1].picture;
    const int x = left.x + left.width / 2, y = left.y + left.height / 8;
    const Image<Rgb8> dark = frame_of(folder, "dark", 2), camera = frame_of(folder, "camera", 2);
    EXPECT_GT(frame_of(folder, "sky", 2).at(x, y).g, dark.at(x, y).g + 60);
    EXPECT_EQ(box_of(dark, left), box_of(dark, right));
    EXPECT_NE(box_of(camera, left), box_of(camera, right));
}

TEST(FilmCommand, VideosHoldEachFrameAtItsTime) {
    if (!has_ffmpeg())
        GTEST_SKIP() << "ffmpeg is not installed";
    const TemporaryFolder folder;
    for (const std::string extension : {"webm", "mp4"}) {
        const std::string film = folder / ("film." + extension), again = folder / ("again." + extension);
        EXPECT_THAT(printed(film_line(film, "--rate 50/3")), HasSubstr("5 frames, 0.300 s"));
        printed(film_line(again, "--rate 50/3"));
        EXPECT_EQ(content_of(film), content_of(again)) << extension;
        const Outcome times = run_shell("ffprobe -v error -select_streams v -show_entries frame=pts_time -of csv=p=0 " + film);
        std::vector<double> found;
        for (const std::vector<std::string>& row : csv_rows(times.output))
            if (!row.empty()) // ffprobe ends a frame that has more to tell with an empty line
                found.push_back(std::stod(row[0]));
        EXPECT_THAT(found, ::testing::ElementsAre(::testing::DoubleNear(0.0, 1e-6), ::testing::DoubleNear(0.06, 1e-6),
                                                  ::testing::DoubleNear(0.12, 1e-6), ::testing::DoubleNear(0.18, 1e-6),
                                                  ::testing::DoubleNear(0.24, 1e-6)))
            << extension;
        // Colours come back: what a video keeps of a PNG's levels, on average.
        std::ofstream(folder / "still-000005.png") << "of a longer film";
        EXPECT_THAT(printed(film_line(folder / "still-%06d.png", "--rate 50/3 --force")),
                    HasSubstr("still-000005.png and what follows it are pictures of an earlier film"));
        ASSERT_EQ(
            run_shell(fmt::format("ffmpeg -v error -i {} -vf scale=in_color_matrix=bt709 {}", film, folder / (extension + "-%06d.png")))
                .exit_code,
            0);
        const Image<Rgb8> still = frame_of(folder, "still", 4), decoded = read_png(folder / (extension + "-000005.png"));
        ASSERT_EQ(still.size(), decoded.size());
        double sum = 0.0;
        for (std::size_t i = 0; i < still.size(); ++i)
            sum += std::abs(still.pixels()[i].r - decoded.pixels()[i].r) + std::abs(still.pixels()[i].g - decoded.pixels()[i].g) +
                   std::abs(still.pixels()[i].b - decoded.pixels()[i].b);
        EXPECT_LT(sum / (3.0 * static_cast<double>(still.size())), 2.0) << extension;
    }
}

TEST(FilmCommand, RefusesInOneSentence) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& film, const std::string& more, int code, const std::string& words,
                             const std::string& before = {}) {
        const Outcome run = run_program(film_line(film, more), before);
        EXPECT_EQ(run.exit_code, code) << run.output;
        EXPECT_THAT(run.output, HasSubstr(words));
        EXPECT_THAT(run.output, StartsWith("fernlicht: "));
        EXPECT_EQ(std::ranges::count(run.output, '\n'), 1) << run.output;
    };
    const std::string film = folder / "film.webm", pictures = folder / "film-%06d.png";
    refused(folder / "film.avi", "", 2, "a file.webm or file.mp4, or pictures by number: frame-%06d.png");
    refused(folder / "film.png", "", 2, "frame-%06d.png");
    refused(folder / "nowhere/film.webm", "", 2, "there is no folder");
    refused(film, "", 3, "install Debian's package ffmpeg", "PATH=" + folder.path().string());
    refused(film, "--overlay lux,fog", 2, "found 'fog', expected some of lux, isolux, readings, speed");
    refused(film, "--rate 0", 2, "frames a second");
    refused(film, "--rate abc", 2, "--rate: found 'abc', expected");
    refused(film, "--lamp-sets xenon,halogen,xenon", 2, "--lamp-sets: found 'xenon twice', expected each lamp set once");
    refused(folder / "nowhere/film.webm", "--technique magic", 2, "--technique: "); // inputs first
    refused(film, "--resolution 321x240", 2, "even numbers");
    refused(film, "--lamp-sets laser", 2, "one of halogen, xenon");
    refused(film, "--wipe --lamp-sets xenon", 2, "--wipe: found 1 panel");
    refused(film, "--frames 100000:", 2, "frames of the film");
    refused(film, "--technique plain --overlay lux", 2, "does not compute an illuminance");
    const std::string other = folder / "other.yaml";
    std::ofstream(other) << std::regex_replace(content_of(filmed_drive), std::regex("[.][.]/"), library_file(""))
                         << "tone_mapper: {l_max_cdm2: 50}\n";
    refused(pictures, other, 2, "one tone mapper and display for all panels of a film");
    EXPECT_FALSE(std::filesystem::exists(film));
    std::ofstream(film) << "mine";
    refused(film, "", 2, "is there already");
    EXPECT_EQ(content_of(film), "mine");
    std::ofstream(folder / "film-000003.png") << "mine";
    refused(pictures, "", 2, "film-000003.png is there already");
    std::filesystem::create_directory(folder / "folder.webm");
    refused(folder / "folder.webm", "--force", 2, "folder.webm is no file");
    refused(folder / "nowhere/film.webm", "--force", 2, "there is no folder");
}

TEST(FilmCommand, InterruptedItKeepsWhatWasFilmed) {
    if (!has_ffmpeg())
        GTEST_SKIP() << "ffmpeg is not installed";
    const TemporaryFolder folder;
    const Outcome run = run_interrupted(fmt::format("film {} --film {} --resolution 160x120 --backend software --log-json --frames 0:199",
                                                    filmed_drive, folder / "film.mp4"),
                                        "film of straight");
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("incomplete: interrupted by the user"));
    const Outcome counted = run_shell("ffprobe -v error -select_streams v -count_frames -show_entries stream=nb_read_frames -of csv=p=0 " +
                                      (folder / "film.mp4"));
    EXPECT_THAT(run.output, HasSubstr(fmt::format(": {} of 200 frames", std::stoi(counted.output))));
    EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4.part"));
}

/// An encoder that gives up: its own words come out, and no half film stays.
TEST(FilmFile, TellsWhatTheEncoderSays) {
    const TemporaryFolder folder;
    std::ofstream(folder / "ffmpeg")
        << "#!/bin/sh\nfor last; do :; done\n: >\"${last#file:}\"\nread x\necho 'no room is left' >&2\nexit 1\n";
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    const Outcome run = run_program(film_line(folder / "film.mp4", ""), "PATH=" + folder.path().string() + ":$PATH");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.output, HasSubstr("ffmpeg cannot encode it: no room is left"));
    EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4.part"));
    EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

TEST(FilmFile, LeavesNoPartWhereTheFilmCannotGetItsName) {
    const TemporaryFolder folder;
    std::ofstream(folder / "ffmpeg")
        << "#!/bin/sh\nfor last; do :; done\ncat >/dev/null\npart=\"${last#file:}\"\n: >\"$part\"\nmkdir \"${part%.part}\"\n";
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    const Outcome run = run_program(film_line(folder / "film.mp4", ""), "PATH=" + folder.path().string() + ":$PATH");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.output, HasSubstr("cannot be written"));
    EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4.part"));
}

} // namespace
} // namespace fernlicht
