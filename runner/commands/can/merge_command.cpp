#include "runner/commands/can/can_command.h"

#include "runner/commands/can/line_output.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/log.h"
#include "runner/play/progress.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <vector>

namespace fernlicht {
namespace {

struct MergeFlags {
    std::vector<std::string> files, channels, offsets;
    std::string out;
    LogFlags log;
    bool force = false;
};

struct ChannelName {
    std::string from, to; ///< from "": all
    std::size_t flag = 0; ///< which of --channel
    bool used = false;
};

/// One of the logs, with the frame that comes next.
class MergeSource {
  public:
    MergeSource(const std::string& file, const LogFlags& flags) : stream_(file, flags) {}

    std::vector<ChannelName> names;
    std::int64_t offset_ns = 0;

    bool at_end() const { return at_end_; }
    std::int64_t time_ns() const { return line_.frame.time_ns; }
    const CandumpStream& log() const { return stream_.log(); }

    /// To the next frame. What stands between two frames goes to `between`, as lines of a log.
    void advance(std::string& between) {
        for (;;) {
            switch (stream_.next()) {
            case CandumpStream::What::end:
                at_end_ = true;
                return;
            case CandumpStream::What::lost:
                fmt::format_to(std::back_inserter(between), "DROPCOUNT: dropped {} CAN frame{} on '{}' socket (total drops {})\n",
                               log().lost().frames, log().lost().frames > 1 ? "s" : "", renamed(log().lost().channel), log().lost().total);
                break;
            case CandumpStream::What::explanation: // says what the frame says
                break;
            case CandumpStream::What::comment:
                between += log().text();
                between += '\n';
                break;
            case CandumpStream::What::frame:
                take_frame();
                return;
            }
        }
    }

    void append(std::string& out) const {
        if (verbatim_) {
            out += log().text();
        } else {
            append_candump_line(out, line_.frame, line_.style);
        }
        out += '\n';
    }

  private:
    std::string renamed(const std::string& channel) {
        for (ChannelName& name : names)
            if (name.from.empty() || name.from == channel) {
                name.used = true;
                return name.to;
            }
        return channel;
    }

    void take_frame() {
        const std::int64_t before = line_.frame.time_ns;
        line_ = log().line();
        if (line_.style.stamp_digits == 0)
            throw InputError({log().path(), log().line_number(), 0, {}}, "found a frame without a stamp", "stamps to merge by");
        verbatim_ = line_.style.form == CandumpStyle::Form::log && offset_ns == 0 && names.empty() && !zero_or_delta();
        if (offset_ns < 0 ? line_.frame.time_ns < -offset_ns : line_.frame.time_ns > INT64_MAX - offset_ns)
            throw InputError({log().path(), log().line_number(), 0, {}}, "found a stamp that --offset takes before 0 or beyond 2262",
                             "a smaller offset");
        line_.frame.time_ns += offset_ns;
        if (offset_ns % 1000 != 0)
            line_.style.stamp_digits = 9;
        line_.frame.channel = renamed(line_.frame.channel);
        if (line_.style.form == CandumpStyle::Form::screen) {
            CandumpStyle style;
            style.stamp_digits = line_.style.stamp_digits;
            style.second_digits = line_.style.date ? std::uint8_t{10} : line_.style.second_digits;
            style.sent = line_.style.sent;
            line_.style = style;
        }
        if (!told_ && started_ && line_.frame.time_ns < before) {
            tell(LogLevel::warning,
                 fmt::format("{}:{}: its stamps fall; its own order is kept", printable(log().path().string(), 400), log().line_number()));
            told_ = true;
        }
        started_ = true;
    }

    bool zero_or_delta() const { return log().stamps() == CandumpStamps::zero || log().stamps() == CandumpStamps::delta; }

