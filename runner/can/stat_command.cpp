#include "runner/can/stat_command.h"

#include "runner/can/line_output.h"
#include "runner/can/log_flags.h"
#include "runner/can/log_statistics.h"
#include "runner/flag_values.h"
#include "runner/interruption.h"
#include "scenarios/can/error_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace fernlicht {
namespace {

struct StatFlags {
    std::vector<std::string> files;
    LogFlags log;
    StatisticsOptions options;
    std::string every; ///< seconds; "": at the end alone
    std::string bitrate, data_bitrate, gap;
    bool json = false;
};

std::string identifier_text(const IdStatistics& id) { return fmt::format("{:0{}X}{}", id.id, id.extended ? 8 : 3, id.remote ? " R" : ""); }

/// "8", "0,2,8" or "0-64".
std::string lengths_text(const std::vector<std::uint8_t>& lengths) {
    if (lengths.size() > 3)
        return fmt::format("{}-{}", lengths.front(), lengths.back());
    std::string text;
    for (const std::uint8_t length : lengths)
        text += fmt::format("{}{}", text.empty() ? "" : ",", length);
    return text;
}

/// Two characters a byte: its bits that changed, "--" for none.
std::string changing_text(const IdStatistics& id) {
    std::string text;
    for (std::size_t i = 0; i < id.bytes_seen; ++i)
        text += id.changed[i] ? fmt::format("{:02X}", id.changed[i]) : "--";
    return text;
}

std::string stamp_text(std::int64_t time_ns) { return fmt::format("{}.{:06}", time_ns / 1'000'000'000, time_ns % 1'000'000'000 / 1000); }

/// Frames a second from the first stamp up to the last, without those stamped as the last.
template <typename Statistics> double rate_of(const Statistics& of) {
    return of.first_ns && *of.last_ns > *of.first_ns
               ? static_cast<double>(of.frames - of.frames_at_end) * 1e9 / static_cast<double>(*of.last_ns - *of.first_ns)
               : 0.0;
}

std::string percent_text(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

void append_ids(const ChannelStatistics& channel, const StatFlags& flags, std::string& out) {
    const bool load = flags.options.bitrate > 0.0 && channel.seconds() > 0.0;
    fmt::format_to(std::back_inserter(out), "  {:<10} {:>9} {:>8} {:>11} {:>11} {:>11} {:>11} {:>10} {:>12} {:>5} {}{:>8}  {}\n", "id",
                   "frames", "/s", "period ms", "median", "least", "most", "jitter", "most at s", "gaps", load ? " load % " : "", "bytes",
                   "changing bits");
    for (const IdStatistics& id : channel.ids) {
        const PeriodStatistics& periods = id.periods;
        const std::optional<std::uint64_t> gaps = periods.gaps(flags.options.gap_factor);
        fmt::format_to(std::back_inserter(out), "  {:<10} {:>9}", identifier_text(id), id.frames);
        if (periods.count() > 0)
            fmt::format_to(std::back_inserter(out), " {:>8.2f} {:>11.3f} {:>11.3f} {:>11.3f} {:>11.3f} {:>10.3f} {:>12.3f} {:>5}",
                           rate_of(id), periods.mean_ns() * 1e-6, periods.median_ns() * 1e-6,
                           static_cast<double>(periods.least_ns()) * 1e-6, static_cast<double>(periods.most_ns()) * 1e-6,
                           periods.deviation_ns() * 1e-6, static_cast<double>(periods.most_ended_ns() - *channel.first_ns) * 1e-9,
                           gaps ? fmt::format("{}", *gaps) : "-");
        else
            fmt::format_to(std::back_inserter(out), " {:>8} {:>11} {:>11} {:>11} {:>11} {:>10} {:>12} {:>5}", "-", "-", "-", "-", "-", "-",
                           "-", "-");
        if (load)
            fmt::format_to(std::back_inserter(out), " {:>7.3f}", 100.0 * channel.load(id).exact_s);
        fmt::format_to(std::back_inserter(out), " {:>8}  {}\n", lengths_text(id.lengths), changing_text(id));
    }
}

std::string errors_text(const ChannelStatistics& channel) {
    std::string text;
    for (std::size_t i = 0; i < channel.error_classes.size(); ++i)
        if (channel.error_classes[i] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", i < can_error_classes.size() ? can_error_classes[i] : "others",
                                channel.error_classes[i]);
    return text;
}

/// Without their requests.
std::size_t distinct_ids(const ChannelStatistics& channel) {
    std::size_t ids = 0;
    for (std::size_t i = 0; i < channel.ids.size(); ++i)
        if (i == 0 || channel.ids[i].id != channel.ids[i - 1].id || channel.ids[i].extended != channel.ids[i - 1].extended)
            ++ids;
    return ids;
}

std::string statistics_text(const std::vector<ChannelStatistics>& channels, const StatFlags& flags) {
    std::string out;
    auto to = std::back_inserter(out);
    for (const ChannelStatistics& channel : channels) {
        const std::size_t ids = distinct_ids(channel);
        fmt::format_to(to, "{}{}: {} frame{} of {} identifier{}", out.empty() ? "" : "\n", printable(channel.name), channel.frames,
                       channel.frames == 1 ? "" : "s", ids, ids == 1 ? "" : "s");
        if (channel.first_ns)
            fmt::format_to(to, ", {:.1f}/s, from {} to {} ({:.3f} s)\n", rate_of(channel), stamp_text(*channel.first_ns),
                           stamp_text(*channel.last_ns), channel.seconds());
        else
            fmt::format_to(to, ", without stamps\n");
        if (flags.options.bitrate > 0.0 && channel.seconds() > 0.0) {
            const BusTime load = channel.load();
            fmt::format_to(to, "  load {} with stuffed bits ({} without, {} at worst)", percent_text(load.exact_s),
                           percent_text(load.without_stuffing_s), percent_text(load.worst_s));
            fmt::format_to(to, "{}\n", channel.seconds() >= 1.0 ? ", busiest second " + percent_text(channel.busiest_second) : "");
        }
        if (channel.silence_ns > 0)
            fmt::format_to(to, "  longest silence {:.6f} s, until {}\n", static_cast<double>(channel.silence_ns) * 1e-9,
                           stamp_text(channel.silence_ended_ns));
        if (channel.errors > 0)
            fmt::format_to(to, "  {} error frame{}: {}\n", channel.errors, channel.errors == 1 ? "" : "s", errors_text(channel));
        if (channel.lost > 0)
            fmt::format_to(to, "  {} frame{} lost by the socket that was logged\n", channel.lost, channel.lost == 1 ? "" : "s");
        if (channel.step_ns >= 1'000'000)
            fmt::format_to(to, "  stamps come in steps of {:g} s: periods are known no better\n",
                           static_cast<double>(channel.step_ns) * 1e-9);
        if (channel.backwards > 0)
            fmt::format_to(to, "  {} stamp{} below the one before\n", channel.backwards, channel.backwards == 1 ? "" : "s");
        if (!channel.ids.empty())
            append_ids(channel, flags, out);
    }
    return out;
}

using StatJson = nlohmann::ordered_json;

StatJson load_json(const BusTime& load) {
    return {{"exact", load.exact_s}, {"without_stuffing", load.without_stuffing_s}, {"worst", load.worst_s}};
}

StatJson id_json(const IdStatistics& id, const ChannelStatistics& channel, const StatFlags& flags) {
    StatJson one{{"id", fmt::format("{:0{}X}", id.id, id.extended ? 8 : 3)},
                 {"extended", id.extended},
                 {"remote", id.remote},
                 {"frames", id.frames},
                 {"fd_frames", id.fd_frames},
                 {"sent", id.sent}};
    if (id.first_ns) {
        one["first_ns"] = *id.first_ns;
        one["last_ns"] = *id.last_ns;
        one["backwards"] = id.backwards;
    }
    if (const PeriodStatistics& periods = id.periods; periods.count() > 0) {
        one["rate_hz"] = rate_of(id);
        one["period_ms"] = {{"mean", periods.mean_ns() * 1e-6},
                            {"median", periods.median_ns() * 1e-6},
                            {"least", static_cast<double>(periods.least_ns()) * 1e-6},
                            {"most", static_cast<double>(periods.most_ns()) * 1e-6},
                            {"jitter", periods.deviation_ns() * 1e-6}};
        one["longest_period_ended_ns"] = periods.most_ended_ns();
        const std::optional<std::uint64_t> gaps = periods.gaps(flags.options.gap_factor);
        one["gaps"] = gaps ? StatJson(*gaps) : StatJson(nullptr);
    }
    one["lengths"] = id.lengths;
    std::string first, changed;
    std::vector<std::size_t> bytes;
    for (std::size_t i = 0; i < id.bytes_seen; ++i) {
        first += fmt::format("{:02X}", id.first_bytes[i]);
        changed += fmt::format("{:02X}", id.changed[i]);
        if (id.changed[i])
            bytes.push_back(i);
    }
    one["first_data"] = first;
    one["changing_bits"] = changed;
    one["changing_bytes"] = bytes;
    if (flags.options.bitrate > 0.0 && channel.seconds() > 0.0)
        one["load"] = load_json(channel.load(id));
    return one;
}

StatJson statistics_json(const std::vector<ChannelStatistics>& channels, const StatFlags& flags) {
    StatJson all{{"files", flags.files}, {"gap_factor", flags.options.gap_factor}};
    if (flags.options.bitrate > 0.0) {
        all["bitrate"] = flags.options.bitrate;
        all["data_bitrate"] = flags.options.data_bitrate > 0.0 ? flags.options.data_bitrate : flags.options.bitrate;
    }
    all["channels"] = StatJson::array();
    for (const ChannelStatistics& channel : channels) {
        StatJson one{{"name", printable(channel.name)}, {"frames", channel.frames}, {"lost", channel.lost}, {"errors", channel.errors}};
        StatJson classes = StatJson::object();
        for (std::size_t i = 0; i < channel.error_classes.size(); ++i)
            if (channel.error_classes[i] > 0)
                classes[std::string(i < can_error_classes.size() ? can_error_classes[i] : "others")] = channel.error_classes[i];
        one["error_classes"] = classes;
        if (channel.first_ns) {
            one["first_ns"] = *channel.first_ns;
            one["last_ns"] = *channel.last_ns;
            one["rate_hz"] = rate_of(channel);
            one["longest_silence_s"] = static_cast<double>(channel.silence_ns) * 1e-9;
            one["longest_silence_ended_ns"] = channel.silence_ended_ns;
            one["backwards"] = channel.backwards;
            one["stamp_step_ns"] = channel.step_ns > 0 ? StatJson(channel.step_ns) : StatJson(nullptr);
        }
        if (flags.options.bitrate > 0.0 && channel.seconds() > 0.0) {
            one["load"] = load_json(channel.load());
            if (channel.seconds() >= 1.0)
                one["load"]["busiest_second"] = channel.busiest_second;
        }
        one["ids"] = StatJson::array();
        for (const IdStatistics& id : channel.ids)
            one["ids"].push_back(id_json(id, channel, flags));
        all["channels"].push_back(std::move(one));
    }
    return all;
}

/// Into `value` where the flag was given.
void take_number(const char* flag, const std::string& text, double least, double most, const char* expected, double& value) {
    if (text.empty())
        return;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most))
        refuse_flag(flag, text, expected);
}

