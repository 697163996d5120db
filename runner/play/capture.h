// Stores frames on other threads while the next ones are drawn.
#pragma once

#include "runner/findings/report.h"
#include "runner/play/display_step.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace fernlicht {

/// Whether this process has a core for work beside drawing: false on a machine of one core, and where oneTBB was told to use one alone.
bool has_core_beside_drawing();

/// A bounded queue of things to write. Memory stays constant: submit() waits while the queue is full. Of no threads: submit() writes.
class Writers {
  public:
    explicit Writers(int threads = has_core_beside_drawing() ? 1 : 0, std::size_t max_waiting = 8);
    ~Writers(); ///< waits for what is queued; an error that nobody asked for is dropped

    /// Throws what an earlier job threw.
    void submit(std::function<void()> job);
    /// Waits until everything is written. Throws what a job threw.
    void finish();

  private:
    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    std::size_t max_waiting_;
    int running_ = 0;
    bool stopping_ = false;
    std::exception_ptr failure_;
    std::vector<std::thread> threads_;
};

/// True for the ticks that are stored: the first at or after each multiple of 1 / per_second.
bool is_captured(const Capture& capture, int tick, double step_s);

/// Where a frame is stored, without its file's end: "frames/SET/VIEW-000012".
std::string frame_stem(const std::string& set, const View& view, int tick);

/// Queues the files of one captured frame under `folder`/frames/`set`/ and returns their paths relative to `folder`; "" for a file that
/// the frame has no picture for.
StoredFrame store_frame(Writers& writers, const std::filesystem::path& folder, const std::string& set, const Capture& capture, Frame frame,
                        const Moment& moment, const View& view, const WritePicture& write_picture);

} // namespace fernlicht
