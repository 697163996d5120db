// Accepted results of one drive with one lamp set, technique and class of device: what later runs are judged by.
#pragma once

#include "metrics/readings/readings.h"
#include "runner/judge/reference_key.h"

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

struct ReferenceFrame {
    int tick = 0;
    std::string view;
    std::filesystem::path exr; ///< where the file lies
    std::string xxh128;        ///< of its bytes; in the store also its name
};

/// Who made the results. Not part of what is compared.
struct Producer {
    std::vector<std::pair<std::string, std::string>> versions; ///< fernlicht, libraries, compiler
    std::string gl_version, cpu, os;
    std::vector<std::pair<std::string, std::string>> inputs; ///< name -> XXH3-128 (cell_inputs.h)
};

struct AcceptedReference {
    ReferenceKey key;
    Producer producer;
    std::vector<AcceptedReading> readings; ///< times left out
    std::vector<ReferenceFrame> frames;
    bool frames_left_out = false; ///< accepted without its frames: readings alone are compared
};

/// What a run or a picture by rays found, as it would be accepted.
struct RunResults {
    std::vector<AcceptedReference> references; ///< one for each lamp set of each drive
    std::string started_utc;
};

/// The same readings and the same bytes of frames, whoever made them.
bool same_results(const AcceptedReference& a, const AcceptedReference& b);

/// Its text as an object of the store: the same reference gives the same bytes. Throws InputError for what is not such a text; `file`
/// is where it was read. Frames come back without a path.
std::string reference_object(const AcceptedReference& reference);
AcceptedReference read_reference_object(const std::filesystem::path& file);

} // namespace fernlicht
