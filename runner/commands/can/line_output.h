// Lines of a tool on their way to standard output or a file.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// Collects lines and writes them in large pieces; who reads live asks it to flush before he waits. A file that is replaced stays as it is
/// until all is written: the new one grows beside it and takes its name at finish(), so that it may be what is read, too. A new file,
/// a pipe and a device are written at once; where a tool fails, the lines before that come out, and a new file without any goes.
class LineOutput {
  public:
    /// "" and "-" are standard output. Throws InputError where a file of this name is there and `force` does not say to replace it, and
    /// where none can be made; DeviceError where the disk refuses.
    explicit LineOutput(const std::filesystem::path& file, bool force = false);
    ~LineOutput();
    LineOutput(const LineOutput&) = delete;
    LineOutput& operator=(const LineOutput&) = delete;

    std::string& text() { return text_; } ///< append here
    /// After each line: writes when enough has gathered. False: nobody reads any more, and all that follows is in vain.
    bool written() { return text_.size() < enough || flush(); }
    bool flush(); ///< as written(). Throws DeviceError: disk full ...
    /// At the end of what went well: the file has its name now. Throws DeviceError.
    void finish();

  private:
    static constexpr std::size_t enough = std::size_t{1} << 16;
    void open(bool force);
    [[noreturn]] void fail(int error) const;
    [[noreturn]] void refuse(int error) const; ///< a name under which nothing can be written

    std::filesystem::path path_, part_, target_; ///< as asked for; "" or what is written in place of `target_`
    int file_;
    bool is_new_ = false, has_bytes_ = false, finished_ = false;
    std::string text_;
};

} // namespace fernlicht
