#include "runner/commands/can/can_command.h"

#include "runner/commands/can/line_output.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/log.h"
#include "runner/play/progress.h"
#include "scenarios/can/can_frame.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <vector>

namespace fernlicht {
namespace {

struct CutFlags {
    std::string file, from, to, out;
    std::vector<std::string> ids, filters, channels;
    LogFlags log;
    bool inverted = false, force = false;
};

struct CutId {
    std::uint32_t id = 0;
    bool extended = false;
};

/// "123" or, extended, "18FEF100".
std::vector<CutId> ids_to_keep(const std::vector<std::string>& lists) {
    std::vector<CutId> ids;
    for (const std::string& text : items_of("--id", lists)) {
        const bool hexadecimal = text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
        const CutId one{hexadecimal && text.size() <= 8 ? static_cast<std::uint32_t>(std::stoul(text, nullptr, 16)) : 0, text.size() == 8};
        if (!hexadecimal || (text.size() != 8 && text.size() > 3) || one.id > (one.extended ? 0x1fffffffU : 0x7ffU))
            refuse_flag("--id", text, "an identifier up to 7FF, or of 8 hexadecimal digits up to 1FFFFFFF");
        ids.push_back(one);
    }
    return ids;
}

/// Which frames of a log stay.
class Cut {
  public:
    explicit Cut(const CutFlags& flags) : ids_(ids_to_keep(flags.ids)) {
        for (const std::string& text : flags.filters)
            filters_.push_back(parse_can_filters(text, "--filter"));
        for (const std::string& text : flags.channels)
            channels_.push_back(parse_channel_filter(text, "--channel"));
        from_ = bound("--from", flags.from, from_relative_);
        to_ = bound("--to", flags.to, to_relative_);
        if (from_ && to_ && from_relative_ == to_relative_ && *to_ < *from_)
            refuse_flag("--to", flags.to, "a time not before --from");
        seen_.resize(channels_.size());
    }

    /// Of each frame, kept or not.
    void see_channel(const std::string& channel) {
        if (channel == seen_last_)
            return;
        seen_last_ = channel;
        for (std::size_t i = 0; i < channels_.size(); ++i)
            seen_[i] = seen_[i] || channels_[i].channel == "any" || channels_[i].channel == channel;
    }

    void tell_absent(const CandumpStream& log) const {
        for (std::size_t i = 0; i < channels_.size(); ++i)
            if (!seen_[i])
                tell(LogLevel::warning,
                     fmt::format("{}: no frame of channel {}", printable(log.path().string(), 400), printable(channels_[i].channel)));
    }

    bool keeps(const CanFrame& frame) {
        if (!started_)
            first_ns_ = frame.time_ns;
        started_ = true;
        if (from_ && frame.time_ns - (from_relative_ ? first_ns_ : 0) < *from_)
            return false;
        if (to_ && frame.time_ns - (to_relative_ ? first_ns_ : 0) > *to_)
            return false;
        const auto passes = [&](const auto& one) { return one.passes(frame); };
        if (!filters_.empty() && !std::ranges::any_of(filters_, passes))
            return false;
        if (!channels_.empty() && !std::ranges::any_of(channels_, passes))
            return false;
        return ids_.empty() || (!frame.error && std::ranges::any_of(ids_, [&](const CutId& one) {
                   return one.id == frame.id && one.extended == frame.extended;
               }));
    }

    bool asks_for_times() const { return from_ || to_; }

    bool keeps_channel(const std::string& channel) const {
        return channels_.empty() ||
               std::ranges::any_of(channels_, [&](const ChannelFilter& one) { return one.channel == "any" || one.channel == channel; });
    }

  private:
    /// "12.5" as the stamps count, "+12.5" since the first frame.
    static std::optional<std::int64_t> bound(const char* flag, const std::string& text, bool& relative) {
        relative = text.starts_with('+');
        if (text.empty())
            return std::nullopt;
        return nanoseconds_of(flag, text.substr(relative ? 1 : 0));
    }

