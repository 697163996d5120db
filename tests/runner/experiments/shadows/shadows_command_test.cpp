// `fernlicht shadows` through the program: scenes in, a table of methods out.
#include "runner/experiments/shadows/shadow_result.h"
#include "scenarios/drives/shadow_settings.h"
#include "tests/runner/experiments/shadows/short_drive.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string small = "shadows --quiet --resolution 96x72 --scene-lamp " + library_file("lamps/xenon-low.ies") + " ";

json checked_shadows(const std::filesystem::path& file) { return tests::checked(content_of(file), shadow_members); }

const json& row_of(const json& scene, const std::string& method) { return tests::entry(scene.at("rows"), "shadows", method); }

TEST(ShadowsCommand, HoldsMethodsAgainstRays) {
    const TemporaryFolder folder;
    std::string straight = content_of(short_drive(folder, "straight", "auto"));
    straight.replace(straight.find("dressing: dressed"), 17, "dressing: plain"); // on which nothing casts
    std::ofstream(folder / "straight.yaml") << straight;
    EXPECT_THAT(printed(small +
                        "--rounds 3 --shadow-map 512x256 --count 1 --methods none,map,under-car,volumes --scenes post-5,kerb --out " +
                        (folder / "out ") + (folder / "straight.yaml")),
                HasSubstr("   30 m "));
    const json found = checked_shadows(folder / "out/shadows.json");
    ASSERT_EQ(found.at("scenes").size(), 3U);
    const json &post = found.at("scenes").at(0), &none = row_of(post, "none"), &map = row_of(post, "map");
    EXPECT_EQ(post.at("name"), "post-5");
    // Without shadows each truly shadowed place is wrongly lit, and no edge is drawn.
    EXPECT_NEAR(none.at("ground_m2").at("wrongly_lit"), none.at("ground_m2").at("shadowed"), 1e-3);
    EXPECT_LT(none.at("ground_m2").at("wrongly_dark"), 1e-4);
    EXPECT_EQ(none.at("edges").at(0).at("lost"), 18); // two in each of nine steps
    EXPECT_EQ(none.at("edges").at(0).at("edges"), 0);
    EXPECT_FALSE(none.at("crawl").at("not_measured").is_null());
    EXPECT_EQ(none.at("texture_bytes"), 0);
    // A map of 512 x 256 over a low beam: 0.1 to 0.2 m a texel at 30 m, edges within a texel and a half.
    EXPECT_LT(map.at("ground_m2").at("wrong_share"), 0.5 * none.at("ground_m2").at("wrong_share").get<double>());
    for (const json& edge : map.at("edges")) {
        EXPECT_EQ(edge.at("edges"), 18) << edge;
        EXPECT_GT(edge.at("rms_cm"), 0.0);
        EXPECT_LT(edge.at("worst_cm"), 2.0 * edge.at("distance_m").get<double>()) << edge;
    }
    EXPECT_GT(map.at("edges").at(1).at("rms_cm"), map.at("edges").at(0).at("rms_cm"));
    EXPECT_GT(map.at("crawl").at("cm"), 0.0);
    EXPECT_EQ(map.at("texture_bytes"), 2 * 4 * 512 * 256);                // two lamps
    EXPECT_EQ(row_of(post, "volumes").at("texture_bytes"), 10 * 96 * 72); // mask, depth and stencil of the view
    EXPECT_EQ(row_of(post, "under-car").at("texture_bytes"), 0);          // no body moves
    for (const json& row : found.at("scenes").at(2).at("rows"))           // nothing stands in a beam
        EXPECT_EQ(row.at("texture_bytes"), 0) << row.at("shadows");
    EXPECT_EQ(map.at("work").at("passes"), 3);
    EXPECT_EQ(map.at("frame_s").size(), 3U);
    EXPECT_THAT(map.at("passes").dump(), HasSubstr("shadow maps"));
    for (const char* name :
         {"shadows.csv", "shadows.html", "methods-kerb.png", "methods-straight-1.png", "shadows-all.svg", "shadows-post-5.png"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));
    const std::string page = content_of(folder / "out/shadows.html");
    EXPECT_THAT(page, HasSubstr("Shadow methods"));
    EXPECT_THAT(page, HasSubstr("Mean over 3 scenes, each with the same weight; vertical bars from the best to the worst scene."));
    EXPECT_THAT(page, Not(HasSubstr("Not in the diagram")));
}

