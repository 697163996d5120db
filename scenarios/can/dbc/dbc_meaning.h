// From the statements of a DBC file to its messages and signals: what belongs together is brought together, and looked at.
#pragma once

#include "scenarios/can/dbc/dbc_statements.h"
#include "scenarios/values/errors.h"

#include <set>
#include <unordered_map>

namespace fernlicht {

constexpr std::uint32_t dbc_unsent_signals = 0xC0000000U; ///< identifier of VECTOR__INDEPENDENT_SIG_MSG

/// The statements of one file, with their messages by identifier.
struct DbcReading {
    std::filesystem::path file;
    DbcStatements statements;
    std::unordered_map<std::uint32_t, std::size_t> by_id; ///< as it stands in the file -> place in statements.messages
    std::vector<std::string> notes;

    DbcMessage* message(std::uint32_t id);
    /// Signals may go from a message between two questions, but not change places or names.
    DbcSignal* signal(std::uint32_t id, const std::string& name);
    struct Places {
        std::size_t signals = 0; ///< of the message when this was made
        std::unordered_map<std::string, std::size_t> of;
    };
    std::unordered_map<std::uint32_t, Places> places;         ///< of a message's signals, by identifier; filled by signal()
    std::set<std::pair<std::uint32_t, std::string>> left_out; ///< signals that were there, and "" for messages, by identifier

    void note(std::size_t line, const std::string& text);
    /// What a statement is on; with a note nullptr where it is not in the file.
    DbcMessage* message_of(const char* keyword, const DbcObject& on);
    DbcSignal* signal_of(const char* keyword, const DbcObject& on);
    [[noreturn]] void refuse(std::size_t line, const std::string& found, const std::string& expected) const;
};

/// Messages by identifier, each identifier and name once.
void check_dbc_names(DbcReading& reading);
/// Whole, float or double, from SIG_VALTYPE_.
void apply_dbc_value_types(DbcReading& reading);
/// M, m0 and SG_MUL_VAL_: who is switched by whom at which values. Signals of which the file does not say it go, with a note.
void apply_dbc_multiplexing(DbcReading& reading);
/// Lengths, limits, factors and places of signals.
void check_dbc_layout(DbcReading& reading);
/// VAL_ .
void apply_dbc_labels(DbcReading& reading);
/// Cycle times, FD, start values, long names.
void apply_dbc_attributes(DbcReading& reading);

/// "Message.Signal", made printable.
std::string dbc_signal_name(const DbcMessage& message, const DbcSignal& signal);

} // namespace fernlicht
