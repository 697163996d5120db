#include "scenarios/can/dbc/dbc_cursor.h"
#include "scenarios/can/dbc/dbc_statements.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr std::uint64_t any_dbc_id = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t any_dbc_whole = std::numeric_limits<std::uint64_t>::max();

// What may begin a statement. Those that are not listed with a reader below are taken up to their semicolon and say nothing about frames.
constexpr std::array dbc_keywords{"VERSION",
                                  "NS_",
                                  "BS_",
                                  "BU_",
                                  "VAL_TABLE_",
                                  "BO_",
                                  "SG_",
                                  "BO_TX_BU_",
                                  "EV_",
                                  "ENVVAR_DATA_",
                                  "EV_DATA_",
                                  "SGTYPE_",
                                  "SGTYPE_VAL_",
                                  "SIG_TYPE_REF_",
                                  "SIG_GROUP_",
                                  "CM_",
                                  "BA_DEF_",
                                  "BA_DEF_SGTYPE_",
                                  "BA_SGTYPE_",
                                  "BA_DEF_REL_",
                                  "BA_DEF_DEF_",
                                  "BA_DEF_DEF_REL_",
                                  "BA_",
                                  "BA_REL_",
                                  "BA_DEF_DEF_SGTYPE_",
                                  "VAL_",
                                  "SIG_VALTYPE_",
                                  "SIGTYPE_VALTYPE_",
                                  "SG_MUL_VAL_",
                                  "CAT_DEF_",
                                  "CAT_",
                                  "FILTER",
                                  "NS_DESC_"};

bool dbc_keyword(std::string_view word) { return std::ranges::find(dbc_keywords, word) != dbc_keywords.end(); }

struct DbcParser {
    DbcCursor at;
    DbcStatements result;

    void run();
    void statement(const std::string& keyword);
    void namespace_list();
    void bit_timing();
    void nodes();
    void message();
    void signal(DbcMessage& message);
    void multiplexing(DbcSignal& signal);
    DbcObject object();
    DbcObject message_object();
    DbcObject signal_object();
    void senders();
    void comment();
    void definition();
    void default_value();
    void attribute();
    DbcLabelList label_list();
    void labels();
    void multiplexed_ranges();
    void value_type();
    void end(const char* what);
    void note(std::size_t line, const std::string& text) { result.notes.push_back(fmt::format("line {}: {}", line, text)); }
};

// Many tools leave out the semicolon at an end of line, and all understand it.
void DbcParser::end(const char* what) {
    if (at.line_goes_on() && !at.take(';'))
        at.refuse(fmt::format("';' behind {}", what));
}

void DbcParser::run() {
    while (!at.at_end()) {
        if (at.take(';')) // one too many
            continue;
        const std::string keyword(at.peek());
        if (!dbc_keyword(keyword)) {
            const std::string near = nearest_name(keyword, dbc_keywords);
            at.refuse(near.empty() ? "a statement as BO_, SG_, CM_ ..." : fmt::format("a statement, {} perhaps", near));
        }
        statement(at.word("a statement"));
    }
}

void DbcParser::statement(const std::string& keyword) {
    if (keyword == "VERSION") {
        result.version = at.text("a text in quotes behind VERSION");
        at.take(';');
    } else if (keyword == "NS_")
        namespace_list();
    else if (keyword == "BS_")
        bit_timing();
    else if (keyword == "BU_")
        nodes();
    else if (keyword == "BO_")
        message();
    else if (keyword == "SG_") {
        if (result.messages.empty())
            at.refuse_at(at.line(), "a signal (SG_) before the first message", "BO_");
        signal(result.messages.back());
    } else if (keyword == "BO_TX_BU_")
        senders();
    else if (keyword == "CM_")
        comment();
    else if (keyword == "BA_DEF_")
        definition();
    else if (keyword == "BA_DEF_DEF_")
        default_value();
    else if (keyword == "BA_")
        attribute();
    else if (keyword == "VAL_TABLE_") {
        const std::string name = at.word("a name of a value table");
        result.tables[name] = label_list();
        end("the value table");
    } else if (keyword == "VAL_")
        labels();
    else if (keyword == "SG_MUL_VAL_")
        multiplexed_ranges();
    else if (keyword == "SIG_VALTYPE_")
        value_type();
    else {
        if (keyword == "SIG_TYPE_REF_")
            note(at.line(), "SIG_TYPE_REF_ is not used: the signal stays as its SG_ says");
        at.skip_past(';');
    }
}

