// A pixel lamp over time: what its pixels were told to give, and what they give.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/errors.h"

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace fernlicht {

class LevelTrack {
  public:
    /// `lamp` has pixels; all of them are full until they are asked for anything.
    explicit LevelTrack(std::shared_ptr<const LampFile> lamp);
    LevelTrack(const LevelTrack&) = delete;
    LevelTrack& operator=(const LevelTrack&) = delete;

    /// From `time_s` on, not before the last call's; within 0..1, one each. The first ones hold from the beginning, as if for ever.
    /// They are rounded to the lamp's steps; after its latency levels move there as fast as it can. Throws InputError at `where` for more
    /// changes than can be kept.
    void ask(double time_s, std::span<const float> levels, const InputError::Where& where = {});

    const std::shared_ptr<const LampFile>& lamp() const { return lamp_; } ///< as it was given
    std::vector<float> levels(double time_s) const;
    /// With its light then, of the same axes as the lamp's own table. Where nothing changes it is the same file; the last few are kept.
    std::shared_ptr<const LampFile> at(double time_s) const;
    /// The files that its levels were read from: inputs of what is computed with it.
    void came_from(FilesRead files) { opened_ = std::move(files); }
    const FilesRead& opened() const { return opened_; }   ///< empty: levels from no file
    std::size_t changes() const { return asked_.size(); } ///< at how many times something was asked for

  private:
    struct Change {
        std::uint32_t pixel;
        float level;
    };
    struct Asked {
        double arrives_s;
        std::vector<Change> changes;
    };
    /// Pixels on their way, as far as they were asked until a time.
    struct Course {
        std::size_t done = 0; ///< of asked_
        std::vector<float> from, to;
        std::vector<double> since_s;
    };
    Course at_the_beginning() const;
    float level(std::size_t pixel, double time_s) const; ///< in course_
    std::vector<float> locked_levels(double time_s) const;

    std::shared_ptr<const LampFile> lamp_, full_; ///< the second is this lamp's alone
    FilesRead opened_;
    std::vector<Asked> asked_;
    std::vector<float> last_; ///< asked for
    std::size_t kept_changes_ = 0;

    struct Shown {
        std::size_t done;
        double time_s; ///< of a state between two that were asked for, else NaN
        std::shared_ptr<const LampFile> file;
    };
    mutable std::mutex mutex_;
    mutable Course course_;
    mutable std::vector<Shown> shown_;
};

/// Levels over time from a file, for a lamp of its number of pixels: CSV, a line for each time, `time_s` and then either `level` for each
/// pixel or `picture`, the name of a picture (EXR, PNG) of one pixel each, from the file's folder. Separators comma, semicolon, tab or
/// blanks; lines that begin with # and one line of names are skipped. Times ascend, levels are 0 to 1; each holds until the next. Throws
/// InputError with file and line.
std::shared_ptr<const LevelTrack> read_levels(const std::filesystem::path& path, const std::shared_ptr<const LampFile>& lamp,
                                              FilesRead& opened);

/// A pixel lamp as a run's levels-*.csv tells of it (findings/pixel_levels.h): as it shone, its delays done with.
struct ShownLevels {
    double level = 1.0; ///< of the lamp as a whole
    std::vector<float> pixels;
};
/// By the last moment that is not after `time_s`. `name`: of the lamp on its car; "": the only one. nullopt: the file is none of these.
/// Throws InputError with file and line.
std::optional<ShownLevels> read_shown_levels(const std::filesystem::path& path, const PixelLamp& lamp, const std::string& name,
                                             double time_s, FilesRead& opened);

} // namespace fernlicht
