// Frames into a file as `candump -L` writes them, by a thread of its own: whoever hands them over never waits for a disk.
#pragma once

#include "scenarios/can/can_frame.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

namespace fernlicht {

class LogWriter {
  public:
    /// Creates the file. Stamps are written `offset_ns` later than the frames have them. Throws DeviceError.
    LogWriter(std::filesystem::path file, std::int64_t offset_ns);
    ~LogWriter();
    LogWriter(const LogWriter&) = delete;
    LogWriter& operator=(const LogWriter&) = delete;

    /// By one thread alone. Neither allocates nor waits; with no room left the frame is not written and counted.
    void add(const CanFrame& frame);
    /// Until all is written. Throws DeviceError when it could not be.
    void finish();

    std::uint64_t written() const { return taken_.load(); }
    std::uint64_t left_out() const { return left_out_; }

  private:
    void write();

    static constexpr std::size_t room = std::size_t{1} << 16; ///< frames: half a second of the fullest bus
    std::filesystem::path file_;
    std::int64_t offset_ns_;
    std::ofstream out_;
    std::vector<CanFrame> ring_;
    std::atomic<std::uint64_t> added_{0}, taken_{0};
    std::uint64_t left_out_ = 0;
    std::atomic<bool> ends_{false};
    int error_ = 0;
    std::thread thread_;
};

} // namespace fernlicht
