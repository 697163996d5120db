// Accepted results of one drive with one lamp set, technique and device class: what later runs are judged by.
#pragma once

#include "metrics/readings/readings.h"
#include "runner/judge/baseline_key.h"

#include <filesystem>

namespace fernlicht {

/// A reading over the repeats in which it was measured.
struct AcceptedReading {
    ReadingKey key;
    int tick = -1;         ///< -1: of the whole drive
    Value mean;            ///< without a reason where it is not measured
    int count = 1;         ///< repeats
    double variance = 0.0; ///< the sample's (n - 1); 0 where all repeats agree
    bool operator==(const AcceptedReading&) const = default;
};

struct BaselineFrame {
    int tick = 0;
    std::string view;
    std::filesystem::path exr; ///< where the file lies
    std::string xxh128;        ///< of its bytes; in the store also its name
};

/// Who made the results. Not part of what is compared.
struct Producer {
    std::vector<std::pair<std::string, std::string>> versions; ///< fernlicht, libraries, compiler
    std::string gl_version, cpu, os;
    std::vector<std::pair<std::string, std::string>> inputs; ///< name -> XXH3-128 (input_hashes.h)
};

struct Baseline {
    BaselineKey key;
    Producer producer;
    std::vector<AcceptedReading> readings; ///< times left out
    std::vector<BaselineFrame> frames;
    bool frames_left_out = false; ///< accepted without its frames: readings alone are compared
    std::string played_utc = {};  ///< of what is to be accepted: the store's index has it
};

/// The same readings and the same bytes of frames, whoever made them.
bool same_results(const Baseline& a, const Baseline& b);

/// Its text as an object of the store: the same baseline gives the same bytes. Throws InputError for what is not such a text; `file`
/// is where it was read. Frames come back without a path.
std::string baseline_object(const Baseline& baseline);
Baseline read_baseline_object(const std::filesystem::path& file);

} // namespace fernlicht