// Maps of one size: what the view does not see costs the warped ones no texels. A view 15 degrees high sees less than a fourth of the
// beam's width.
TEST(ShadowsCommand, WarpedMapsGainWhereTheViewIsNarrow) {
    const TemporaryFolder folder;
    printed(small +
            "--rounds 1 --lamp-radius 0 --vertical-fov 15 --scenes post-20 "
            "--methods map,perspective-map,light-space-map --out " +
            (folder / "out"));
    const json scene = json::parse(content_of(folder / "out/shadows.json")).at("scenes").at(0);
    EXPECT_NEAR(scene.at("vertical_fov_deg"), 15.0, 1e-9);
    const json& map = row_of(scene, "map");
    for (const char* const method : {"perspective-map", "light-space-map"}) {
        const json& warped = row_of(scene, method);
        EXPECT_EQ(warped.at("texture_bytes"), map.at("texture_bytes"));
        for (const std::size_t distance : {1U, 2U}) {
            EXPECT_EQ(warped.at("edges").at(distance).at("edges"), 18);
            EXPECT_LT(warped.at("edges").at(distance).at("rms_cm"), 0.5 * map.at("edges").at(distance).at("rms_cm").get<double>())
                << method;
        }
    }
}

// Lamps as discs of 6 cm: half shadows around a post's, which hard edges lack.
TEST(ShadowsCommand, SoftMapsAreNearerToDiscs) {
    const TemporaryFolder folder;
    printed(small + "--rounds 1 --scenes post-5 --methods map,soft-map --out " + (folder / "out"));
    const json found = json::parse(content_of(folder / "out/shadows.json"));
    EXPECT_EQ(found.at("lamp_radius_m"), 0.06);
    const json& scene = found.at("scenes").at(0);
    EXPECT_LT(row_of(scene, "soft-map").at("discs_px").at("wrong_share"),
              0.4 * row_of(scene, "map").at("discs_px").at("wrong_share").get<double>());
}

TEST(ShadowsCommand, CountsFromTheFloorOn) {
    const TemporaryFolder folder;
    const auto found = [&](const std::string& floor) {
        printed(small + "--rounds 1 --lamp-radius 0 --methods none --scenes post-20 --floor-lx " + floor + " --out " + (folder / floor));
        const json all = json::parse(content_of(folder / (floor + "/shadows.json")));
        EXPECT_EQ(all.at("floor_lx"), std::stod(floor));
        EXPECT_THAT(content_of(folder / (floor + "/shadows.html")), HasSubstr(floor + " lx"));
        return row_of(all.at("scenes").at(0), "none");
    };
    const json faint = found("0.001"), bright = found("2");
    for (const char* what : {"ground_m2", "view_px"})
        EXPECT_LT(bright.at(what).at("counted"), 0.9 * faint.at(what).at("counted").get<double>()) << what;
    EXPECT_GT(bright.at("ground_m2").at("counted"), 0.0);
}

TEST(ShadowsCommand, TakesEveryMethodThereIs) {
    const TemporaryFolder folder;
    const std::string said = printed(small + "--rounds 1 --lamp-radius 0 --scenes crest --out " + (folder / "out"));
    const json found = checked_shadows(folder / "out/shadows.json");
    const json& scene = found.at("scenes").at(0);
    EXPECT_EQ(scene.at("rows").size(), shadow_method_names().size());
    for (const ShadowMethodName& method : shadow_method_names()) {
        const json& row = row_of(scene, std::string(method.name));
        if (row.at("not_measured").is_null())
            EXPECT_TRUE(row.at("discs_px").is_null());
        else
            EXPECT_THAT(said, HasSubstr(std::string(method.name) + ": not measured, "));
    }
}

