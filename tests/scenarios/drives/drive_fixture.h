// A folder of its own for each test, with a road file, lamp files and a spectrum, and drives to read there.
#pragma once

#include "scenarios/drives/drive.h"
#include "tests/trial.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

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
        write_file(folder / "road.xodr", "<OpenDRIVE/>");
        write_file(folder / "low.ies", ies_text(1000.0));
        write_file(folder / "other.ies", ies_text(2000.0));
        std::string spectrum;
        for (int nm = 380; nm <= 780; nm += 10)
            spectrum += fmt::format("{}, {}\n", nm, 1.0 + 0.001 * (nm - 380));
        write_file(folder / "spectrum.csv", spectrum);
    }
    Drive read(const std::string& yaml, const DriveEdits& edits = {}) {
        write_file(folder / "drive.yaml", yaml);
        return read_drive(folder / "drive.yaml", edits);
    }
    /// What read_drive says, without the folder's name.
    std::string refusal(const std::string& yaml, const DriveEdits& edits = {}) {
        std::string text = tests::refusal_of([&] { read(yaml, edits); });
        for (std::size_t at; (at = text.find(folder.string() + "/")) != std::string::npos;)
            text.erase(at, folder.string().size() + 1);
        return text;
    }

    const std::filesystem::path folder = tests::new_folder();
    const std::string minimal = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\nlamp_sets:\n  one: {file: low.ies}\n";
};

} // namespace fernlicht
