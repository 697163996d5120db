// Lines of a tool on their way to standard output or a file.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// Collects lines and writes them in large pieces; who reads live asks it to flush before he waits.
class LineOutput {
  public:
    /// "" is standard output. Throws InputError where a file of this name is there and `force` does not say to replace it,
    /// DeviceError where it cannot be written.
    explicit LineOutput(const std::filesystem::path& file, bool force = false);
    ~LineOutput();
    LineOutput(const LineOutput&) = delete;
    LineOutput& operator=(const LineOutput&) = delete;

    std::string& text() { return text_; } ///< append here
    /// After each line: writes when enough has gathered. False: nobody reads any more, and all that follows is in vain.
    bool written() { return text_.size() < enough || flush(); }
    bool flush(); ///< as written(). Throws DeviceError: disk full ...

  private:
    static constexpr std::size_t enough = std::size_t{1} << 16;
    std::filesystem::path path_;
    int file_;
    std::string text_;
};

} // namespace fernlicht