// 4 GiB for a lamp: the method that finds no room for its maps costs the others nothing. llvmpipe, whose limits are known, draws.
TEST(ShadowsCommand, NamesTheMethodWhoseMapsAreTooLarge) {
    const TemporaryFolder folder;
    EXPECT_THAT(printed(small +
                        "--backend software --rounds 1 --lamp-radius 0 --shadow-map 8192x8192 --scenes post-5 "
                        "--methods soft-map,volumes --out " +
                        (folder / "out")),
                AllOf(HasSubstr("soft-map: not measured, shadows: found 16 maps of 8192 x 8192 texels for each lamp by 'soft-map', "
                                "4096 MiB, for which "),
                      HasSubstr("expected a smaller map_texels or fewer lamp_places\n")));
    const json scene = json::parse(content_of(folder / "out/shadows.json")).at("scenes").at(0);
    EXPECT_FALSE(row_of(scene, "soft-map").at("not_measured").is_null());
    EXPECT_THAT(content_of(folder / "out/shadows.html"), HasSubstr("<p>Not in the diagram: soft-map, shadows: found 16 maps of "));
    const json& volumes = row_of(scene, "volumes");
    EXPECT_TRUE(volumes.at("not_measured").is_null());
    EXPECT_LT(volumes.at("ground_m2").at("wrong_share"), 0.001);
    EXPECT_EQ(volumes.at("frame_s").size(), 1U);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));
}

TEST(ShadowsCommand, RunsSayHowMuchRoomMapsWouldTake) {
    const TemporaryFolder folder;
    const std::string drive = short_drive(folder, "first-light", "{method: soft-map, map_texels: [8192, 8192], lamp_places: 64}");
    EXPECT_THAT(printed("run " + drive + " --quiet --resolution 96x72 --no-accuracy --backend software --out " + (folder / "out"), 3),
                AllOf(HasSubstr("shadows: found 64 maps of 8192 x 8192 texels for each lamp by 'soft-map', 16384 MiB, for which "),
                      HasSubstr("expected a smaller map_texels or fewer lamp_places")));
}

TEST(ShadowsCommand, RefusesWhatIsNotThere) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& flags) { return printed(small + "--out " + (folder / "out ") + flags, 2); };
    EXPECT_THAT(refused("--methods mop"), HasSubstr("--methods: found 'mop'"));
    EXPECT_THAT(refused("--methods mop"), HasSubstr("expected one of none, under-car, "));
    EXPECT_THAT(refused("--methods auto"), HasSubstr("by their names"));
    EXPECT_THAT(refused("--floor-lx 0"), HasSubstr("--floor-lx: found '0', expected 0.001 to 10 lx"));
    EXPECT_THAT(refused("--scenes none,post-5"), HasSubstr("--scenes: found 'none,post-5', expected none alone"));
    EXPECT_THAT(printed("shadows --scene-lamp nowhere.ies --out " + (folder / "out"), 2),
                HasSubstr("nowhere.ies: --scene-lamp: is not there, expected a lamp file"));
    for (const std::string sides : {"0x0", "16385x1"}) {
        EXPECT_THAT(printed("shadows --resolution " + sides + " --out " + (folder / "out"), 2),
                    HasSubstr("--resolution: found '" + sides + "', expected sides from 1 to 16384 pixels"));
    }
    EXPECT_THAT(refused("--methods map,map"), HasSubstr("each method once"));
    EXPECT_THAT(refused("--scenes past-5"), HasSubstr("fits no scene"));
    EXPECT_THAT(refused("--scenes none"), HasSubstr("DRIVE"));
    EXPECT_THAT(refused("--shadow-map 8x8"), HasSubstr("16 to 8192"));
    EXPECT_THAT(refused("--vertical-fov 0"), HasSubstr("1 to 120 degrees"));
    EXPECT_THAT(refused("--lamp-radius 0.7"), HasSubstr("0.001 to 0.5 m"));
    EXPECT_THAT(refused("--scenes none --count 99 " + library_file("drives/shelter.yaml")), HasSubstr("1 to 50"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(ShadowsCommand, WritesWhatThereIsWhenInterrupted) {
    const TemporaryFolder folder;
    const Outcome run = run_interrupted("shadows --rounds 100000 --lamp-radius 0 --resolution 96x72 --scene-lamp " +
                                            library_file("lamps/xenon-low.ies") + " --scenes 'post-*' --log-json --out " + (folder / "out"),
                                        "steps");
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("incomplete: interrupted by the user"));
    const json found = json::parse(content_of(folder / "out/shadows.json"));
    EXPECT_EQ(found.at("interrupted"), "interrupted by the user");
    EXPECT_FALSE(found.at("missing").empty());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));
}

} // namespace
} // namespace fernlicht
