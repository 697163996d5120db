// Small DBC files that the tests write themselves.
#pragma once

#include "scenarios/can/can_database.h"
#include "tests/trial.h"

#include <gmock/gmock.h>
#include <string>

namespace fernlicht {

/// A folder of one test, gone with it.
class DbcTrial : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& content, const std::string& name = "trial.dbc") const {
        return tests::written(name, content, folder_);
    }
    CanDatabase read(const std::string& content) const {
        FilesRead opened;
        return read_dbc(write(content), opened);
    }
    /// One message of id 16 and 8 bytes with these SG_ lines, then the rest.
    CanMessage message(const std::string& signals, const std::string& rest = {}, int length = 8) const {
        return read("BU_:\nBO_ 16 Lamp: " + std::to_string(length) + " Node\n" + signals + "\n" + rest).messages.at(0);
    }
    /// What the reader says behind the name of the file, "" when it reads.
    std::string refusal(const std::string& content) const {
        const std::string said = tests::refusal_of([&] { read(content); }, "");
        const std::size_t name = said.find("trial.dbc");
        return name == std::string::npos ? said : said.substr(name);
    }

    const std::filesystem::path folder_ = tests::new_folder();
};

using tests::all_notes;

} // namespace fernlicht
