// A page on disk as a link, and in a browser.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// "file:///home/a%20b/report.html"; under WSL as browsers of Windows find it.
std::string file_url(const std::filesystem::path& file);

/// The path as it is; on a terminal, where standard output is one that shows links and on this machine, a link to the file (OSC 8).
std::string page_link(const std::filesystem::path& page);

/// Hands the page to a browser: the programs of $BROWSER, else what WSL or the desktop has; returns what took it, "" where there is none.
std::string open_page(const std::filesystem::path& page);

} // namespace fernlicht
