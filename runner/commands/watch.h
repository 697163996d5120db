// --watch: a command runs again whenever a file that it read has changed.
#pragma once

#include "scenarios/values/files.h"

#include <functional>
#include <map>
#include <set>

namespace CLI {
class App;
}

namespace fernlicht {

/// One time of it. Without --watch nothing of this does anything.
class WatchTurn {
  public:
    /// What is waited for afterwards, whatever becomes of the turn.
    void reads(const FilesRead& files);
    void reads(const std::filesystem::path& file);
    bool is_again() const { return number_ > 1; }

    /// Where the results go that are to end in `folder`: from the second turn on into a new folder beside it, which takes its place when
    /// all is written.
    std::filesystem::path folder(const std::filesystem::path& folder);
    /// The page as it lies in the end.
    std::filesystem::path page() const { return folder_ / "report.html"; }
    /// Has the page in this turn's folder load itself again when there is a newer one, and show what keeps it from being made.
    void page_written() const;
    /// Figures by name; from the second turn on those that are others than in the turn before go to standard output.
    void tell_figures(const std::vector<std::pair<std::string, std::string>>& figures);

  private:
    friend int watched(bool, const std::function<int(WatchTurn&)>&);
    void put_in_place();
    void drop() const;
    void tell_page(const std::string& message) const;

    int number_ = 0, page_number_ = 0;
    std::filesystem::path folder_, written_;
    std::set<std::filesystem::path> own_; ///< names in the folder that are not somebody else's
    FilesRead read_;
    std::map<std::string, std::string> figures_;
};

/// Gives the exit code. With --watch only Ctrl-C ends it, and what cannot be put right by writing a file: errors of the first turn that
/// stand in no file that is there, and those of the machine.
int watched(bool watch, const std::function<int(WatchTurn&)>& play);

void add_watch_flag(CLI::App& command, bool& watch);

} // namespace fernlicht
