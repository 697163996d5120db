// Frames into a video, by the program ffmpeg, or into numbered PNGs, without it.
#pragma once

#include "scenarios/drives/play/frame.h"

#include <cstdio>
#include <filesystem>
#include <optional>

namespace fernlicht {

/// Frames a second, as a fraction: 25, 30000/1001.
struct FrameRate {
    int frames = 25, seconds = 1;
    double frame_s() const { return static_cast<double>(seconds) / frames; }
    double time_s(int number) const { return number * frame_s(); } ///< of a frame
};

enum class FilmKind {
    webm, ///< VP9
    mp4,  ///< H.264
    png   ///< a picture for each frame: the file's name has %06d
};

/// By the name's end. Throws InputError naming --film for other ends, and for PNGs without %06d.
FilmKind film_kind(const std::filesystem::path& file);
/// "frames/000012.png" for "frames/%06d.png"
std::filesystem::path numbered_file(const std::filesystem::path& pattern, int number);

/// The first of these pictures that is there already; nullopt: none is.
std::optional<std::filesystem::path> numbered_file_there(const std::filesystem::path& pattern, int first, int last);

/// A film while it is written. ffmpeg is a program beside ours, not a library in it: who films nothing neither installs it nor waits for
/// it. A video gets its name in finish(): before, and after an error, there is none. Of one rate and size the same frames give the same
/// bytes.
class FilmFile {
  public:
    /// Starts ffmpeg for a video, whose width and height are even. Throws DeviceError where it is not installed.
    FilmFile(std::filesystem::path file, int width_px, int height_px, FrameRate rate);
    ~FilmFile();
    FilmFile(const FilmFile&) = delete;
    FilmFile& operator=(const FilmFile&) = delete;

    /// Numbers name PNGs; in a video frames follow one another from 0 s on. Throws DeviceError with ffmpeg's own words; after that nothing
    /// is written any more.
    void add(const Image<Rgb8>& picture, int number);
    /// Throws DeviceError.
    void finish();

  private:
    void start(int width_px, int height_px, FrameRate rate);
    int wait();
    [[noreturn]] void fail(int status);

    std::filesystem::path file_, part_;
    FilmKind kind_;
    int frames_ = -1;           ///< the end of a socket that ffmpeg reads
    int ffmpeg_ = -1;           ///< its process; -1: none runs
    std::FILE* said_ = nullptr; ///< what it says on standard error
};

} // namespace fernlicht
