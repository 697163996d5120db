// How far a study is: cells done, running, failed, and the time left. One line that changes on a terminal, a line a cell elsewhere, nothing
// when quiet. By files/log.h.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace fernlicht {

class StudyProgress {
  public:
    StudyProgress(std::size_t cells, bool quiet);
    ~StudyProgress();
    StudyProgress(const StudyProgress&) = delete;
    StudyProgress& operator=(const StudyProgress&) = delete;

    void beat(std::size_t running);
    /// `failed`: why; "" where it was played.
    void ended(const std::string& cell, double seconds, const std::string& failed);

  private:
    std::string state() const;
    std::size_t cells_, done_ = 0, failed_ = 0, running_ = 0;
    bool quiet_, terminal_;
    std::chrono::steady_clock::time_point start_;
};

} // namespace fernlicht
