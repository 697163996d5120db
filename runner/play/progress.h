// How far a run is: a bar with rate and remaining time on a terminal, plain lines elsewhere, nothing when quiet. On stderr.
#pragma once

#include <chrono>
#include <string>

namespace fernlicht {

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

} // namespace fernlicht
