// Small lamp files that the tests write themselves.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/pose.h"
#include "tests/trial.h"

#include <cmath>
#include <gmock/gmock.h>
#include <random>
#include <string>

namespace fernlicht {

/// Angles of a grid with random steps, and random intensities with zeros among them.
inline CandelaTable random_lamp_table(unsigned seed, bool even = false) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> count(2, 14);
    std::uniform_real_distribution<double> step(0.01, 4.0), cd(-500.0, 60000.0);
    const auto axis = [&](double from) {
        std::vector<double> out{from};
        const double fixed = step(random);
        for (int n = count(random); n > 0; --n)
            out.push_back(even ? from + fixed * static_cast<double>(out.size()) : out.back() + step(random));
        return out;
    };
    CandelaTable table{axis(-31.7 - step(random)), axis(-22.1 - step(random)), {}, {}, BetweenSamples::linear_cd};
    for (std::size_t i = table.h_deg.size() * table.v_deg.size(); i > 0; --i)
        table.cd.push_back(std::max(0.0, cd(random)));
    if (seed % 3 == 1) {
        table.gaps.resize((table.h_deg.size() - 1) * (table.v_deg.size() - 1));
        for (auto& gap : table.gaps)
            gap = random() % 4 == 0;
        table.gaps.front() = 1;
    }
    check_invariants(table);
    return table;
}

/// A folder of one test, gone with it.
class LampTrial : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        return tests::written(name, content, folder_);
    }
    LampFile read(const std::string& name, const std::string& content, const LampReadOptions& options = {}) const {
        return read_lamp(write(name, content), options);
    }
    /// What the reader says, "" when it reads.
    std::string refusal(const std::string& name, const std::string& content, const LampReadOptions& options = {}) const {
        return tests::refusal_of([&] { read(name, content, options); }, "");
    }
    /// Reads or refuses with an InputError that names the file; anything else is a failure.
    void must_not_fall_over(const std::string& name, const std::string& content) const {
        const std::string complaint = refusal(name, content);
        if (!complaint.empty()) {
            EXPECT_THAT(complaint, testing::HasSubstr(name));
        }
    }
    void must_survive_random_bytes(const std::string& name, const std::string& head, unsigned seed, int times = 150) const {
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> byte(0, 255), length(0, 400);
        for (int i = 0; i < times; ++i) {
            std::string content = head;
            for (int n = length(random); n > 0; --n)
                content += static_cast<char>(byte(random));
            must_not_fall_over(name, content);
        }
    }
    /// One byte of a good file replaced at a time.
    void must_survive_changed_bytes(const std::string& name, const std::string& good, unsigned seed, int times = 150) const {
        std::mt19937 random(seed);
        std::uniform_int_distribution<std::size_t> place(0, good.size() - 1);
        const std::string bytes("0\0 -9e.,;\n\r\xff[]#", 15);
        std::uniform_int_distribution<std::size_t> which(0, bytes.size() - 1);
        for (int i = 0; i < times; ++i) {
            std::string content = good;
            content[place(random)] = bytes[which(random)];
            must_not_fall_over(name, content);
        }
    }

    /// Written and read with tables at random, nothing is lost; what is written of what was read is the same again. Gives the last one
    /// read.
    LampFile must_come_back(const std::string& name, LampFile lamp, const std::string& format) const {
        LampFile back;
        for (unsigned seed = 0; seed < 40; ++seed) {
            lamp.table = random_lamp_table(seed);
            lamp.declared_flux_lm = seed % 2 == 0 ? std::optional(1234.5678901234567) : std::nullopt;
            write_lamp(lamp, folder_ / name);
            back = read_lamp(folder_ / name);
            EXPECT_EQ(back.table, lamp.table) << seed;
            EXPECT_EQ(back.declared_flux_lm, lamp.declared_flux_lm);
            EXPECT_EQ(std::pair(back.name, back.format), std::pair(lamp.name, format));
            EXPECT_THAT(back.notes, testing::IsEmpty());
            write_lamp(back, folder_ / ("again-" + name));
            EXPECT_EQ(read_lamp(folder_ / ("again-" + name)).table, lamp.table);
        }
        return back;
    }

    const std::filesystem::path folder_ = tests::new_folder();
};

using tests::all_notes;

} // namespace fernlicht