    LenientStream stream_;
    CandumpLine line_;
    bool at_end_ = false, verbatim_ = false, started_ = false, told_ = false;
};

/// "VALUE" for all files, or "FILE=VALUE" for one: the values that concern `file`, and which text they come from.
std::optional<std::string> value_for(const std::string& text, const std::string& file, const std::vector<std::string>& files) {
    const auto names = [&](const std::string& one) { return text.starts_with(one + "="); };
    if (names(file))
        return text.substr(file.size() + 1);
    return std::ranges::any_of(files, names) ? std::nullopt : std::optional(text);
}

void name_source(MergeSource& source, const std::string& file, const MergeFlags& flags) {
    for (std::size_t flag = 0; flag < flags.channels.size(); ++flag) {
        const std::string& text = flags.channels[flag];
        const std::optional<std::string> value = value_for(text, file, flags.files);
        if (!value)
            continue;
        const std::size_t sign = value->find('=');
        ChannelName name{sign == std::string::npos ? "" : value->substr(0, sign),
                         sign == std::string::npos ? *value : value->substr(sign + 1), flag};
        const auto is_bad = [](unsigned char c) { return c <= ' ' || c == 0x7f; };
        if (name.to.empty() || name.to.size() > 15 || std::ranges::any_of(name.to, is_bad) || sign == 0)
            refuse_flag("--rename-channel", text, "CHANNEL, OLD=NEW, FILE=CHANNEL or FILE=OLD=NEW, with names of at most 15 bytes");
        source.names.push_back(std::move(name));
    }
    for (const std::string& text : flags.offsets)
        if (const std::optional<std::string> value = value_for(text, file, flags.files))
            source.offset_ns = nanoseconds_of("--offset", *value, true);
}

/// A name that is none of the files' and none of their channels' would change nothing.
void check_names_used(const std::vector<std::unique_ptr<MergeSource>>& sources, const MergeFlags& flags) {
    for (std::size_t flag = 0; flag < flags.channels.size(); ++flag) {
        const auto is_used = [&](const ChannelName& name) { return name.flag == flag && (name.used || name.from.empty()); };
        if (std::ranges::none_of(sources, [&](const auto& source) { return std::ranges::any_of(source->names, is_used); }))
            refuse_flag("--rename-channel", flags.channels[flag], "one of the files or a channel of theirs before =");
    }
}

int merge_logs(const MergeFlags& flags) {
    if (std::ranges::count(flags.files, "-") > 1)
        refuse_flag("FILE", "-", "standard input once");
    std::optional<Interruption> interruption; // ends a pipe as its end would
    std::vector<std::unique_ptr<MergeSource>> sources;
    for (const std::string& file : flags.files) {
        sources.push_back(std::make_unique<MergeSource>(file, flags.log));
        name_source(*sources.back(), file, flags);
        if (sources.back()->log().from_pipe() && !interruption)
            interruption.emplace();
    }
    LineOutput out(flags.out, flags.force);
    for (const auto& source : sources)
        source->advance(out.text());
    for (;;) {
        MergeSource* next = nullptr; // the earliest, of equals the first named
        for (const auto& source : sources)
            if (!source->at_end() && (!next || source->time_ns() < next->time_ns()))
                next = source.get();
        if (!next)
            break;
        next->append(out.text());
        if (next->log().may_wait() ? !out.flush() : !out.written())
            return 0;
        next->advance(out.text());
    }
    if (!Interruption::requested())
        check_names_used(sources, flags);
    out.finish();
    return 0;
}

} // namespace

void add_can_merge(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<MergeFlags>();
    CLI::App* sub = can.add_subcommand("merge", "merge candump logs in time order; equal timestamps in file order");
    add_shared(*sub, "LOGS", flags->files)->required();
    sub->add_option("--rename-channel", flags->channels, "rename channels: NEW, OLD=NEW, FILE=NEW or FILE=OLD=NEW")
        ->option_text("[FILE=][OLD=]NEW")
        ->allow_extra_args(false);
    sub->add_option("--offset", flags->offsets, "seconds to add to timestamps, such as -0.25")
        ->option_text("[FILE=]S")
        ->allow_extra_args(false);
    add_shared(*sub, "-o,--out", flags->out);
    add_shared(*sub, "--force", flags->force);
    add_log_flags(*sub, flags->log);
    sub->callback([flags, &chosen] { chosen = [flags] { return merge_logs(*flags); }; });
}

} // namespace fernlicht
