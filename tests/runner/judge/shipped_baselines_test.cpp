// The shipped baselines stand under the inputs of the standard study's cells. With FERNLICHT_REWRITE_BASELINES=FOLDER those whose inputs
// were hashed over the text of drives are written there under the hashes of today, as they were accepted (ci/rewrite-baseline-hashes).
#include "runner/judge/cell_inputs.h"
#include "runner/judge/reference_store.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/studies/study.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace fernlicht {
namespace {

/// As inputs were hashed before keys had ids.
std::string hash_over_text(Drive drive, int last_tick) {
    drive.title.clear();
    drive.limits.clear();
    drive.road_file = "road";
    int used = 0;
    for (LampSource& source : drive.lamp_sources)
        if (std::ranges::any_of(drive.variants.front().lamps, [&](const MountedLamp& lamp) { return lamp.file == source.file; }) ||
            std::ranges::any_of(drive.variants.front().changes, [&](const LampChange& change) { return change.file == source.file; }))
            source.path = fmt::format("lamp file {}", ++used);
    std::string text = write_drive(drive);
    text.erase(0, text.find('\n') + 1); // the comment names the program's version
    text += fmt::format("moments: [0, {}]\n", last_tick);
    return content_hash(text.data(), text.size());
}

/// Of each cell of ci/nightly and of ci/test: the hash over text, and today's.
std::map<std::string, std::string> hashes_of_drives() {
    std::map<std::string, std::string> hashes;
    const Study study = read_study(library_file("studies/standard.yaml"));
    for (const StudyCell& cell : cells_of(study)) {
        const Drive drive = cell_drive(study, cell);
        for (const int last_tick : {4, tick_count(drive) - 1})
            hashes[hash_over_text(drive, last_tick)] = cell_inputs(drive, drive.variants.front(), {}, 0, last_tick).front().second;
    }
    return hashes;
}

TEST(ShippedBaselines, AreOfTheCellsOfTheStandardStudy) {
    const std::filesystem::path store = FERNLICHT_SOURCE_DIR "/references";
    const std::map<std::string, std::string> hashes = hashes_of_drives();
    const char* const rewritten = std::getenv("FERNLICHT_REWRITE_BASELINES");
    for (const StoredReference& entry : list_references(store)) {
        AcceptedReference baseline = load_reference(store, entry);
        EXPECT_EQ(hash_of_inputs(baseline.producer.inputs), entry.key.inputs) << key_text(entry.key);
        const auto drive = std::ranges::find(baseline.producer.inputs, "drive", &std::pair<std::string, std::string>::first);
        ASSERT_NE(drive, baseline.producer.inputs.end());
        if (const auto known = hashes.find(drive->second); rewritten && known != hashes.end())
            drive->second = known->second;
        EXPECT_TRUE(std::ranges::any_of(hashes, [&](const auto& row) { return row.second == drive->second; }))
            << key_text(entry.key) << ": no cell has this drive; ci/rewrite-baseline-hashes, or ci/accept-nightly where results changed";
        baseline.key.inputs = hash_of_inputs(baseline.producer.inputs);
        if (rewritten)
            store_references(rewritten, {baseline}, Acceptance::add, entry.note, entry.played_utc);
    }
}

} // namespace
} // namespace fernlicht
