#include "runner/commands/flag_values.h"

#include "runner/commands/words/shared_flags.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/judge/baseline_store.h"
#include "runner/play/progress.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/library_folders.h"
#include "scenarios/yaml/library_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string today_of(const JudgingFlags& flags) {
    if (flags.today.empty())
        return utc_now().substr(0, 10);
    if (!is_date(flags.today))
        refuse_flag("--today", flags.today, "a date, e.g. 2026-12-31");
    if (flags.known.empty())
        refuse_flag("--today", flags.today, "--known beside it: nothing else asks for the day");
    return flags.today;
}

constexpr const char* offset_form = "hours and minutes as +02:00 or -0330";

std::int64_t utc_offset_of(const std::string& text) {
    std::string digits;
    for (const char c : text.substr(text.empty() ? 0 : 1))
        if (c != ':')
            digits += c;
    const bool shaped = !text.empty() && (text[0] == '+' || text[0] == '-') && digits.size() == 4 && (text.size() == 5 || text[3] == ':');
    if (!shaped || digits.find_first_not_of("0123456789") != std::string::npos)
        refuse_flag("--utc-offset", text, offset_form);
    const int hours = std::stoi(digits.substr(0, 2)), minutes = std::stoi(digits.substr(2));
    if (hours > 14 || minutes > 59)
        refuse_flag("--utc-offset", text, offset_form);
    return (text[0] == '-' ? -1 : 1) * (hours * 3600 + minutes * 60);
}

} // namespace

std::filesystem::path result_folder(const std::string& out, const std::string& name) {
    refuse_windows_path(out, {{}, 0, 0, "--out"});
    return out.empty() ? default_output_folder(name, utc_now()) : std::filesystem::path(out);
}

std::filesystem::path named_file(const std::string& kind, const std::filesystem::path& typed, const char* key) {
    std::error_code ignored;
    if (kind == "drive" && !typed.empty() && !typed.has_parent_path() && !std::filesystem::exists(typed, ignored))
        for (const char* ending : {"", ".xosc"})
            if (const std::filesystem::path story = shipped_path("storyboards" / std::filesystem::path(typed.string() + ending));
                !story.empty())
                return story;
    const bool is_path = typed == "-" || typed.has_parent_path() || typed.has_extension() || typed.empty() ||
                         std::filesystem::is_regular_file(typed, ignored);
    return is_path ? typed : library_file(kind, typed.string(), "", {{}, 0, 0, key});
}

std::string named_lamp(const std::string& typed) {
    constexpr std::string_view ours = "fernlicht:";
    if (typed.starts_with(ours))
        return shipped_file(typed.substr(ours.size()), "").string();
    std::error_code ignored;
    if (typed.empty() || typed == "-" || typed.find('/') != std::string::npos || std::filesystem::exists(typed, ignored))
        return typed;
    for (const char* ending : {"", ".ies", ".yaml"})
        if (const std::filesystem::path found = shipped_path("lamps/" + typed + ending); !found.empty())
            return found.string();
    return typed;
}

CLI::Option* take_shipped_lamps(CLI::Option* option) {
    return option->transform([](const std::string& value) { return named_lamp(value); }, "", "shipped lamps by name");
}

void check_target(const char* flag, const std::filesystem::path& path, bool force) {
    if (path.empty() || path == "-")
        return;
    std::error_code error;
    if (!force && std::filesystem::exists(path, error))
        throw InputError({{}, 0, 0, flag}, printable(path.string(), 400) + " is there already", "a new file, or --force");
    refuse_unwritable(flag, path, {}, force);
}

std::vector<std::pair<std::string, std::filesystem::path>> lamps_of(const std::vector<std::string>& texts) {
    std::vector<std::pair<std::string, std::filesystem::path>> lamps;
    for (const std::string& text : texts) {
        const std::size_t at = text.find('=');
        lamps.emplace_back(at == std::string::npos ? "" : text.substr(0, at),
                           named_lamp(at == std::string::npos ? text : text.substr(at + 1)));
    }
    return lamps;
}

void add_recipe_flag(CLI::App& command, std::filesystem::path& recipe) {
    add_shared_taken(command, "--recipe", [&recipe](const std::string& given) {
        recipe = recipe_file(given, std::filesystem::current_path(), {{}, 0, 0, "--recipe"});
    });
}

void add_seed_flag(CLI::App& command, std::uint64_t& seed) {
    add_shared(command, "--seed", seed)->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53))->capture_default_str();
}

void add_light_pass_flag(CLI::App& command, LightPass& pass) {
    add_shared_taken(command, "--light-pass", [&pass](const std::string& name) { pass = light_pass_named(name); });
}