// Keywords that the file may use, up to the statement that follows by the book.
void DbcParser::namespace_list() {
    at.expect(':', "behind NS_");
    while (!at.at_end()) {
        const std::string_view next = at.peek();
        if (next == "BS_" || next == "BU_" || next == "BO_" || next == "VERSION")
            return;
        if (next.empty())
            at.refuse("BS_: or BU_: behind the keywords of NS_");
        at.word("a keyword");
    }
}

// "BS_:" or "BS_: 500 : 1,2"
void DbcParser::bit_timing() {
    at.expect(':', "behind BS_");
    while (at.has_number() || at.has(':') || at.has(',')) {
        if (at.has_number())
            at.number("a bit rate or timing");
        else if (!at.take(':'))
            at.take(',');
    }
    at.take(';');
}

void DbcParser::nodes() {
    at.expect(':', "behind BU_");
    std::size_t line = at.line(); // of the name before
    bool begins_line = false;     // it does
    while (!at.at_end() && !dbc_keyword(at.peek())) {
        if (at.take(',') || at.take(';'))
            continue;
        if (begins_line && (at.has_number() || at.has_text())) // no name of a node, but a statement whose keyword is misspelt
            if (const std::string near = nearest_name(result.nodes.back(), dbc_keywords); !near.empty())
                at.refuse_at(line, fmt::format("'{}'", printable(result.nodes.back())), fmt::format("a statement, {} perhaps", near));
        result.nodes.push_back(at.word("names of nodes"));
        begins_line = at.line() != line;
        line = at.line();
    }
}

void DbcParser::message() {
    DbcMessage read;
    read.line = at.line();
    read.id = static_cast<std::uint32_t>(at.whole("an identifier of a message", any_dbc_id));
    read.line = at.line();
    read.message.name = at.word("a name of a message");
    at.expect(':', "behind the message's name");
    read.message.length = static_cast<std::uint16_t>(at.whole("a length in bytes", 65535));
    if (at.line_goes_on() && !dbc_keyword(at.peek())) {
        const std::string sender = at.word("a sender");
        if (sender != "Vector__XXX")
            read.message.senders.push_back(sender);
    }
    at.take(';');
    result.messages.push_back(std::move(read));
}

// "", "M", "m3", "m3M"; vw_pq of opendbc has "m" for a multiplexor
void DbcParser::multiplexing(DbcSignal& read) {
    if (at.has(':'))
        return;
    const std::string word = at.word("M, m0, m0M ... or ':'");
    std::string_view rest = word;
    if (rest.starts_with('m')) {
        rest.remove_prefix(1);
        if (rest.ends_with('M')) {
            read.signal.multiplexor = true;
            rest.remove_suffix(1);
        }
        if (rest.empty())
            return note(read.line, fmt::format("'{}' of {} has no number", word, printable(read.signal.name)));
        std::uint64_t value = 0;
        for (const char c : rest) {
            if (c < '0' || c > '9' || value > (any_dbc_whole - 9) / 10)
                at.refuse_at(read.line, fmt::format("'{}'", printable(word)), "M, m0, m0M ... or ':' behind the signal's name");
            value = value * 10 + static_cast<std::uint64_t>(c - '0');
        }
        read.when = value;
    } else if (rest == "M")
        read.signal.multiplexor = true;
    else
        at.refuse_at(read.line, fmt::format("'{}'", printable(word)), "M, m0, m0M ... or ':' behind the signal's name");
}

