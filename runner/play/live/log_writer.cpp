#include "runner/play/live/log_writer.h"

#include "scenarios/can/candump_log.h"
#include "scenarios/values/errors.h"

#include <cerrno>
#include <chrono>
#include <system_error>

namespace fernlicht {

LogWriter::LogWriter(std::filesystem::path file, std::int64_t offset_ns)
    : file_(std::move(file)), offset_ns_(offset_ns), out_(file_, std::ios::binary), ring_(room) {
    if (!out_)
        throw DeviceError(file_.string() + ": cannot be written: " + std::generic_category().message(errno));
    thread_ = std::thread([this] { write(); });
}

LogWriter::~LogWriter() {
    ends_ = true;
    if (thread_.joinable())
        thread_.join();
}

void LogWriter::add(const CanFrame& frame) {
    const std::uint64_t place = added_.load(std::memory_order_relaxed);
    if (place - taken_.load(std::memory_order_acquire) == room) {
        ++left_out_;
        return;
    }
    ring_[place % room] = frame;
    added_.store(place + 1, std::memory_order_release);
}

void LogWriter::write() {
    using namespace std::chrono_literals;
    for (;;) {
        const bool last = ends_.load(); // before looking: what was added before it is there
        const std::uint64_t end = added_.load(std::memory_order_acquire);
        for (std::uint64_t place = taken_.load(std::memory_order_relaxed); place != end; ++place) {
            CanFrame frame = ring_[place % room];
            taken_.store(place + 1, std::memory_order_release);
            frame.time_ns += offset_ns_;
            out_ << candump_line(frame) << '\n';
        }
        out_.flush();
        if (!out_ && error_ == 0)
            error_ = errno == 0 ? EIO : errno;
        if (last)
            return;
        std::this_thread::sleep_for(20ms);
    }
}

void LogWriter::finish() {
    ends_ = true;
    if (thread_.joinable())
        thread_.join();
    if (error_ != 0)
        throw DeviceError(file_.string() + ": cannot be written: " + std::generic_category().message(error_));
}

} // namespace fernlicht
