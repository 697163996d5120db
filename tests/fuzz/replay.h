// Reads again what is kept of the fuzzer's inputs: seeds, inputs that reached something new, and each that once was a finding.
#pragma once

#include "tests/fuzz/readers.h"
#include "tests/trial.h"

#include <cctype>
#include <gtest/gtest.h>
#include <ostream>

namespace fernlicht::fuzz {

inline void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

class KeptInputs : public testing::TestWithParam<Reader> {};

/// What a reader does with an input: "" where it reads or refuses it, else what it threw instead.
inline std::string fall_of(const Reader& reader, const std::string& input, const std::filesystem::path& folder) {
    try {
        feed(reader, input, folder);
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST_P(KeptInputs, AreReadOrRefused) {
    const std::filesystem::path folder = tests::new_folder();
    make_companions(folder);
    const std::vector<std::string> inputs = kept_inputs(GetParam(), FERNLICHT_SOURCE_DIR "/tests/fuzz");
    ASSERT_FALSE(inputs.empty());
    for (const std::string& input : inputs)
        EXPECT_EQ(fall_of(GetParam(), input, folder), "") << input.size() << " bytes: " << printable(input, 400);
}

inline std::string name_of(const testing::TestParamInfo<Reader>& one) {
    std::string name(one.param.name);
    std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
    return name;
}

} // namespace fernlicht::fuzz
