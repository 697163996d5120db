// What stands in a DBC file, statement by statement, before its parts are brought together. What says nothing of frames (nodes, receivers,
// comments, groups) is read past.
#pragma once

#include "scenarios/can/can_database.h"

#include <cstddef>
#include <map>

namespace fernlicht {

struct DbcSignal {
    CanSignal signal;
    std::size_t line = 0;
    std::optional<std::uint64_t> when; ///< of "m3": 3
    std::string long_name;             ///< attribute
};

struct DbcMessage {
    CanMessage message;   ///< without signals
    std::uint32_t id = 0; ///< as it stands there: bit 31 says that it is extended
    std::size_t line = 0;
    std::string long_name, frame_format; ///< attributes
    std::vector<DbcSignal> signals;
};

/// What an attribute or labels belong to.
struct DbcObject {
    enum class Kind { other, message, signal } kind = Kind::other;
    std::uint32_t id = 0; ///< of the message
    std::string name;     ///< of the signal
    std::size_t line = 0;
};

struct DbcAttribute {
    std::string name;
    DbcObject on;
    std::string value; ///< text, or the number as it stands there
    bool quoted = false;
};

using DbcLabelList = std::vector<std::pair<std::string, std::string>>; ///< number as it stands there, text

struct DbcMultiplexing { ///< SG_MUL_VAL_
    DbcObject on;
    std::string multiplexor;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> when;
};

struct DbcStatements {
    std::vector<DbcMessage> messages;
    std::map<std::string, std::vector<std::string>> choices; ///< of attributes that are an ENUM
    std::map<std::string, std::string> defaults;             ///< of attributes
    std::vector<DbcAttribute> attributes;
    std::vector<std::pair<DbcObject, DbcLabelList>> labels;
    std::vector<DbcMultiplexing> multiplexing;
    std::vector<std::pair<DbcObject, std::uint64_t>> value_types; ///< SIG_VALTYPE_: 0: whole, 1: float32, 2: float64
    std::vector<std::string> notes;
};

/// `text` in UTF-8 with '\n' as line end. Throws InputError with file and line of what cannot be read.
DbcStatements parse_dbc(const std::string& text, const std::filesystem::path& file);

} // namespace fernlicht
