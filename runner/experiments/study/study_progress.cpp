#include "runner/experiments/study/study_progress.h"

#include "runner/files/log.h"
#include "runner/play/progress.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string minutes_text(double seconds) {
    const int whole = static_cast<int>(std::lround(seconds));
    return whole >= 3600 ? fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
                         : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

StudyProgress::StudyProgress(std::size_t cells, bool quiet)
    : cells_(cells), quiet_(quiet || !is_told(LogLevel::info)), terminal_(is_for_eyes()), start_(std::chrono::steady_clock::now()) {}

StudyProgress::~StudyProgress() {
    if (!quiet_ && terminal_ && cells_ > 0)
        fmt::print(stderr, "\n");
}

std::string StudyProgress::state() const {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::size_t ended = done_ + failed_;
    return fmt::format(
        "{} of {} cells done, {} running, {} failed{}", done_, cells_, running_, failed_,
        ended == 0 ? ""
                   : fmt::format(", {} left", minutes_text(elapsed / static_cast<double>(ended) * static_cast<double>(cells_ - ended))));
}

void StudyProgress::beat(std::size_t running) {
    running_ = running;
    if (!quiet_ && terminal_)
        fmt::print(stderr, "\r{}\x1b[K", state());
}

void StudyProgress::ended(const std::string& cell, double seconds, const std::string& failed) {
    ++(failed.empty() ? done_ : failed_);
    running_ -= running_ > 0 ? 1U : 0U;
    if (quiet_)
        return;
    if (terminal_) {
        if (!failed.empty())
            fmt::print(stderr, "\r\x1b[Kcell {} failed: {}\n", cell, failed);
        return beat(running_);
    }
    LogFields fields{{"cell", cell},
                     {"seconds", seconds},
                     {"done", static_cast<std::int64_t>(done_)},
                     {"failed", static_cast<std::int64_t>(failed_)},
                     {"running", static_cast<std::int64_t>(running_)},
                     {"total", static_cast<std::int64_t>(cells_)}};
    if (!failed.empty())
        fields.emplace_back("why", failed);
    tell(LogLevel::info,
         fmt::format("cell {}: {}; {}", cell,
                     failed.empty() ? (seconds > 0.0 ? fmt::format("{:.1f} s", seconds) : "done") : "failed: " + failed, state()),
         fields);
}

} // namespace fernlicht
