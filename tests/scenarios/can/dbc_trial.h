// Small DBC files that the tests write themselves.
#pragma once

#include "scenarios/can/can_database.h"
#include "scenarios/values/errors.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

namespace fernlicht {

/// A folder of one test, gone with it.
class DbcTrial : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "fernlicht-dbc-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& content, const std::string& name = "trial.dbc") const {
        const std::filesystem::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << content;
        return path;
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
        try {
            read(content);
        } catch (const InputError& error) {
            const std::string said = error.what();
            const std::size_t name = said.find("trial.dbc");
            return name == std::string::npos ? said : said.substr(name);
        }
        return "";
    }

    std::filesystem::path folder_;
};

inline std::string all_notes(const CanDatabase& database) {
    std::string out;
    for (const std::string& note : database.notes)
        out += note + "\n";
    return out;
}

} // namespace fernlicht
