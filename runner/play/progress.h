// How far a run is, and whether it was asked to end. Progress: a bar with rate and remaining time on a terminal; elsewhere a plain line a
// minute, as CI servers end a job that is silent for long; an object each tenth for programs (--log-json); nothing when quiet.
#pragma once

#include <chrono>
#include <string>

namespace fernlicht {

/// Whether standard error is a terminal on which a line may be written anew.
bool is_for_eyes();

class Progress {
  public:
    Progress(std::string label, int total, bool quiet, std::string counted = "moments");
    ~Progress();
    void done(int count);

  private:
    void show(bool last);

    std::string label_, counted_;
    int total_, count_ = 0, tenth_shown_ = 0;
    bool quiet_, terminal_;
    std::chrono::steady_clock::time_point start_, shown_;
};

/// Ctrl-C and SIGTERM ask a run to end after the moment at hand. While it lives, they set a flag; one that comes half a second after the
/// first or later ends the program at once; what comes sooner is the same wish, as `timeout` sends it to a process and to its group. One
/// within another, as a run within a study, hears what the outer one heard.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    static bool requested();
    static std::string words(); ///< "interrupted by the user", "interrupted by SIGTERM"
};

} // namespace fernlicht
