// The shipped baselines stand under the inputs of the standard study's cells. With FERNLICHT_REWRITE_BASELINES=FOLDER those accepted
// before pictures were adapted to a white are written there under the hashes of today, as they were accepted (ci/rewrite-baseline-hashes).
#include "runner/judge/baseline_store.h"
#include "runner/judge/input_hashes.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/studies/study.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace fernlicht {
namespace {

/// The drive's, as it was before its pictures were adapted to a white.
std::string hash_before(Drive drive, int last_tick) {
    drive.display.white = {};
    return input_hashes(drive, drive.lamp_sets.front(), {}, 0, last_tick).front().second;
}

/// Of each cell of ci/nightly and of ci/test: the former hash, and today's.
std::map<std::string, std::string> hashes_of_drives() {
    std::map<std::string, std::string> hashes;
    const Study study = read_study(library_file("studies/standard.yaml"));
    for (const StudyCell& cell : cells_of(study)) {
        const Drive drive = cell_drive(study, cell);
        for (const int last_tick : {4, tick_count(drive) - 1})
            hashes[hash_before(drive, last_tick)] = input_hashes(drive, drive.lamp_sets.front(), {}, 0, last_tick).front().second;
    }
    return hashes;
}

TEST(ShippedBaselines, AreOfTheCellsOfTheStandardStudy) {
    const std::filesystem::path store = FERNLICHT_SOURCE_DIR "/baselines";
    const std::map<std::string, std::string> hashes = hashes_of_drives();
    const char* const rewritten = std::getenv("FERNLICHT_REWRITE_BASELINES");
    for (const StoredBaseline& entry : list_baselines(store)) {
        Baseline baseline = load_baseline(store, entry);
        EXPECT_EQ(hash_of_inputs(baseline.producer.inputs), entry.key.inputs) << key_text(entry.key);
        const auto drive = std::ranges::find(baseline.producer.inputs, "drive", &std::pair<std::string, std::string>::first);
        ASSERT_NE(drive, baseline.producer.inputs.end());
        if (const auto known = hashes.find(drive->second); rewritten && known != hashes.end())
            drive->second = known->second;
        EXPECT_TRUE(std::ranges::any_of(hashes, [&](const auto& row) { return row.second == drive->second; }))
            << key_text(entry.key) << ": no cell has this drive; ci/rewrite-baseline-hashes, or ci/accept-nightly where results changed";
        baseline.key.inputs = hash_of_inputs(baseline.producer.inputs);
        baseline.played_utc = entry.played_utc;
        if (rewritten)
            store_baselines(rewritten, {baseline}, Acceptance::add, entry.note);
    }
}

} // namespace
} // namespace fernlicht
