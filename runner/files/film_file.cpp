#include "runner/files/film_file.h"

#include "runner/files/child_process.h"
#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <fmt/format.h>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

constexpr const char* number_form = "%06d";

/// No thread counts by cores, no date and no version: what is encoded depends on the frames alone. Colours are sRGB's, in BT.709's matrix
/// and limited range, as browsers expect them.
std::vector<std::string> encoder_words(FilmKind kind, int width_px, int height_px, FrameRate rate, const std::filesystem::path& to) {
    std::vector<std::string> words{"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-y"};
    const auto add = [&words](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-s", fmt::format("{}x{}", width_px, height_px)});
    add({"-framerate", fmt::format("{}/{}", rate.frames, rate.seconds), "-i", "pipe:0"});
    add({"-vf", "scale=in_range=full:out_range=limited:out_color_matrix=bt709:flags=bicubic+accurate_rnd+full_chroma_int,format=yuv420p"});
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
    if (kind == FilmKind::webm)
        add({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good", "-cpu-used", "3", "-tile-columns", "2", "-row-mt", "0"});
    else
        add({"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart"});
    add({"-threads", "4", "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
    add({"-f", kind == FilmKind::webm ? "webm" : "mp4", "file:" + to.string()});
    return words;
}

} // namespace

FilmKind film_kind(const std::filesystem::path& file) {
    const std::string extension = file.extension().string(), name = file.filename().string();
    if (extension == ".webm")
        return FilmKind::webm;
    if (extension == ".mp4")
        return FilmKind::mp4;
    if (extension == ".png" && name.find(number_form) != std::string::npos)
        return FilmKind::png;
    throw InputError({{}, 0, 0, "--film"}, "found '" + printable(file.string()) + "'",
                     "a file.webm or file.mp4, or pictures by number: frame-%06d.png");
}

std::filesystem::path numbered_file(const std::filesystem::path& pattern, int number) {
    std::string name = pattern.filename().string();
    name.replace(name.find(number_form), std::string(number_form).size(), fmt::format("{:06}", number));
    return pattern.parent_path() / name;
}

std::optional<std::filesystem::path> numbered_file_there(const std::filesystem::path& pattern, int first, int last) {
    const std::size_t at = pattern.filename().string().find(number_form);
    const std::filesystem::path folder = pattern.parent_path().empty() ? "." : pattern.parent_path();
    int least = -1;
    std::error_code error;
    for (std::filesystem::directory_iterator there(folder, error), end; !error && there != end; there.increment(error)) {
        const std::string name = there->path().filename().string();
        int number = -1;
        if (name.size() > at)
            std::from_chars(name.data() + at, name.data() + name.size(), number);
        if (number >= first && number <= last && (least < 0 || number < least) && numbered_file(pattern, number).filename() == name)
            least = number;
    }
    return least >= 0 ? std::optional(numbered_file(pattern, least)) : std::nullopt;
}

FilmFile::FilmFile(std::filesystem::path file, int width_px, int height_px, FrameRate rate)
    : file_(std::move(file)), kind_(film_kind(file_)) {
    if (kind_ == FilmKind::png)
        return;
    part_ = std::filesystem::absolute(file_);
    part_ += ".part";
    start(width_px, height_px, rate);
}

/// A socket for a pipe, since a reader that is gone then is an error and no signal. Ctrl-C ends this program, which ends the film in order.
void FilmFile::start(int width_px, int height_px, FrameRate rate) {
    int ends[2] = {-1, -1};
    said_ = std::tmpfile();
    if (!said_ || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw DeviceError(fmt::format("ffmpeg cannot be started: {}", std::generic_category().message(errno)));
    frames_ = ends[0];
    try {
        ffmpeg_ = start_program(encoder_words(kind_, width_px, height_px, rate, part_), {ends[1], ::fileno(said_), ::fileno(said_)});
        ::close(ends[1]);
    } catch (const DeviceError& error) { // there is no destructor yet
        ::close(ends[1]);
        ::close(frames_);
        std::fclose(said_);
        throw DeviceError(fmt::format("{}: {}; install Debian's package ffmpeg, or film to pictures, --film frame-%06d.png",
                                      printable(file_.string(), 400), error.what()));
    }
}

FilmFile::~FilmFile() {
    wait();
    if (!part_.empty()) {
        std::error_code ignored;
        std::filesystem::remove(part_, ignored);
    }
    if (said_)
        std::fclose(said_);
}

/// Tells it that there are no more frames; gives the status that it ended with, 0 where none runs.
int FilmFile::wait() {
    if (ffmpeg_ < 0)
        return 0;
    ::close(std::exchange(frames_, -1));
    return end_of_program(std::exchange(ffmpeg_, -1));
}

void FilmFile::fail(int status) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    std::array<char, 4096> text{};
    std::rewind(said_);
    std::string words(text.data(), std::fread(text.data(), 1, text.size(), said_));
    while (words.ends_with('\n'))
        words.pop_back();
    words = words.substr(words.rfind('\n') + 1);
    if (words.empty())
        words = WIFSIGNALED(status) ? fmt::format("it was ended by signal {}", WTERMSIG(status))
                                    : fmt::format("it ended with {}", WEXITSTATUS(status));
    throw DeviceError(fmt::format("{}: ffmpeg cannot encode it: {}", printable(file_.string(), 400), printable(words, 400)));
}

void FilmFile::add(const Image<Rgb8>& picture, int number) {
    if (kind_ == FilmKind::png) {
        write_png(picture, numbered_file(file_, number));
        return;
    }
    if (ffmpeg_ < 0)
        return; // it failed before, and that was thrown
    const char* bytes = reinterpret_cast<const char*>(picture.data());
    std::size_t left = picture.size() * sizeof(Rgb8);
    while (left > 0) {
        const ::ssize_t sent = ::send(frames_, bytes, left, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0)
            fail(wait());
        bytes += sent;
        left -= static_cast<std::size_t>(sent);
    }
}

void FilmFile::finish() {
    if (ffmpeg_ < 0)
        return; // pictures; or it failed before, and that was thrown
    const int status = wait();
    if (status != 0)
        fail(status);
    std::error_code error;
    std::filesystem::rename(part_, file_, error);
    if (error)
        throw DeviceError(fmt::format("{}: cannot be written: {}", printable(file_.string(), 400), error.message()));
    part_.clear();
}

} // namespace fernlicht
