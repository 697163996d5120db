// Values of command-line flags that are more than a word, and flags that several commands share.
#pragma once

#include "runner/experiments/run/run_drives.h"
#include "runner/write/formats.h"
#include "scenarios/can/candump_stream.h"
#include "scenarios/lamps/beam_texels.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace fernlicht {

/// Throws InputError naming the flag.
[[noreturn]] void refuse_flag(const char* flag, const std::string& found, const char* expected);

/// Two whole numbers from 0 up with a separator: "1024x768", "0:59". Either may be missing where `open` says so (-1).
/// Throws InputError naming the flag.
std::pair<int, int> two_numbers(const char* flag, const std::string& text, char separator, bool open, const char* expected);

/// What --aim may be, for refusals.
inline constexpr const char* aim_expected = "as-is or auto; an angle stands in the drive or study, as aim: {pitch_deg: -0.3}";

/// A lamp's file as typed: a path as it is; `fernlicht:lamps/led-low.ies` and a bare `led-low` or `led-low.ies` without a file of this name
/// are shipped ones. Throws InputError for what follows `fernlicht:` and is none.
std::string named_lamp(const std::string& typed);
/// The same of a flag's or argument's value.
CLI::Option* take_shipped_lamps(CLI::Option* option);

/// The items of "a,b" and of a flag given several times, in order. Throws InputError naming the flag for an item that is empty.
std::vector<std::string> items_of(const char* flag, const std::vector<std::string>& lists);

/// "1024x768", sides from 1 to largest_view_px. Throws InputError naming --resolution.
std::pair<int, int> resolution_of(const std::string& text);

/// A share above 0 and up to 1: "0.5%" and "0.005" are the same. Throws InputError naming the flag.
double share_of(const char* flag, const std::string& text);

/// "float" (nullopt), "eight-bit" or "512x128x8". Throws InputError naming --beams.
std::vector<std::optional<BeamTexels>> beams_of(const std::vector<std::string>& texts);

/// The folder of --out; for "" a new one, named after what is played and the time.
std::filesystem::path result_folder(const std::string& out, const std::string& name);

/// A drive or study as typed: a path as it is; a bare word without a file of this name is one of ours ("country"). Throws InputError naming
/// the positional `key` for a word that is neither.
std::filesystem::path named_file(const std::string& kind, const std::filesystem::path& typed, const char* key);

/// Of a file that a command will write: throws InputError naming the flag where there is one of this name and `force` does not say to
/// replace it, and where none can be written. "" and "-" are none.
void check_target(const char* flag, const std::filesystem::path& path, bool force);

/// What --lamp says, "[SIDE=]FILE" each: lamps by a part of their names ("": all), and files.
std::vector<std::pair<std::string, std::filesystem::path>> lamps_of(const std::vector<std::string>& texts);
/// `--recipe NAME|FILE`, the recipe of lamp files that are text grids.
void add_recipe_flag(CLI::App& command, std::filesystem::path& recipe);

void add_seed_flag(CLI::App& command, std::uint64_t& seed);
/// --light-pass auto, shader or cpu.
void add_light_pass_flag(CLI::App& command, LightPass& pass);
/// --tables, the same for all commands that write a document: any format that has tables. What is none is refused while flags are parsed.
void add_tables_flag(CLI::App& command, const OutputFormat*& tables);
/// A flag for each format of whole documents (--markdown), for commands that print one; at most one of
/// them and of `others` may be given.
void add_print_flags(CLI::App& command, const OutputFormat*& format, std::vector<CLI::Option*> others = {});

/// The word of --dressing; none for "". Throws InputError naming the flag.
void set_dressing(DriveEdits& edits, const std::string& word);

/// "FIRST:LAST", "FIRST:", ":LAST" or one number of --frames; all for "". Throws InputError naming the flag.
TickRange tick_range(const std::string& frames);

/// By what results of `run` and `study` are judged, as typed.
struct JudgingFlags {
    std::string baselines, known, today;
    int repeats = 1;
    bool across_devices = false;
};

void add_judging_flags(CLI::App& command, JudgingFlags& flags);

/// Sets baselines, across_devices, repeats and today of `options`, and reads the list of known failures, where there is one. The only
/// place that asks the clock for the day. Throws InputError for flags without effect, what is no date, and a list that cannot be read.
std::optional<KnownFailures> take(const JudgingFlags& flags, RunOptions& options);

/// With which the tools of `fernlicht can` read logs of candump.
struct LogFlags {
    std::string stamps, start, utc_offset; ///< "": by itself, 0, UTC
    bool lenient = false;                  ///< lines that are no frames are skipped and told
};

/// --stamps, --start, --utc-offset, --lenient
void add_log_flags(CLI::App& command, LogFlags& flags);

/// Throws InputError naming the flag.
CandumpReading reading_of(const LogFlags& flags);

/// Seconds with up to nine digits behind the point, exactly; a sign where `negative` is allowed. Throws InputError naming the flag.
std::int64_t nanoseconds_of(const char* flag, const std::string& text, bool negative = false);

/// A stream that steps over bad lines where the flags say so: the first is told on standard error, the others are counted.
class LenientStream {
  public:
    LenientStream(const std::filesystem::path& path, const LogFlags& flags);
    /// As CandumpStream::next.
    CandumpStream::What next();
    const CandumpStream& log() const { return log_; }

  private:
    CandumpStream log_;
    bool lenient_;
    std::uint64_t skipped_ = 0;
};

} // namespace fernlicht