void take_stat_flags(StatFlags& flags) {
    take_number("--bitrate", flags.bitrate, 1000.0, 20e6, "bit/s from 1000 to 20 000 000", flags.options.bitrate);
    take_number("--data-bitrate", flags.data_bitrate, 1000.0, 20e6, "bit/s from 1000 to 20 000 000", flags.options.data_bitrate);
    if (!flags.data_bitrate.empty() && flags.bitrate.empty())
        refuse_flag("--data-bitrate", flags.data_bitrate, "--bitrate beside it");
    take_number("--gap", flags.gap, std::nextafter(1.0, 2.0), 1e6, "a factor above 1", flags.options.gap_factor);
}

/// False: nobody reads any more.
bool print_statistics(const LogStatistics& statistics, const StatFlags& flags, bool last) {
    const std::vector<ChannelStatistics> channels = statistics.so_far();
    LineOutput out({});
    if (flags.json)
        out.text() =
            statistics_json(channels, flags).dump(flags.every.empty() ? 2 : -1, ' ', false, StatJson::error_handler_t::replace) + "\n";
    else
        out.text() = (channels.empty() ? "no frames\n" : statistics_text(channels, flags)) + (last ? "" : "\n");
    return out.flush();
}

int show_statistics(StatFlags flags) {
    take_stat_flags(flags);
    const std::int64_t every_ns = flags.every.empty() ? 0 : nanoseconds_of("--every", flags.every);
    if (!flags.every.empty() && every_ns == 0)
        refuse_flag("--every", flags.every, "seconds above 0");
    std::optional<std::int64_t> printed_ns;
    LogStatistics statistics(flags.options);
    for (const std::string& file : flags.files) {
        LenientStream stream(file, flags.log);
        const CandumpStream& log = stream.log();
        std::optional<Interruption> interruption; // a pipe need not end by itself
        if (log.from_pipe())
            interruption.emplace();
        for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;) {
            if (what == CandumpStream::What::frame)
                statistics.add(log.line().frame, log.line().style.stamp_digits > 0, log.line().style.sent);
            else if (what == CandumpStream::What::lost)
                statistics.lost(log.lost().channel, log.lost().frames);
            if (every_ns == 0 || what != CandumpStream::What::frame)
                continue;
            const std::int64_t now_ns = log.line().frame.time_ns;
            if (!printed_ns)
                printed_ns = now_ns;
            if (now_ns - *printed_ns < every_ns)
                continue;
            printed_ns = now_ns;
            if (!print_statistics(statistics, flags, false))
                return 0;
        }
        if (interruption && Interruption::asked())
            break;
    }
    print_statistics(statistics, flags, true);
    return 0;
}

} // namespace

void add_can_stat(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<StatFlags>();
    CLI::App* sub = can.add_subcommand("stat", "what candump logs show: rates, periods and jitter, gaps, load, errors, changing bits");
    sub->add_option("FILE", flags->files, "logs of candump, one after the other; - for standard input")->required();
    sub->add_option("--bitrate", flags->bitrate, "of the bus, in bit/s: tells its load");
    sub->add_option("--data-bitrate", flags->data_bitrate, "of CAN FD with bit rate switch, in bit/s (as --bitrate)");
    sub->add_option("--gap", flags->gap, "a gap is a period longer than so many medians (3)");
    sub->add_option("--every", flags->every, "prints what came so far whenever so many seconds have passed by the stamps, too");
    sub->add_flag("--json", flags->json, "prints JSON; with --every one line each");
    add_log_flags(*sub, flags->log);
    sub->callback([flags, &chosen] { chosen = [flags] { return show_statistics(*flags); }; });
}

} // namespace fernlicht
