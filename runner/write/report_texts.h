// What a run leaves beside its documents: verdicts, readings and times for programs, and its page.
#pragma once

#include "runner/findings/run_page.h"

#include <filesystem>
#include <string>

namespace fernlicht {

/// JUnit: one test suite per drive and lamp set, one test case per verdict. Carries no times, so that equal runs give equal bytes.
std::string report_junit(const Report& report);

/// RFC 4180, one line per reading.
std::string report_csv(const Report& report);

/// RFC 4180, a line for each moment; "" where none was played.
std::string moments_csv(const PlayedCell& played);

/// RFC 4180: times of passes and the run's throughput. What differs from run to run is here and not in report_csv.
std::string times_csv(const Report& report);

/// One self-contained page. Frames are read from `folder`; one that is missing or unreadable is linked and said to be missing.
std::string run_page_html(const Report& report, const RunPage& page, const std::filesystem::path& folder);

/// The page of results that were kept, judged anew: verdict, title and what it was made with are the report's, all else is that of `kept`,
/// which run_page_html made. Throws InputError where it did not.
std::string rejudged_page_html(const Report& report, const RunPage& page, const std::string& kept, const std::filesystem::path& file);

} // namespace fernlicht
