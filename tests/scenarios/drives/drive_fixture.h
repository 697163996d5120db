// A folder of its own for each test, with a road file, lamp files and a spectrum, and drives to read there.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/values/errors.h"

#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace fernlicht {

/// LM-63-2002, type A, a peak of `peak_cd` straight ahead.
inline std::string ies_text(double peak_cd) {
    return fmt::format("IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] none\n[MANUFAC] none\nTILT=NONE\n"
                       "1 -1 1 3 3 3 2 0 0 0\n1 1 0\n-10 0 10\n-20 0 20\n0 10 0\n10 {} 10\n0 10 0\n",
                       peak_cd);
}

class DriveFixture : public testing::Test {
  protected:
    DriveFixture() {
        const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
        folder =
            std::filesystem::temp_directory_path() / fmt::format("fernlicht-{}-{}-{}", test.test_suite_name(), test.name(), ::getpid());
        std::filesystem::create_directories(folder);
        write_file(folder / "road.xodr", "<OpenDRIVE/>");
        write_file(folder / "low.ies", ies_text(1000.0));
        write_file(folder / "other.ies", ies_text(2000.0));
        std::string spectrum;
        for (int nm = 380; nm <= 780; nm += 10)
            spectrum += fmt::format("{}, {}\n", nm, 1.0 + 0.001 * (nm - 380));
        write_file(folder / "spectrum.csv", spectrum);
    }
    ~DriveFixture() override { std::filesystem::remove_all(folder); }

    Drive read(const std::string& yaml, const DriveEdits& edits = {}) {
        write_file(folder / "drive.yaml", yaml);
        return read_drive(folder / "drive.yaml", edits);
    }
    /// What read_drive says, without the folder's name.
    std::string refusal(const std::string& yaml, const DriveEdits& edits = {}) {
        try {
            read(yaml, edits);
        } catch (const InputError& error) {
            std::string text = error.what();
            for (std::size_t at; (at = text.find(folder.string() + "/")) != std::string::npos;)
                text.erase(at, folder.string().size() + 1);
            return text;
        }
        return "not refused";
    }

    std::filesystem::path folder;
    const std::string minimal = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\nvariants:\n  one: {file: low.ies}\n";
};

} // namespace fernlicht
