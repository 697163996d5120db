// Every reader of files as a function of their bytes: what the fuzzer feeds, and what replays its corpus.
#pragma once

#include "scenarios/values/errors.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht::fuzz {

/// One reader. Its input may hold several files: parts, cut at each `part_end`, in the order of `files`.
struct Reader {
    std::string_view name;               ///< of the target
    std::vector<std::string_view> files; ///< below the folder; the first is always written
    void (*read)(const std::filesystem::path& folder);
    std::string_view words; ///< sources whose texts in quotes make its dictionary: files and folders, by blanks
    std::string_view seeds; ///< files of this repository that it begins with, beside tests/fuzz/seeds/NAME: patterns, by blanks
};

/// Between the files of one input. A file whose part is missing is a companion or is not there.
inline constexpr std::string_view part_end = "\n%%%%\n";

/// A new reader is one line of these tables.
std::span<const Reader> scenarios_readers(); ///< lamps, roads, storyboards, drives, studies, buses, models, pictures
std::span<const Reader> runner_readers();    ///< what runs, studies and stores leave behind, and lists that users keep of them

/// Files that inputs may name, made in `folder`: road.xodr, low.ies, drive.yaml, catalogs/cars.xosc ...
void make_companions(const std::filesystem::path& folder);

/// Writes the input's files into the folder of companions and reads them. A refusal (InputError, DeviceError) is an answer; whatever else
/// is thrown comes out.
void feed(const Reader& reader, std::string_view bytes, const std::filesystem::path& folder);

/// One of several readers of the same files: its refusal does not keep the next from reading.
template <class Read> void tried(const Read& read) {
    try {
        read();
    } catch (const InputError&) {
    } catch (const DeviceError&) {
    }
}

/// Inputs in one file: of each the number of its bytes, a line end, its bytes. Throws std::runtime_error for what is no such file.
std::vector<std::string> unpacked(const std::filesystem::path& pack);
std::string packed(const std::vector<std::string>& inputs);

/// All that is kept of one reader: tests/fuzz/seeds/NAME and tests/fuzz/corpus/NAME.pack below `tests_fuzz`, by name.
std::vector<std::string> kept_inputs(const Reader& reader, const std::filesystem::path& tests_fuzz);

} // namespace fernlicht::fuzz
