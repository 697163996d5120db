#include "runner/commands/can/can_command.h"

#include "runner/commands/can/decoded_text.h"
#include "runner/commands/can/line_output.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/log.h"
#include "runner/play/progress.h"
#include "scenarios/can/can_database.h"
#include "scenarios/can/signal_codec.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fnmatch.h>
#include <iterator>
#include <memory>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace fernlicht {
namespace {

struct DatabaseFlags {
    std::vector<std::string> files;
    std::string id_mask; ///< "": all bits count
};

/// The DBC files that the tool was given, and what they know about a frame.
class Databases {
  public:
    /// Reads all files. Throws InputError for what cannot be read, none given, or a mask that is no number.
    explicit Databases(const DatabaseFlags& flags);

    /// Of data frames; the first file that describes it counts. nullptr: none does.
    const CanMessage* message(const CanFrame& frame) const;
    const std::vector<CanDatabase>& all() const { return databases_; }

  private:
    std::vector<CanDatabase> databases_;
    std::uint32_t mask_ = 0x1FFFFFFF;
    std::unordered_map<std::uint64_t, const CanMessage*> by_id_;
};

/// Messages and signals that shall stay: "Message", "Message.Signal" (or with / in place of the point), or "Signal" of any message.
class Selection {
  public:
    Selection() = default;
    /// Throws InputError for a name that nothing in the databases has.
    Selection(const std::vector<std::string>& names, const Databases& databases);
    bool everything() const { return messages_.empty(); }
    bool takes(const CanMessage& message) const { return everything() || messages_.contains(&message); }
    bool takes(const CanSignal& signal) const { return everything() || signals_.contains(&signal); }

  private:
    std::unordered_set<const CanMessage*> messages_;
    std::unordered_set<const CanSignal*> signals_;
};

std::uint32_t mask_of(const std::string& text) {
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    std::uint32_t mask = 0;
    const char* begin = text.data() + (hexadecimal ? 2 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), mask, hexadecimal ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size() || mask > 0x1FFFFFFF)
        refuse_flag("--frame-id-mask", text, "a number up to 0x1FFFFFFF");
    return mask;
}

bool fits(const std::string& pattern, const std::string& name) { return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0; }

std::uint64_t lookup_key(std::uint32_t id, bool extended) { return id | (extended ? std::uint64_t{1} << 32 : 0); }

/// --dbc, --frame-id-mask
void add_database_flags(CLI::App& command, DatabaseFlags& flags) {
    command.add_option("--dbc", flags.files, "DBC file; of several the first that describes a frame wins")
        ->option_text("FILE")
        ->required()
        ->allow_extra_args(false);
    command.add_option("-m,--frame-id-mask", flags.id_mask, "identifier bits to compare, such as 0x00FFFF00 for J1939")
        ->option_text("MASK")
        ->default_str("all");
}

Databases::Databases(const DatabaseFlags& flags) {
    if (!flags.id_mask.empty())
        mask_ = mask_of(flags.id_mask);
    FilesRead opened;
    for (const std::string& file : flags.files)
        databases_.push_back(read_dbc(file, opened));
    for (const CanDatabase& database : databases_)
        for (const CanMessage& message : database.messages)
            by_id_.try_emplace(lookup_key(message.id & mask_, message.extended), &message);
}

const CanMessage* Databases::message(const CanFrame& frame) const {
    if (frame.error || frame.remote)
        return nullptr;
    const auto found = by_id_.find(lookup_key(frame.id & mask_, frame.extended));
    return found == by_id_.end() ? nullptr : found->second;
}

