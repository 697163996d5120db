// The shipped baselines stand under the inputs of the standard study's cells.
#include "runner/judge/cell_inputs.h"
#include "runner/judge/reference_store.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/studies/study.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

namespace fernlicht {
namespace {

TEST(ShippedBaselines, AreOfTheCellsOfTheStandardStudy) {
    std::set<std::string> today, before; // hashes of the drives of ci/nightly and of ci/test; as version 0.1 had them
    const Study study = read_study(library_file("studies/standard.yaml"));
    for (const StudyCell& cell : cells_of(study)) {
        const Drive drive = cell_drive(study, cell);
        for (const int last_tick : {4, tick_count(drive) - 1}) {
            const std::string text = text_hashed_before(drive) + fmt::format("moments: [0, {}]\n", last_tick);
            before.insert(content_hash(text.data(), text.size()));
            today.insert(cell_inputs(drive, drive.variants.front(), {}, 0, last_tick).front().second);
        }
    }
    const std::filesystem::path store = FERNLICHT_SOURCE_DIR "/references";
    for (const StoredReference& entry : list_references(store)) {
        const AcceptedReference baseline = load_reference(store, entry);
        EXPECT_EQ(hash_of_inputs(baseline.producer.inputs), entry.key.inputs) << key_text(entry.key);
        EXPECT_TRUE(std::ranges::any_of(baseline.producer.inputs,
                                        [&](const auto& input) { return input.first == "drive" && today.contains(input.second); }))
            << key_text(entry.key) << ": no cell has this drive; ci/accept-nightly where results changed";
    }
    for (const char* shipped : {"e0c951e68b5f8766076a44e35e2c0a45", "8b6c595e62c09bb408d8f048e9075833", "529a4e3e1071bc2873b075b1f5b0a8ec"})
        EXPECT_TRUE(before.contains(shipped)) << shipped;
}

} // namespace
} // namespace fernlicht