// SG_ Name m0 : 7|16@0- (0.1,-40) [0|100] "unit" Receiver,Receiver
void DbcParser::signal(DbcMessage& message) {
    DbcSignal read;
    CanSignal& signal = read.signal;
    read.line = at.line();
    signal.name = at.word("a name of a signal");
    read.line = at.line();
    multiplexing(read);
    at.expect(':', "behind the signal's name");
    signal.start_bit = static_cast<std::uint16_t>(at.whole("a start bit", 65535));
    at.expect('|', "behind the start bit");
    signal.length = static_cast<std::uint16_t>(at.whole("a length in bits", 65535));
    at.expect('@', "behind the length in bits");
    signal.big_endian = at.whole("a byte order: 0 = Motorola, 1 = Intel", 1) == 0;
    const std::string sign = at.word("a sign: + or -");
    if (sign != "+" && sign != "-")
        at.refuse_at(read.line, fmt::format("'{}'", printable(sign)), "a sign: + or -");
    signal.is_signed = sign == "-";
    at.expect('(', "before factor and offset");
    signal.factor = at.number("a factor");
    at.expect(',', "between factor and offset");
    signal.offset = at.number("an offset");
    at.expect(')', "behind factor and offset");
    at.expect('[', "before the limits");
    signal.minimum = at.number("a lower limit");
    at.expect('|', "between the limits");
    signal.maximum = at.number("an upper limit");
    at.expect(']', "behind the limits");
    signal.unit = at.text("a unit in quotes");
    for (bool more = at.line_goes_on(); more && !dbc_keyword(at.peek());) {
        if (at.take(';'))
            break;
        const std::string receiver = at.word("a receiver");
        if (receiver != "Vector__XXX")
            signal.receivers.push_back(receiver);
        more = at.line_goes_on();
        if (more && at.take(','))
            at.peek(); // a list may go on in the next line
    }
    message.signals.push_back(std::move(read));
}

DbcObject DbcParser::message_object() {
    DbcObject on{DbcObject::Kind::message, 0, {}, at.line()};
    on.id = static_cast<std::uint32_t>(at.whole("an identifier of a message", any_dbc_id));
    on.line = at.line();
    return on;
}

DbcObject DbcParser::signal_object() {
    DbcObject on = message_object();
    on.kind = DbcObject::Kind::signal;
    on.name = at.word("a name of a signal");
    return on;
}

// What stands before the value of a comment or an attribute: nothing, BU_ Node, BO_ 12, SG_ 12 Signal, EV_ Variable
DbcObject DbcParser::object() {
    const std::string_view next = at.peek();
    DbcObject on{DbcObject::Kind::network, 0, {}, at.line()};
    if (next != "BU_" && next != "BO_" && next != "SG_" && next != "EV_")
        return on;
    const std::string kind = at.word("a kind of object");
    if (kind == "BO_")
        return message_object();
    if (kind == "SG_")
        return signal_object();
    on.kind = kind == "BU_" ? DbcObject::Kind::node : DbcObject::Kind::variable;
    on.name = at.word(kind == "BU_" ? "a name of a node" : "a name of a variable");
    return on;
}

void DbcParser::senders() {
    DbcSenders read{message_object(), {}};
    at.take(':');
    while (!at.has(';') && !at.at_end() && !dbc_keyword(at.peek())) {
        if (at.take(','))
            continue;
        read.names.push_back(at.word("senders"));
    }
    at.take(';');
    result.senders.push_back(std::move(read));
}

void DbcParser::comment() {
    DbcComment read{object(), {}};
    read.text = at.text("a comment in quotes, or BU_, BO_, SG_, EV_");
    end("the comment");
    result.comments.push_back(std::move(read));
}

// BA_DEF_ BO_ "Name" INT 0 100;
void DbcParser::definition() {
    DbcAttributeDefinition read;
    const std::string_view kind = at.peek();
    if (kind == "BU_" || kind == "BO_" || kind == "SG_" || kind == "EV_") {
        read.kind = kind == "BU_"   ? DbcObject::Kind::node
                    : kind == "BO_" ? DbcObject::Kind::message
                    : kind == "SG_" ? DbcObject::Kind::signal
                                    : DbcObject::Kind::variable;
        at.word("a kind");
    }
    const std::string name = at.text("a name of an attribute in quotes");
    read.type = at.word("INT, HEX, FLOAT, STRING or ENUM");
    if (read.type == "ENUM") {
        while (at.has_text()) {
            read.choices.push_back(at.text("a choice"));
            at.take(',');
        }
    } else if (read.type == "INT" || read.type == "HEX" || read.type == "FLOAT") {
        while (at.has_number())
            at.number("a limit of the attribute");
    } else if (read.type != "STRING")
        at.refuse_at(at.line(), fmt::format("'{}'", printable(read.type)), "INT, HEX, FLOAT, STRING or ENUM");
    end("the attribute's definition");
    result.definitions[name] = std::move(read);
}