Selection::Selection(const std::vector<std::string>& names, const Databases& databases) {
    for (const std::string& text : names) {
        const std::size_t cut = text.find_first_of("./");
        const std::string message_name = text.substr(0, cut), signal_name = cut == std::string::npos ? text : text.substr(cut + 1);
        bool found = false;
        for (const CanDatabase& database : databases.all())
            for (const CanMessage& message : database.messages) {
                const bool whole = cut == std::string::npos && fits(text, message.name);
                for (const CanSignal& signal : message.signals)
                    if (whole || ((cut == std::string::npos || fits(message_name, message.name)) && fits(signal_name, signal.name))) {
                        signals_.insert(&signal);
                        messages_.insert(&message);
                        found = true;
                    }
                if (whole) { // one without signals may be chosen, too
                    messages_.insert(&message);
                    found = true;
                }
            }
        if (!found)
            throw InputError({{}, 0, 0, "--only"}, fmt::format("found '{}'", printable(text)),
                             "a message, a signal or MESSAGE.SIGNAL of the databases, * and ? allowed");
    }
}

struct DecodeFlags {
    std::vector<std::string> logs, only;
    std::string out;
    DatabaseFlags databases;
    LogFlags log;
    bool single_line = false, json = false, csv = false, numbers = false, skip_unknown = false, notes = false, force = false;
};

/// Writes frame after frame in one of the three forms.
class Decoder {
  public:
    explicit Decoder(const DecodeFlags& flags)
        : flags_(flags), databases_(flags.databases), selection_(items_of("--only", flags.only), databases_), out_(flags.out, flags.force) {
        if (flags.notes)
            for (const CanDatabase& database : databases_.all())
                for (const std::string& note : database.notes)
                    tell(LogLevel::warning, fmt::format("{}: {}", printable(database.file.string(), 400), note));
        if (flags.csv)
            write_header();
    }

    /// False: nobody reads any more.
    bool decode_log(const std::string& path);
    void finish();

  private:
    void write_header();
    void write_frame(const CandumpStream& log);
    void write_row(const CandumpLine& line, const CanMessage& message);
    void pass_line(const CandumpStream& log);

    const DecodeFlags& flags_;
    Databases databases_;
    Selection selection_;
    LineOutput out_;
    std::vector<CanValue> values_;
    std::vector<const CanSignal*> columns_;
    std::set<std::pair<std::uint32_t, bool>> unknown_ids_;
    std::uint64_t unknown_ = 0;
};

// All signals that may come, in the order of the files: a table has the same columns whatever the log holds.
void Decoder::write_header() {
    out_.text() += "time,channel,message";
    for (const CanDatabase& database : databases_.all())
        for (const CanMessage& message : database.messages)
            for (const CanSignal& signal : message.signals) {
                if (!selection_.takes(message) || !selection_.takes(signal))
                    continue;
                columns_.push_back(&signal);
                out_.text() += ',';
                append_csv_text(out_.text(), message.name + "." + signal.name + (signal.unit.empty() ? "" : " [" + signal.unit + "]"));
            }
    out_.text() += '\n';
}

void Decoder::write_row(const CandumpLine& line, const CanMessage& message) {
    std::string& out = out_.text();
    const CanFrame& frame = line.frame;
    if (line.style.stamp_digits > 0)
        fmt::format_to(std::back_inserter(out), "{}.{:09}", frame.time_ns / 1'000'000'000, frame.time_ns % 1'000'000'000);
    out += ',';
    append_csv_text(out, frame.channel);
    out += ',';
    append_csv_text(out, message.name);
    auto value = values_.begin(); // both in the order of the file
    for (const CanSignal* column : columns_) {
        out += ',';
        if (value != values_.end() && value->signal == column) {
            out += exact_text(*value);
            ++value;
        }
    }
    out += '\n';
}

// What is no frame stays between the frames where people read, and goes where programs do.
void Decoder::pass_line(const CandumpStream& log) {
    if (!flags_.json && !flags_.csv && selection_.everything() && !flags_.skip_unknown) {
        out_.text() += log.text();
        out_.text() += '\n';
    }
}

