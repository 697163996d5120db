#include "runner/commands/watch.h"

#include "runner/files/file_watch.h"
#include "runner/files/json_text.h"
#include "runner/files/log.h"
#include "runner/play/progress.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <system_error>
#include <unistd.h>
#include <unordered_set>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr const char* news_file = "watch.js";

/// A page from disk may not read files, but it may run one beside it; where a browser forbids that too, it loads itself when it is looked
/// at.
constexpr std::string_view reloading = R"(<script>(() => {{
const turn = {};
let asked = 0, heard = false;
window.fernlicht_turn = (now, told) => {{
  heard = true;
  if (now !== turn) location.reload();
  let bar = document.getElementById('fernlicht-watch');
  if (!told) {{ if (bar) bar.remove(); return; }}
  if (!bar) {{
    bar = document.createElement('p');
    bar.id = 'fernlicht-watch';
    bar.style.cssText = 'position:fixed;inset:0 0 auto;margin:0;padding:.6em 1.2em;background:#fff3c4;color:#222;font:14px sans-serif;z-index:9;border-bottom:1px solid #b8860b;white-space:pre-wrap';
    document.body.append(bar);
  }}
  bar.textContent = told;
}};
const ask = () => {{
  const news = document.createElement('script');
  news.src = '{}?' + ++asked;
  news.onload = news.onerror = () => news.remove();
  document.head.append(news);
}};
setInterval(() => {{ if (!document.hidden) ask(); }}, 1000);
addEventListener('focus', () => {{ if (!heard) location.reload(); }});
}})()</script>
)";

/// Its policy lets a page run nothing from elsewhere.
void allow_news(std::string& page) {
    constexpr std::string_view scripts = "script-src 'unsafe-inline'", base = "base-uri 'none'";
    if (const std::size_t at = page.find(scripts); at != std::string::npos)
        page.insert(at + scripts.size(), " file:");
    else if (const std::size_t end = page.find(base); end != std::string::npos)
        page.insert(end, fmt::format("{} file:; ", scripts));
}

std::set<fs::path> names_in(const fs::path& folder) {
    std::set<fs::path> names;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        names.insert(entry.path().filename());
    return names;
}

/// `newer` takes the place of `older`, at once where the file system can.
void exchange(const fs::path& newer, const fs::path& older) {
    if (::renameat2(AT_FDCWD, newer.c_str(), AT_FDCWD, older.c_str(), RENAME_EXCHANGE) == 0)
        return;
    const fs::path aside = newer.string() + "-old";
    std::error_code failed;
    fs::rename(older, aside, failed);
    if (!failed)
        fs::rename(newer, older, failed);
    if (!failed)
        fs::rename(aside, newer, failed);
    if (failed)
        throw DeviceError(fmt::format("{}: cannot be replaced by {}: {}", older.string(), newer.string(), failed.message()));
}

} // namespace

void WatchTurn::reads(const FilesRead& files) {
    for (const FileRead& file : files) {
        const auto known = std::ranges::find(read_, file.path, &FileRead::path);
        if (known == read_.end())
            read_.push_back(file);
        else if (known->xxh128.empty())
            known->xxh128 = file.xxh128;
    }
}

void WatchTurn::reads(const fs::path& file) {
    if (number_ > 0 && !file.empty())
        reads(FilesRead{{file, 0, hash_of_file(file)}}); // as it is before anybody reads it
}

fs::path WatchTurn::folder(const fs::path& folder) {
    if (number_ == 0 || folder_.empty() || !fs::exists(folder_)) {
        folder_ = written_ = folder_.empty() ? folder : folder_;
        return written_;
    }
    written_ = folder_.lexically_normal();
    if (!written_.has_filename())
        written_ = written_.parent_path();
    written_ += fmt::format(".next-{}", ::getpid());
    std::error_code ignored;
    fs::remove_all(written_, ignored); // of a turn that was broken off
    return written_;
}

void WatchTurn::page_written() const {
    if (number_ == 0)
        return;
    FilesRead ignored;
    std::string page = read_file(written_ / "report.html", ignored);
    allow_news(page);
    page.insert(std::min(page.rfind("</body>"), page.size()), fmt::format(fmt::runtime(reloading), number_, news_file));
    write_file(written_ / news_file, fmt::format("fernlicht_turn({}, '');\n", number_));
    write_file(written_ / "report.html", page);
}

void WatchTurn::tell_figures(const std::vector<std::pair<std::string, std::string>>& figures) {
    for (const auto& [name, figure] : figures) {
        const auto before = figures_.find(name);
        if (is_again() && before != figures_.end() && before->second != figure)
            fmt::print("{}: {} -> {}\n", name, before->second, figure);
        figures_[name] = figure;
    }
}

void WatchTurn::put_in_place() {
    if (written_.empty() || !fs::exists(written_))
        return;
    if (written_ != folder_) {
        exchange(written_, folder_);
        std::error_code ignored;
        for (const fs::path& name : names_in(written_)) // what somebody else put there stays
            if (!own_.contains(name) && !fs::exists(folder_ / name))
                fs::rename(written_ / name, folder_ / name, ignored);
        fs::remove_all(written_, ignored);
    }
    own_ = names_in(folder_);
    page_number_ = number_;
    written_.clear();
}

void WatchTurn::drop() const {
    std::error_code ignored;
    if (written_ != folder_)
        fs::remove_all(written_, ignored);
}

void WatchTurn::tell_page(const std::string& message) const {
    std::error_code ignored;
    if (page_number_ == 0 || !fs::is_directory(folder_, ignored))
        return;
    try {
        write_file(folder_ / news_file, fmt::format("fernlicht_turn({}, {});\n", page_number_, json_quoted(message)));
    } catch (const DeviceError&) { // the terminal says it, too
    }
}

int watched(bool watch, const std::function<int(WatchTurn&)>& play) {
    WatchTurn turn;
    if (!watch)
        return play(turn);
    for (FilesRead before;; before = turn.read_) {
        ++turn.number_;
        turn.read_.clear();
        std::string broken;
        try {
            const int code = play(turn);
            std::fflush(stdout);
            if (Interruption::requested()) {
                turn.drop();
                return code;
            }
            turn.put_in_place();
        } catch (const InputError& error) {
            std::fflush(stdout);
            const fs::path& file = error.where().file;
            std::error_code ignored;
            turn.drop();
            if (turn.number_ == 1 && (file.empty() || !fs::exists(file, ignored) || error.where().key.starts_with("--")))
                throw;
            tell(LogLevel::error, error.what());
            broken = error.what();
            for (FileRead& one : before) // with what they hold now: they were not what changed, or were looked at in vain
                one.xxh128 = hash_of_file(one.path);
            turn.reads(before);
            turn.reads(file);
        } catch (...) {
            turn.drop();
            throw;
        }
        FileWatch files(turn.read_);
        turn.tell_page(broken);
        tell(LogLevel::info, fmt::format("watching {} files; Ctrl-C ends", turn.read_.size()));
        std::vector<std::string> names;
        for (const fs::path& file : files.wait())
            names.push_back(fs::proximate(file).string());
        const std::string changed = fmt::format("changed: {}", fmt::join(names, ", "));
        tell(LogLevel::info, changed);
        turn.tell_page(changed + "; playing again");
    }
}

void add_watch_flag(CLI::App& command, bool& watch) {
    command.add_flag("--watch", watch, "repeat whenever a file it read changes, until Ctrl-C; open pages follow");
}

} // namespace fernlicht
