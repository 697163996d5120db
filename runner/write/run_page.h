// A run's page: its document's sections about a chooser of moments with their pictures and lux maps.
#pragma once

#include "runner/findings/run_page.h"

#include <filesystem>

namespace fernlicht {

/// One self-contained page. Frames are read from `folder`; one that is missing or unreadable is linked and said to be missing.
std::string run_page_html(const Report& report, const RunPage& page, const std::filesystem::path& folder);

} // namespace fernlicht
