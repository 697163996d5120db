// What every experiment's findings begin with, and what was judged.
#pragma once

#include "scenarios/values/files.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

struct RunContext {
    std::vector<std::pair<std::string, std::string>> versions; ///< fernlicht, libraries, compiler
    std::string backend, gl_renderer, gl_version, cpu, os;
    std::string command;     ///< as typed, shell-quoted, ready to paste
    std::string started_utc; ///< ISO 8601
    std::uint64_t seed = 1;
    FilesRead inputs;
};

/// What all findings begin with.
struct Findings {
    RunContext context;
    std::string interrupted;          ///< why not all was measured; "" where it was
    std::vector<std::string> missing; ///< what was not measured because of that, one sentence each
};

/// What an experiment is asked for beside its own.
template <class Result> struct ExperimentRequest {
    std::string backend = "auto";
    std::filesystem::path folder; ///< for the files; made when all input is read and the device is found sane
    std::vector<std::string> command;
    bool quiet = false;
    std::function<void(const Result&)> write; ///< takes what was found, also when it was interrupted; the folder is there
};

/// flaky: repeats of the same thing differ.
enum class VerdictKind { pass, fail, not_measured, flaky };
/// What the list of known failures says of a verdict.
enum class Expectation {
    none,           ///< it is not listed
    known,          ///< red as it was listed: no news
    expired,        ///< red as it was listed, but the entry's time is over
    unexpected_pass ///< listed as failing and green
};
struct Verdict {
    VerdictKind kind = VerdictKind::pass;
    std::string name;  ///< "reach_5lx_road_own_m"
    std::string text;  ///< "61.2 m, limit at least 60 m"
    std::string rerun; ///< command that repeats just this
    Expectation expectation = Expectation::none;
    std::string known = {}; ///< the list's entry in a sentence; "" where it is not listed
    std::size_t line = 0;   ///< of the limit, in the drive's or the study's file; 0: of no such limit
};

/// What turns a run red: whatever is not green and not known, and what is green against expectation.
inline bool is_red(const Verdict& verdict) {
    return verdict.expectation == Expectation::unexpected_pass ||
           (verdict.kind != VerdictKind::pass && verdict.expectation != Expectation::known);
}

} // namespace fernlicht