void add_tables_flag(CLI::App& command, const OutputFormat*& tables) {
    std::string known;
    for (const OutputFormat& format : output_formats())
        if (format.of_table)
            known += (known.empty() ? "one of " : ", ") + std::string(format.name);
    const auto take = [&tables, known](const std::string& name) {
        const auto format =
            std::ranges::find_if(output_formats(), [&](const OutputFormat& one) { return one.of_table && one.name == name; });
        if (format == output_formats().end())
            refuse_flag("--tables", name, known.c_str());
        tables = &*format;
    };
    command.add_option_function<std::string>("--tables", take, "write each table of the page to a file in tables/, too: " + known)
        ->option_text("FORMAT");
}

void add_print_flags(CLI::App& command, const OutputFormat*& format, std::vector<CLI::Option*> others) {
    for (const OutputFormat& row : output_formats()) {
        if (!row.of_document)
            continue;
        CLI::Option* const flag = command.add_flag_callback(
            fmt::format("--{}", row.name), [&format, &row] { format = &row; }, fmt::format("print {}", row.meaning));
        for (CLI::Option* const one : others)
            flag->excludes(one);
        others.push_back(flag);
    }
}

void refuse_flag(const char* flag, const std::string& found, const char* expected) {
    throw InputError({{}, 0, 0, flag}, "found '" + printable(found) + "'", expected);
}

std::pair<int, int> two_numbers(const char* flag, const std::string& text, char separator, bool open, const char* expected) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos)
        refuse_flag(flag, text, expected);
    const auto number = [&](std::string_view part) {
        if (part.empty() && open)
            return -1;
        int value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc{} || end != part.data() + part.size() || value < 0)
            refuse_flag(flag, text, expected);
        return value;
    };
    const std::string_view all = text;
    return {number(all.substr(0, at)), number(all.substr(at + 1))};
}

std::vector<std::string> items_of(const char* flag, const std::vector<std::string>& lists) {
    std::vector<std::string> items;
    for (const std::string& list : lists)
        for (std::size_t begin = 0; begin <= list.size();) {
            const std::size_t end = std::min(list.find(',', begin), list.size());
            items.push_back(list.substr(begin, end - begin));
            if (items.back().empty())
                refuse_flag(flag, list, "something before and after each comma");
            begin = end + 1;
        }
    return items;
}

std::pair<int, int> resolution_of(const std::string& text) {
    const auto [width, height] = two_numbers("--resolution", text, 'x', false, "WIDTHxHEIGHT, e.g. 1024x768");
    if (std::min(width, height) < 1 || std::max(width, height) > largest_view_px)
        refuse_flag("--resolution", text, fmt::format("sides from 1 to {} pixels", largest_view_px).c_str());
    return {width, height};
}

double share_of(const char* flag, const std::string& text) {
    const bool percent = text.ends_with('%');
    const char *const begin = text.data(), *const end = begin + text.size() - (percent ? 1 : 0);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    value *= percent ? 0.01 : 1.0;
    if (error != std::errc{} || stop != end || !(value > 0.0 && value <= 1.0))
        refuse_flag(flag, text, "a share above 0 and up to 1, or per cent, e.g. 0.005 or 0.5%");
    return value;
}

std::vector<std::optional<BeamTexels>> beams_of(const std::vector<std::string>& texts) {
    constexpr const char* expected = "float, eight-bit or WIDTHxHEIGHTxBITS with 8, 16 or 32 bits, e.g. 512x128x8";
    std::vector<std::optional<BeamTexels>> beams;
    for (const std::string& text : items_of("--beams", texts)) {
        if (text == "float" || text == "eight-bit") {
            beams.push_back(text == "float" ? std::nullopt : std::optional(eight_bit_texels));
            continue;
        }
        const std::size_t last = std::min(text.rfind('x'), text.size() - 1);
        const std::string depth = text.substr(last + 1);
        const auto [width, height] = two_numbers("--beams", text.substr(0, last), 'x', false, expected);
        if ((depth != "8" && depth != "16" && depth != "32") || std::min(width, height) < min_beam_texels ||
            std::max(width, height) > max_beam_texels)
            refuse_flag("--beams", text, expected);
        beams.emplace_back(BeamTexels{width, height, depth == "8" ? 8 : depth == "16" ? 16 : 32});
    }
    return beams;
}

void set_dressing(DriveEdits& edits, const std::string& word) {
    if (word.empty())
        return;
    if (word != "none" && word != "plain" && word != "dressed")
        refuse_flag("--dressing", word, "none, plain or dressed");
    edits.values.emplace_back("dressing", word);
}