    std::vector<CutId> ids_;
    std::vector<CanFilters> filters_;
    std::vector<ChannelFilter> channels_;
    std::vector<bool> seen_; ///< by channels_
    std::string seen_last_;
    std::optional<std::int64_t> from_, to_;
    std::int64_t first_ns_ = 0;
    bool started_ = false, from_relative_ = false, to_relative_ = false;
};

int cut_log(const CutFlags& flags) {
    Cut cut(flags);
    LenientStream stream(flags.file, flags.log);
    const CandumpStream& log = stream.log();
    LineOutput out(flags.out, flags.force);
    std::optional<Interruption> interruption; // ends a pipe as its end would
    if (log.from_pipe())
        interruption.emplace();
    bool kept = false;                        // the frame before
    std::optional<std::int64_t> last_kept_ns; // of a log with delta stamps
    for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;) {
        bool keep = kept; // an explanation goes with its frame
        if (what == CandumpStream::What::frame && cut.asks_for_times() && log.line().style.stamp_digits == 0)
            throw InputError({log.path(), log.line_number(), 0, {}}, "found a frame without a stamp", "stamps to cut by --from and --to");
        if (what == CandumpStream::What::frame)
            keep = kept = cut.keeps(log.line().frame) != flags.inverted;
        if (what == CandumpStream::What::frame)
            cut.see_channel(log.line().frame.channel);
        else if (what == CandumpStream::What::lost)
            keep = cut.keeps_channel(log.lost().channel);
        else if (what == CandumpStream::What::comment)
            keep = true;
        if (keep && what == CandumpStream::What::frame && log.stamps() == CandumpStamps::delta && log.line().style.stamp_digits > 0) {
            CanFrame frame = log.line().frame; // its stamp is the time since the last frame that stayed
            frame.time_ns = last_kept_ns ? std::max<std::int64_t>(frame.time_ns - *last_kept_ns, 0) : 0;
            last_kept_ns = log.line().frame.time_ns;
            append_candump_line(out.text(), frame, log.line().style);
            out.text() += '\n';
        } else if (keep) {
            out.text() += log.text();
            if (log.ended())
                out.text() += '\n';
        }
        if (log.may_wait() ? !out.flush() : !out.written())
            return 0;
    }
    out.finish();
    cut.tell_absent(log);
    return 0;
}

} // namespace

void add_can_cut(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<CutFlags>();
    CLI::App* sub = can.add_subcommand("cut", "extract part of a candump log by time, identifier and channel");
    add_shared(*sub, "LOG", flags->file)->required();
    sub->add_option("--from", flags->from, "first time to keep, in seconds on the timestamps' clock; +S: since the first frame")
        ->option_text("S");
    sub->add_option("--to", flags->to, "last time to keep, likewise")->option_text("S");
    sub->add_option("--id", flags->ids, "identifiers to keep, such as 123 or 18FEF100 (8 digits: extended)")
        ->option_text("ID,...")
        ->allow_extra_args(false);
    sub->add_option("--filter", flags->filters, "candump's filters: ID:MASK, ID~MASK, #ERROR_MASK, j; of several any may match")
        ->option_text("FILTER,...")
        ->allow_extra_args(false);
    sub->add_option("--channel", flags->channels, "channel to keep, with filters as for candump: can0 or can0,123:7FF,#FFFFFFFF")
        ->option_text("NAME")
        ->allow_extra_args(false);
    sub->add_flag("--invert", flags->inverted, "keep what would be dropped");
    add_shared(*sub, "-o,--out", flags->out);
    add_shared(*sub, "--force", flags->force);
    add_log_flags(*sub, flags->log);
    sub->callback([flags, &chosen] { chosen = [flags] { return cut_log(*flags); }; });
}

} // namespace fernlicht
