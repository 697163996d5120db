#include "runner/commands/commands.h"

#include "runner/files/log.h"
#include "runner/files/page_link.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

/// report.html, else the only page there is: those of `bench`, `accuracy` and their like have other names. Empty: none.
fs::path page_in(const fs::path& folder) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / "report.html", ignored))
        return folder / "report.html";
    std::vector<fs::path> pages;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".html" && entry.is_regular_file(ignored))
            pages.push_back(entry.path());
    return pages.size() == 1 ? pages.front() : fs::path();
}

/// What was written last below out/, where results go without --out.
fs::path newest_result() {
    fs::path newest;
    fs::file_time_type latest{};
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator("out", ignored)) {
        const fs::path page = page_in(entry.path());
        const fs::file_time_type written = page.empty() ? fs::file_time_type::min() : fs::last_write_time(page, ignored);
        if (!page.empty() && (newest.empty() || written > latest)) {
            newest = page;
            latest = written;
        }
    }
    if (newest.empty())
        throw InputError({{}, 0, 0, "RUN"}, "there is no result in out/ here", "the folder of a run, study or comparison");
    return newest;
}

fs::path page_of(const fs::path& given) {
    std::error_code ignored;
    if (given.empty())
        return newest_result();
    refuse_windows_path(given, {{}, 0, 0, "RUN"});
    if (!fs::exists(given, ignored))
        throw InputError({given, 0, 0, {}}, "is not there", "the folder of a run, study or comparison, or its page");
    fs::path page = fs::is_directory(given, ignored) ? page_in(given) : given;
    if (!fs::is_regular_file(page, ignored))
        throw InputError({given, 0, 0, {}}, "holds no report", "the folder of a run, study or comparison");
    if (page.extension() != ".html")
        throw InputError({given, 0, 0, {}}, "is no page", "the folder of a run, study or comparison, or its page");
    return page;
}

int open(const fs::path& given) {
    const fs::path page = page_of(given);
    const std::string browser = open_page(page);
    fmt::print("{}\n", file_url(page));
    if (browser.empty())
        tell(LogLevel::info, "no browser could be started; set $BROWSER, or open this address:");
    return 0;
}

} // namespace

void add_open_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto given = std::make_shared<fs::path>();
    CLI::App* sub = app.add_subcommand("open", "show a report in the browser");
    sub->add_option("RUN", *given, "folder of a run, study or comparison, or a page")->default_str("what was written last below out/");
    sub->callback([given, &chosen] { chosen = [given] { return open(*given); }; });
}

} // namespace fernlicht
