// The history as documents for people and as CSV for programs.
#pragma once

#include "runner/experiments/history/history_findings.h"
#include "runner/experiments/study/study_result.h"

#include <functional>

namespace fernlicht {

/// That nights before tonight are dated after it, and what to do; "" where none is.
std::string clock_warning(const HistoryFindings& findings);
/// What changed since the last accepted night, dated and with its causes: what a night's report leads with.
Section changes_section(const HistoryFindings& findings);
/// That section first, then the readings behind it, what was told apart, times, sparklines and frames.
std::vector<Section> history_sections(const HistoryFindings& findings);
Document document(const HistoryFindings& findings);

/// A study's result of tonight against the history in `file`, whether it was added there or not; `folder` is the study's. Its frames and
/// those of the accepted night are found in their folders. Warns where clocks disagree. Throws as History; where `file` is not there,
/// tonight is the first night.
HistoryFindings history_of(const std::filesystem::path& file, const StudyResult& tonight, const std::filesystem::path& folder,
                           const HistoryOptions& options = {});

/// Of the cells whose readings stand elsewhere than in the base night, at most `most`; says in `no_frames` what is not there.
void add_frames(HistoryFindings& findings, std::size_t most = 6);

/// A small line over the nights for each lamp and route: of the readings that moved most, then of deciding ones, `most` in all, and of
/// times.
std::vector<Plot> sparklines(const HistoryFindings& findings, std::size_t most = 4);

/// The readings whose names fit the pattern (glob.h), "frame_s" for times: since which night they stand where, with the causes. `cells` are
/// patterns, too. Throws InputError, naming the nearest, where none fits.
Document trend_document(const std::vector<Night>& nights, const std::string& reading, const std::vector<std::string>& cells);

/// Tidy CSV (RFC 4180): one line a night, cell and reading, with what it was read under; times are `frame_s`. `take` gets it night by
/// night.
void export_csv(const std::vector<Night>& nights, const std::function<void(const std::string&)>& take);

/// "reach at 5 lx on a target, own lane"; "time a frame"; a name of an older fernlicht as it is.
std::string label_of_reading(const std::string& name);
/// With its unit: "40.25 m", "> 200 m", "not measured".
std::string told_value(const std::string& reading, const Value& value, int digits = 4);
/// "40.25 m → 41.1 m", with as many digits as it takes to tell two values apart.
std::string told_step(const std::string& reading, const Value& before, const Value& now);
/// "+2.31 %", "+0.00012 %"; "" where there is none.
std::string told_share(const std::optional<double>& share);

inline constexpr const char* timed_frame = "frame_s";

} // namespace fernlicht