void DbcParser::default_value() {
    const std::string name = at.text("a name of an attribute in quotes");
    if (at.has_text())
        result.defaults[name] = at.text("a text");
    else if (at.has_number())
        result.defaults[name] = fmt::format("{}", at.number("a number or a text in quotes"));
    else if (!at.has(';'))
        at.refuse("a number or a text in quotes");
    end("the attribute's default");
}

// BA_ "Name" SG_ 12 Signal 5;
void DbcParser::attribute() {
    DbcAttribute read;
    read.name = at.text("a name of an attribute in quotes");
    read.on = object();
    read.quoted = at.has_text();
    if (read.quoted)
        read.value = at.text("a text");
    else if (at.has_number())
        read.value = fmt::format("{}", at.number("a number or a text in quotes"));
    else
        at.refuse("a number or a text in quotes");
    end("the attribute");
    result.attributes.push_back(std::move(read));
}

DbcLabelList DbcParser::label_list() {
    DbcLabelList list;
    while (at.has_number()) {
        const std::size_t line = at.line();
        std::string number = at.number_as_written("a number before a text in quotes");
        std::string text = at.text("a text in quotes behind the number");
        if (list.size() > 65535)
            at.refuse_at(line, "more than 65536 labels", "fewer");
        list.emplace_back(std::move(number), std::move(text));
    }
    return list;
}

// VAL_ 12 Signal 1 "On" 0 "Off" ; or of an environment variable: VAL_ Variable 1 "On" ...
void DbcParser::labels() {
    DbcLabels read;
    if (at.has_number())
        read.on = signal_object();
    else {
        read.on = {DbcObject::Kind::variable, 0, {}, at.line()};
        read.on.name = at.word("an identifier of a message or a name of a variable");
    }
    if (!at.has_number() && !at.has(';') && at.line_goes_on()) { // name of a table, as some tools write
        const std::string table = at.word("pairs of a number and a text in quotes");
        const auto found = result.tables.find(table);
        if (found == result.tables.end())
            at.refuse_at(at.line(), fmt::format("'{}'", printable(table)), "pairs of a number and a text in quotes");
        read.labels = found->second;
    } else
        read.labels = label_list();
    end("the values' texts");
    result.labels.push_back(std::move(read));
}

// SG_MUL_VAL_ 12 Signal Multiplexor 0-0, 3-5;
void DbcParser::multiplexed_ranges() {
    DbcMultiplexing read{signal_object(), {}, {}};
    read.multiplexor = at.word("a name of a multiplexor");
    do {
        const std::uint64_t first = at.whole("a range of the multiplexor's values", any_dbc_whole);
        at.expect('-', "between the range's ends");
        const std::uint64_t last = at.whole("a range of the multiplexor's values", any_dbc_whole);
        if (last < first)
            at.refuse_at(at.line(), fmt::format("the range {}-{}", first, last), "the smaller value first");
        read.when.emplace_back(first, last);
    } while (at.take(','));
    end("the multiplexor's values");
    result.multiplexing.push_back(std::move(read));
}

// SIG_VALTYPE_ 12 Signal : 1;
void DbcParser::value_type() {
    DbcValueType read{signal_object(), 0};
    at.take(':');
    read.type = at.whole("0 = whole number, 1 = float, 2 = double", 2);
    end("the signal's type");
    result.value_types.push_back(std::move(read));
}

} // namespace

DbcStatements parse_dbc(const std::string& text, const std::filesystem::path& file) {
    DbcParser parser{DbcCursor(text, file), {}};
    parser.run();
    return std::move(parser.result);
}

} // namespace fernlicht
