#include "runner/commands/can/can_command.h"

#include "runner/commands/can/line_output.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/play/progress.h"
#include "scenarios/can/can_frame.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

struct ConvertFlags {
    std::string file, out, stamps;
    LogFlags log;
    bool screen = false, nanoseconds = false, sort = false, force = false;
    bool ascii = false, binary = false, swapped = false, directions = false, dlc = false, explained = false;
    int colour = 0;
};

/// Lines as candump would have printed them, seeing these frames.
class CandumpWriter {
  public:
    CandumpWriter(const ConvertFlags& flags, std::int64_t utc_offset_s)
        : flags_(flags), stamps_(flags.stamps.empty() ? 'a' : flags.stamps.front()), utc_offset_ns_(utc_offset_s * 1'000'000'000) {}

    void append(std::string& out, const CandumpLine& line) {
        CandumpStyle style;
        CanFrame frame = line.frame;
        style.stamp_digits = stamps_ == 'n' ? 0 : flags_.nanoseconds || (line.style.stamp_digits == 9 && !flags_.screen) ? 9 : 6;
        stamp(frame, style);
        if (flags_.stamps.empty() && line.style.form == CandumpStyle::Form::log)
            style.second_digits = line.style.second_digits;
        columns_ = std::max(columns_, frame.channel.size());
        style.channel_columns = static_cast<std::uint8_t>(columns_);
        style.sent = line.style.sent;
        if (flags_.directions && !style.sent)
            style.sent = false;
        style.more_fd_flags = line.style.more_fd_flags;
        if (flags_.screen) {
            style.form = CandumpStyle::Form::screen;
            if (!flags_.directions)
                style.sent = std::nullopt;
            indented_ |= frame.extended;
            style.indented = indented_;
            style.ascii = flags_.ascii;
            style.binary = flags_.binary;
            style.swapped = flags_.swapped;
            style.shows_dlc = flags_.dlc;
            style.colour_mode = static_cast<std::uint8_t>(std::min(flags_.colour, 3));
            style.colour = static_cast<std::uint8_t>(colours_.try_emplace(frame.channel, colours_.size()).first->second % 6);
            style.colour_stays_on = style.colour_mode > 1 && flags_.explained && frame.error;
        }
        append_candump_line(out, frame, style);
        if (flags_.explained && frame.error) {
            const std::vector<std::string> words = error_words(frame);
            if (words.empty())
                out += "\n\t";
            for (const std::string& one : words) {
                out += "\n\t";
                out += one;
            }
            if (style.colour_stays_on)
                out += "\33[0m";
        }
        out += '\n';
    }

  private:
    void stamp(CanFrame& frame, CandumpStyle& style) {
        if (stamps_ == 'A') {
            style.date = true;
            frame.time_ns = std::max<std::int64_t>(frame.time_ns + utc_offset_ns_, 0);
        } else if (stamps_ == 'd' || stamps_ == 'z') {
            style.second_digits = 3;
            const std::int64_t now_ns = frame.time_ns;
            frame.time_ns = std::max<std::int64_t>(now_ns - before_ns_.value_or(now_ns), 0);
            if (stamps_ == 'd' || !before_ns_)
                before_ns_ = now_ns;
        }
    }

    const ConvertFlags& flags_;
    char stamps_;
    std::int64_t utc_offset_ns_;
    std::optional<std::int64_t> before_ns_; ///< the first frame's, or of deltas that of the last
    std::size_t columns_ = 0;
    bool indented_ = false;
    std::map<std::string, std::size_t> colours_; ///< by order of appearance
};

void check_convert_flags(const ConvertFlags& flags) {
    if (!flags.stamps.empty() && (flags.stamps.size() != 1 || flags.stamps.find_first_of("aAdzn") == std::string::npos))
        refuse_flag("-t", flags.stamps, "a, A, d, z, or n for none");
    if (!flags.screen && !flags.stamps.empty() && flags.stamps != "a" && flags.stamps != "z")
        refuse_flag("-t", flags.stamps, "a or z in the log form; --screen has the others");
    if (flags.screen)
        return;
    std::vector<std::string> looks;
    for (const auto& [name, given] : {std::pair("-a", flags.ascii), std::pair("-i", flags.binary), std::pair("-S", flags.swapped),
                                      std::pair("-8", flags.dlc), std::pair("-e", flags.explained), std::pair("-c", flags.colour > 0)})
        if (given)
            looks.emplace_back(name);
    if (!looks.empty())
        throw InputError({}, fmt::format("found {} without --screen", fmt::join(looks, ", ")), "both: the log form has one look");
}

int convert_log(const ConvertFlags& flags) {
    check_convert_flags(flags);
    LenientStream stream(flags.file, flags.log);
    const CandumpStream& log = stream.log();
    std::optional<Interruption> interruption; // ends a pipe as its end would
    if (log.from_pipe())
        interruption.emplace();
    LineOutput out(flags.out, flags.force);
    CandumpWriter writer(flags, reading_of(flags.log).utc_offset_s);
    std::vector<CandumpLine> sorted;
    for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;) {
        if (what == CandumpStream::What::lost) {
            out.text() += log.text();
            out.text() += '\n';
        } else if (what == CandumpStream::What::frame) {
            if (log.line().style.stamp_digits == 0 && flags.stamps != "n")
                throw InputError({log.path(), log.line_number(), 0, {}}, "found a frame without a stamp",
                                 "stamps, or --screen -t n, which writes none");
            if (flags.sort)
                sorted.push_back(log.line());
            else
                writer.append(out.text(), log.line());
        }
        if (log.may_wait() ? !out.flush() : !out.written())
            return 0;
    }
    std::ranges::stable_sort(sorted, {}, [](const CandumpLine& line) { return line.frame.time_ns; });
    for (const CandumpLine& line : sorted) {
        writer.append(out.text(), line);
        if (!out.written())
            return 0;
    }
    out.finish();
    return 0;
}

} // namespace

void add_can_convert(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ConvertFlags>();
    CLI::App* sub = can.add_subcommand("convert", "convert a candump log to another of its forms, with candump's options");
    add_shared(*sub, "LOG", flags->file)->required();
    sub->add_flag("--screen", flags->screen, "candump's screen form instead of its log form (-L)");
    sub->add_option("-t", flags->stamps, "timestamps to write: a(bsolute), A (with date), d(elta), z(ero), n(one)")
        ->option_text("a|A|d|z|n");
    sub->add_flag("-N", flags->nanoseconds, "write nanoseconds in timestamps");
    sub->add_flag("-a", flags->ascii, "add the data as text");
    sub->add_flag("-i", flags->binary, "bits instead of hexadecimal digits");
    sub->add_flag("-S", flags->swapped, "last byte first");
    sub->add_flag("-8", flags->dlc, "raw data length codes");
    sub->add_flag("-e", flags->explained, "error frames in words");
    sub->add_flag("-x", flags->directions, "sent or received, and CAN FD flags; frames without a direction count as received");
    sub->add_flag("-c", flags->colour, "colours, up to three times");
    sub->add_flag("--sort", flags->sort, "sort by timestamp, equal ones in file order; reads the whole log into memory");
    add_shared(*sub, "-o,--out", flags->out);
    add_shared(*sub, "--force", flags->force);
    add_log_flags(*sub, flags->log);
    sub->callback([flags, &chosen] { chosen = [flags] { return convert_log(*flags); }; });
}

} // namespace fernlicht
