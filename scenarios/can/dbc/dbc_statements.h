// What stands in a DBC file, statement by statement, before its parts are brought together.
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

/// What a comment, an attribute or labels belong to.
struct DbcObject {
    enum class Kind { network, node, message, signal, variable } kind = Kind::network;
    std::uint32_t id = 0; ///< of the message
    std::string name;     ///< of node, signal or variable
    std::size_t line = 0;
};

struct DbcComment {
    DbcObject on;
    std::string text;
};

struct DbcAttributeDefinition {
    DbcObject::Kind kind = DbcObject::Kind::network;
    std::string type;                 ///< INT, HEX, FLOAT, STRING, ENUM
    std::vector<std::string> choices; ///< of ENUM
};

struct DbcAttribute {
    std::string name;
    DbcObject on;
    std::string value; ///< text, or the number as it stands there
    bool quoted = false;
};

using DbcLabelList = std::vector<std::pair<std::string, std::string>>; ///< number as it stands there, text

struct DbcLabels {
    DbcObject on;
    DbcLabelList labels;
};

struct DbcMultiplexing { ///< SG_MUL_VAL_
    DbcObject on;
    std::string multiplexor;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> when;
};

struct DbcValueType { ///< SIG_VALTYPE_
    DbcObject on;
    std::uint64_t type = 0; ///< 0: whole, 1: float32, 2: float64
};

struct DbcSenders { ///< BO_TX_BU_
    DbcObject on;
    std::vector<std::string> names;
};

struct DbcStatements {
    std::string version;
    std::vector<std::string> nodes;
    std::map<std::string, DbcLabelList> tables;
    std::vector<DbcMessage> messages;
    std::vector<DbcSenders> senders;
    std::vector<DbcComment> comments;
    std::map<std::string, DbcAttributeDefinition> definitions;
    std::map<std::string, std::string> defaults; ///< of attributes
    std::vector<DbcAttribute> attributes;
    std::vector<DbcLabels> labels;
    std::vector<DbcMultiplexing> multiplexing;
    std::vector<DbcValueType> value_types;
    std::vector<std::string> notes;
};

/// `text` in UTF-8 with '\n' as line end. Throws InputError with file and line of what cannot be read.
DbcStatements parse_dbc(const std::string& text, const std::filesystem::path& file);

} // namespace fernlicht