TickRange tick_range(const std::string& frames) {
    TickRange range;
    if (frames.empty())
        return range;
    constexpr const char* expected = "FIRST:LAST with FIRST 0 or more and FIRST <= LAST, e.g. 0:59, or one number";
    const std::string text = frames.find(':') == std::string::npos ? frames + ':' + frames : frames; // "20" is one
    const auto [first, last] = two_numbers("--frames", text, ':', true, expected);
    range.first = first < 0 ? 0 : first;
    range.last = last < 0 ? range.last : last;
    if (range.first > range.last)
        refuse_flag("--frames", frames, expected);
    return range;
}

void add_judging_flags(CLI::App& command, JudgingFlags& flags) {
    add_shared(command, "--baselines", flags.baselines)->default_str("none: nothing is compared");
    command.add_flag("--across-devices", flags.across_devices, "where this device class has no baseline, judge by those of other classes");
    command.add_option("--repeat", flags.repeats, "times to play each lamp set; results that differ in any byte are flaky, which is red")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command.add_option("--known", flags.known, "list of known failures and flakes (YAML), each with reason and expiry")
        ->option_text("FILE");
    command.add_option("--today", flags.today, "day by which known failures expire, 2026-12-31")
        ->option_text("DATE")
        ->default_str("today, UTC");
}

std::optional<KnownFailures> take(const JudgingFlags& flags, RunOptions& options) {
    if (flags.across_devices && flags.baselines.empty())
        throw InputError({{}, 0, 0, "--across-devices"}, "found no --baselines", "the folder of baselines");
    if (!flags.baselines.empty())
        refuse_missing_store(flags.baselines);
    options.baselines = flags.baselines;
    options.across_devices = flags.across_devices;
    options.repeats = flags.repeats;
    options.today = today_of(flags);
    return flags.known.empty() ? std::nullopt : std::optional(read_known_failures(flags.known));
}

void add_log_flags(CLI::App& command, LogFlags& flags) {
    command.add_option("--stamps", flags.stamps, "what timestamps count from, as with candump's -ta, -tz and -td")
        ->option_text("absolute|zero|delta")
        ->default_str("detected where possible");
    command.add_option("--start", flags.start, "time of the first frame in seconds, where timestamps are zero or delta")
        ->option_text("S")
        ->default_str("0");
    command.add_option("--utc-offset", flags.utc_offset, "UTC offset of dates in timestamps (-tA), such as +02:00")
        ->option_text("+HH:MM")
        ->default_str("UTC");
    add_shared(command, "--lenient", flags.lenient);
}

std::int64_t nanoseconds_of(const char* flag, const std::string& text, bool negative) {
    const char* expected =
        negative ? "seconds, at most nine digits behind the point" : "seconds from 0 up, at most nine digits behind the point";
    const bool minus = negative && text.starts_with('-');
    const std::string digits = text.substr(minus || (negative && text.starts_with('+')) ? 1 : 0);
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const std::string whole = digits.substr(0, point), fraction = point < digits.size() ? digits.substr(point + 1) : "0";
    const auto is_number = [](const std::string& number, std::size_t most) {
        return !number.empty() && number.size() <= most && number.find_first_not_of("0123456789") == std::string::npos;
    };
    if (!is_number(whole, 10) || !is_number(fraction, 9) || std::stoll(whole) > 9223372035)
        refuse_flag(flag, text, expected);
    const std::int64_t value = std::stoll(whole) * 1'000'000'000 + std::stoll(fraction + std::string(9 - fraction.size(), '0'));
    return minus ? -value : value;
}

CandumpReading reading_of(const LogFlags& flags) {
    CandumpReading reading;
    if (flags.stamps == "absolute")
        reading.stamps = CandumpStamps::absolute;
    else if (flags.stamps == "zero")
        reading.stamps = CandumpStamps::zero;
    else if (flags.stamps == "delta")
        reading.stamps = CandumpStamps::delta;
    else if (!flags.stamps.empty())
        refuse_flag("--stamps", flags.stamps, "absolute, zero or delta");
    if (!flags.start.empty())
        reading.first_ns = nanoseconds_of("--start", flags.start);
    if (!flags.utc_offset.empty())
        reading.utc_offset_s = utc_offset_of(flags.utc_offset);
    reading.stopped = Interruption::requested;
    return reading;
}

LenientStream::LenientStream(const std::filesystem::path& path, const LogFlags& flags)
    : log_(path, reading_of(flags)), lenient_(flags.lenient) {}

CandumpStream::What LenientStream::next() {
    for (;;) {
        try {
            const CandumpStream::What what = log_.next();
            if (what == CandumpStream::What::end && skipped_ > 1)
                tell(LogLevel::warning,
                     fmt::format("{}: {} lines skipped that are no frames", printable(log_.path().string(), 400), skipped_));
            return what;
        } catch (const InputError& error) {
            if (!lenient_ || error.where().line == 0)
                throw;
            if (skipped_++ == 0)
                tell(LogLevel::warning, fmt::format("skipped: {}", error.what()));
        }
    }
}

} // namespace fernlicht
