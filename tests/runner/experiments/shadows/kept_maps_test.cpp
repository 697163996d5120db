// What a report says of shadow maps that were not drawn anew: pictures of one moment share theirs, and with a bound moments do.
#include "tests/runner/experiments/shadows/short_drive.h"

#include <cstdio>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;

struct KeptMaps {
    int stood = 0, used = 0, first_used = 0, earlier = -1;
    std::string notes;
};

KeptMaps kept_maps(const TemporaryFolder& folder, const std::string& shadows, const std::string& out) {
    const Outcome run = run_program("run " + short_drive(folder, "first-light", shadows) +
                                    " --quiet --resolution 96x72 --capture all --no-accuracy --frames 20:22 --out " + (folder / out));
    EXPECT_LE(run.exit_code, 1) << run.output;
    const json drive = json::parse(content_of(folder / (out + "/report.json"))).at("drives").at(0);
    KeptMaps kept;
    kept.notes = drive.at("notes").dump();
    for (const json& left : drive.at("left_out")) {
        const std::string text = left.get<std::string>();
        if (std::sscanf(text.c_str(), "rendering %d of the %d shadow maps", &kept.stood, &kept.used) == 2)
            std::sscanf(text.substr(text.find("; of the ")).c_str(),
                        "; of the %d that the first pictures of moments looked up, %d stood from an earlier moment", &kept.first_used,
                        &kept.earlier);
    }
    return kept;
}

TEST(KeptMaps, OfPicturesAndOfMomentsAreToldApart) {
    const TemporaryFolder folder;
    const KeptMaps shared = kept_maps(folder, "map", "map");
    EXPECT_GT(shared.stood, 0); // by the other pictures of each moment
    EXPECT_GT(shared.first_used, 0);
    EXPECT_LT(shared.first_used, shared.used);
    EXPECT_EQ(shared.earlier, 0); // the car moves
    EXPECT_EQ(shared.stood, shared.used - 2 * shared.first_used) << "what targets look up has maps of its own";
    const KeptMaps bound = kept_maps(folder, "{method: map, redraw_texels: 16}", "bound");
    EXPECT_GT(bound.earlier, 0);
    EXPECT_GT(bound.stood, shared.stood);
    const KeptMaps tight = kept_maps(folder, "{method: map, redraw_texels: 0.001}", "tight");
    EXPECT_EQ(tight.earlier, 0);
    EXPECT_THAT(tight.notes, testing::HasSubstr("shadows: redraw_texels 0.001: none of the "));
}

} // namespace
} // namespace fernlicht
