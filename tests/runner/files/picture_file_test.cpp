#include "runner/files/picture_file.h"

#include "scenarios/values/errors.h"
#include "tests/runner/stored_run.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using tests::StoredRun;

TEST(ReadExr, GivesBackWhatWasWrittenAndRefusesWhatIsNone) {
    const TemporaryFolder temporary;
    const StoredRun run(temporary.path() / "run");
    const fs::path exr = run.folder / run.report.played[0].frames[0].exr;
    const auto channels = read_exr(exr);
    ASSERT_EQ(channels.size(), 2U);
    EXPECT_EQ(channels[0].name, "illuminance.lx");
    EXPECT_EQ(channels[1].name, "luminance.cdm2");
    EXPECT_EQ(channels[0].values.width(), 64);
    EXPECT_EQ(channels[0].values.at(63, 47), 64.0F);
    EXPECT_THROW(read_exr(temporary / "missing.exr"), InputError);
    for (const std::uintmax_t size : {0U, 3U, 100U, 1000U}) {
        fs::copy_file(exr, temporary / "cut.exr", fs::copy_options::overwrite_existing);
        ASSERT_GT(fs::file_size(exr), size);
        fs::resize_file(temporary / "cut.exr", size);
        EXPECT_THROW(read_exr(temporary / "cut.exr"), InputError) << size;
    }
}

} // namespace
} // namespace fernlicht
