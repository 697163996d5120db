// The shipped baselines stand under the inputs of the standard study's cells. With FERNLICHT_REWRITE_BASELINES=FOLDER those whose inputs
// were hashed over the text of lamps are written there under the hashes of today, as they were accepted (ci/rewrite-baseline-hashes).
#include "runner/judge/baseline_store.h"
#include "runner/judge/input_hashes.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/studies/study.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace fernlicht {
namespace {

/// As inputs were hashed before the keys of lamps had ids: those of lamp sets over their text.
std::string hash_over_text(Drive drive, int last_tick) {
    drive.title.clear();
    drive.limits.clear();
    drive.road_file.clear();
    int used = 0;
    for (LampSource& source : drive.lamp_sources)
        if (std::ranges::any_of(drive.lamp_sets.front().lamps, [&](const MountedLamp& lamp) { return lamp.file == source.file; }) ||
            std::ranges::any_of(drive.lamp_sets.front().changes, [&](const LampChange& change) { return change.file == source.file; }))
            source.path = fmt::format("lamp file {}", ++used);
    const std::string written = write_drive(drive), start = "\nlamp_sets:";
    const std::size_t from = written.find(start) + start.size();
    std::size_t to = from; // where the next key at the top begins
    do
        to = written.find('\n', to + 1);
    while (written[to + 1] == ' ');
    Group before = drive_fields(), after = before;
    std::erase_if(before.fields, [](const Field& field) { return field.id >= 18; });
    std::erase_if(after.fields, [](const Field& field) { return field.id <= 18; });
    const std::string bits = fmt::format("{}18={}\n{}moments: [0, {}]\n", field_bits(before, &drive), written.substr(from, to - from),
                                         field_bits(after, &drive), last_tick);
    return content_hash(bits.data(), bits.size());
}

/// Of each cell of ci/nightly and of ci/test: the hash over text, and today's.
std::map<std::string, std::string> hashes_of_drives() {
    std::map<std::string, std::string> hashes;
    const Study study = read_study(library_file("studies/standard.yaml"));
    for (const StudyCell& cell : cells_of(study)) {
        const Drive drive = cell_drive(study, cell);
        for (const int last_tick : {4, tick_count(drive) - 1})
            hashes[hash_over_text(drive, last_tick)] = input_hashes(drive, drive.lamp_sets.front(), {}, 0, last_tick).front().second;
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
        if (rewritten)
            store_baselines(rewritten, {baseline}, Acceptance::add, entry.note, entry.played_utc);
    }
}

} // namespace
} // namespace fernlicht
