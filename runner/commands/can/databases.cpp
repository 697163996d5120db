#include "runner/commands/can/databases.h"

#include "runner/commands/flag_values.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <fmt/format.h>
#include <fnmatch.h>

namespace fernlicht {
namespace {

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

} // namespace

void add_database_flags(CLI::App& command, DatabaseFlags& flags) {
    command.add_option("--dbc", flags.files, "DBC file; may be given several times, the first that describes a frame wins")
        ->required()
        ->allow_extra_args(false);
    command.add_option("-m,--frame-id-mask", flags.id_mask, "identifier bits to compare, e.g. 0x00FFFF00 for J1939 (default: all)");
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

bool Selection::takes(const CanMessage& message) const { return messages_.empty() || messages_.contains(&message); }

bool Selection::takes(const CanSignal& signal) const { return messages_.empty() || signals_.contains(&signal); }

} // namespace fernlicht