void Decoder::write_frame(const CandumpStream& log) {
    const CandumpLine& line = log.line();
    const CanMessage* message = databases_.message(line.frame);
    if (message == nullptr) {
        ++unknown_;
        unknown_ids_.emplace(line.frame.id, line.frame.extended);
        if (flags_.skip_unknown || flags_.csv || !selection_.everything())
            return;
        if (flags_.json) {
            append_frame_json(out_.text(), line, nullptr, {});
        } else {
            out_.text() += log.text();
            if (!line.frame.error && !line.frame.remote)
                fmt::format_to(std::back_inserter(out_.text()), " :: Unknown frame id {} (0x{:x})", line.frame.id, line.frame.id);
        }
        out_.text() += '\n';
        return;
    }
    if (!selection_.takes(*message))
        return;
    decode_into(*message, line.frame.bytes(), values_);
    if (!selection_.everything()) {
        std::erase_if(values_, [&](const CanValue& value) { return !selection_.takes(*value.signal); });
        if (values_.empty() && !message->signals.empty()) // of another multiplexor value
            return;
    }
    if (flags_.csv)
        return write_row(line, *message);
    if (flags_.json)
        append_frame_json(out_.text(), line, message, values_);
    else {
        out_.text() += log.text();
        append_decoded(out_.text(), *message, values_, flags_.single_line, flags_.numbers);
    }
    out_.text() += '\n';
}

bool Decoder::decode_log(const std::string& path) {
    LenientStream stream(path, flags_.log);
    const CandumpStream& log = stream.log();
    for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;) {
        if (what == CandumpStream::What::frame)
            write_frame(log);
        else
            pass_line(log);
        if (log.may_wait() ? !out_.flush() : !out_.written())
            return false;
    }
    return out_.flush();
}

void Decoder::finish() {
    out_.finish();
    if (unknown_ > 0 && (flags_.skip_unknown || flags_.csv))
        tell(LogLevel::warning, fmt::format("{} frame{} of {} identifier{} that no message describes left out", unknown_,
                                            unknown_ == 1 ? "" : "s", unknown_ids_.size(), unknown_ids_.size() == 1 ? "" : "s"));
}

int decode_logs(const DecodeFlags& flags) {
    if (flags.json && flags.csv)
        throw InputError({{}, 0, 0, "--csv"}, "found beside --json", "one of the two");
    Decoder decoder(flags);
    const Interruption interruption;
    const std::vector<std::string> logs = flags.logs.empty() ? std::vector<std::string>{"-"} : flags.logs;
    for (const std::string& log : logs)
        if (!decoder.decode_log(log))
            return 0;
    decoder.finish();
    return Interruption::requested() ? 1 : 0;
}

} // namespace

void add_can_decode(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<DecodeFlags>();
    CLI::App* sub = can.add_subcommand("decode", "decode the frames of a candump log with DBC files");
    add_shared(*sub, "LOGS", flags->logs)->default_str("-");
    add_database_flags(*sub, flags->databases);
    sub->add_flag("-s,--single-line", flags->single_line, "put signals on the frame's line");
    sub->add_flag("-c,--numbers", flags->numbers, "show numbers instead of labels");
    add_shared(*sub, "--only", flags->only);
    sub->add_flag("--skip-unknown", flags->skip_unknown, "skip frames that no message describes, and count them");
    sub->add_flag("--notes", flags->notes, "report oddities of the DBC files and how they were read, on standard error");
    add_shared(*sub, "--json", flags->json);
    add_shared(*sub, "--csv", flags->csv);
    add_shared(*sub, "-o,--out", flags->out);
    add_shared(*sub, "--force", flags->force);
    add_log_flags(*sub, flags->log);
    sub->footer(
        "--only takes messages and signals: MESSAGE, SIGNAL or MESSAGE.SIGNAL. JSON has an object a line; CSV a row per frame and a column "
        "per signal, with numbers, not labels.");
    sub->callback([flags, &chosen] { chosen = [flags] { return decode_logs(*flags); }; });
}

} // namespace fernlicht
