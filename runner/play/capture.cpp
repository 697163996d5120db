#include "runner/play/capture.h"

#include "runner/files/output_folder.h"
#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/trace.h"

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <oneapi/tbb/global_control.h>
#include <optional>

namespace fernlicht {

bool has_core_beside_drawing() {
    using oneapi::tbb::global_control;
    return std::thread::hardware_concurrency() > 1 && global_control::active_value(global_control::max_allowed_parallelism) > 1;
}

Writers::Writers(int threads, std::size_t max_waiting) : max_waiting_(max_waiting) {
    for (int i = 0; i < threads; ++i)
        threads_.emplace_back([this] { work(); });
}

Writers::~Writers() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void Writers::work() {
    name_traced_thread("writer");
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
        if (waiting_.empty())
            return;
        const std::function<void()> job = std::move(waiting_.front());
        waiting_.pop_front();
        ++running_;
        lock.unlock();
        std::exception_ptr failure;
        try {
            job();
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        --running_;
        if (failure && !failure_)
            failure_ = failure;
        changed_.notify_all();
    }
}

void Writers::submit(std::function<void()> job) {
    if (threads_.empty()) {
        job();
        return;
    }
    std::unique_lock lock(mutex_);
    std::optional<TraceSpan> waiting;
    if (waiting_.size() >= max_waiting_)
        waiting.emplace("wait for a writer", "write");
    changed_.wait(lock, [this] { return waiting_.size() < max_waiting_ || failure_; });
    if (failure_)
        std::rethrow_exception(std::exchange(failure_, nullptr));
    waiting_.push_back(std::move(job));
    changed_.notify_all();
}

void Writers::finish() {
    const TraceSpan span("wait for all writers", "write");
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.empty() && running_ == 0; });
    if (failure_)
        std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool is_captured(const Capture& capture, int tick, double step_s) {
    if (capture.all || tick == 0)
        return true;
    if (!(capture.per_second > 0.0))
        return false;
    // A hair of tolerance: 15 * (1 / 30) is a little less than 0.5.
    const auto index = [&](int t) { return std::floor(t * step_s * capture.per_second + 1e-9); };
    return index(tick) > index(tick - 1);
}

std::string frame_stem(const std::string& set, const View& view, int tick) {
    return fmt::format("frames/{}/{}-{:06}", file_name_of(set), file_name_of(view.name), tick);
}

StoredFrame store_frame(Writers& writers, const std::filesystem::path& folder, const std::string& set, const Capture& capture, Frame frame,
                        const Moment& moment, const View& view, const WritePicture& write_picture) {
    const std::string stem = frame_stem(set, view, moment.tick);
    const std::filesystem::path place = (folder / stem).parent_path();
    StoredFrame stored{moment.tick, moment.time_s, view.name, {}, {}};
    const bool png = capture.png && !frame.colour.empty(), exr = capture.exr && has_linear_picture(frame);
    if (!png && !exr)
        return stored; // and no folder for nothing
    std::error_code error;
    std::filesystem::create_directories(place, error);
    if (error)
        throw DeviceError(place.string() + ": cannot be made: " + error.message());
    const auto shared = std::make_shared<const Frame>(std::move(frame));
    if (png) {
        stored.png = stem + ".png";
        writers.submit([shared, view, write_picture, path = folder / stored.png] {
            const TraceSpan span("write PNG", "write");
            write_picture(*shared, view, path);
        });
    }
    if (exr) {
        stored.exr = stem + ".exr";
        writers.submit([shared, moment, view, path = folder / stored.exr] {
            const TraceSpan span("write EXR", "write");
            write_exr(*shared, moment, view, path);
        });
    }
    return stored;
}

} // namespace fernlicht
