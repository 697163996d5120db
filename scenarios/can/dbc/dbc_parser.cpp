#include "scenarios/can/dbc/dbc_cursor.h"
#include "scenarios/can/dbc/dbc_statements.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <sstream>

namespace fernlicht {
namespace {

constexpr std::uint64_t any_dbc_id = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t any_dbc_whole = std::numeric_limits<std::uint64_t>::max();

/// What may begin a statement.
const std::vector<std::string>& dbc_keywords() {
    static const std::vector<std::string> keywords = [] {
        std::istringstream words("VERSION NS_ BS_ BU_ VAL_TABLE_ BO_ SG_ BO_TX_BU_ EV_ ENVVAR_DATA_ EV_DATA_ SGTYPE_ SGTYPE_VAL_ "
                                 "SIG_TYPE_REF_ SIG_GROUP_ CM_ BA_DEF_ BA_DEF_SGTYPE_ BA_SGTYPE_ BA_DEF_REL_ BA_DEF_DEF_ BA_DEF_DEF_REL_ "
                                 "BA_ BA_REL_ BA_DEF_DEF_SGTYPE_ VAL_ SIG_VALTYPE_ SIGTYPE_VALTYPE_ SG_MUL_VAL_ CAT_DEF_ CAT_ FILTER "
                                 "NS_DESC_");
        return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
    }();
    return keywords;
}

bool dbc_keyword(std::string_view word) { return std::ranges::find(dbc_keywords(), word) != dbc_keywords().end(); }

std::string nearest_keyword(const std::string& word) {
    const std::string near = nearest_name(word, dbc_keywords());
    return near.empty() ? "" : fmt::format("a statement, {} perhaps", near);
}

class DbcParser {
  public:
    DbcParser(const std::string& text, const std::filesystem::path& file) : at(text, file) {}

    DbcStatements run() {
        while (!at.at_end()) {
            if (at.take(';')) // one too many
                continue;
            const std::string keyword(at.peek());
            if (!dbc_keyword(keyword)) {
                const std::string near = nearest_keyword(keyword);
                at.refuse(near.empty() ? "a statement as BO_, SG_, CM_ ..." : near);
            }
            at.word("a statement");
            statement(keyword);
        }
        return std::move(result);
    }

  private:
    /// Those without a reader are taken up to their semicolon and say nothing about frames.
    void statement(const std::string& keyword) {
        static const std::map<std::string_view, void (DbcParser::*)()> readers{{"VERSION", &DbcParser::version},
                                                                               {"NS_", &DbcParser::namespace_list},
                                                                               {"BS_", &DbcParser::bit_timing},
                                                                               {"BU_", &DbcParser::nodes},
                                                                               {"BO_", &DbcParser::message},
                                                                               {"SG_", &DbcParser::signal},
                                                                               {"BO_TX_BU_", &DbcParser::senders},
                                                                               {"CM_", &DbcParser::comment},
                                                                               {"BA_DEF_", &DbcParser::definition},
                                                                               {"BA_DEF_DEF_", &DbcParser::default_value},
                                                                               {"BA_", &DbcParser::attribute},
                                                                               {"VAL_TABLE_", &DbcParser::table},
                                                                               {"VAL_", &DbcParser::labels},
                                                                               {"SG_MUL_VAL_", &DbcParser::multiplexed_ranges},
                                                                               {"SIG_VALTYPE_", &DbcParser::value_type},
                                                                               {"SIG_TYPE_REF_", &DbcParser::type_reference}};
        const auto reader = readers.find(keyword);
        reader == readers.end() ? at.skip_past(';') : (this->*reader->second)();
    }

    void note(std::size_t line, const std::string& text) { result.notes.push_back(fmt::format("line {}: {}", line, text)); }

    /// Many tools leave out the semicolon at an end of line, and all understand it.
    void end(const char* what) {
        if (at.line_goes_on() && !at.take(';'))
            at.refuse(fmt::format("';' behind {}", what));
    }

    void version() {
        at.text("a text in quotes behind VERSION");
        at.take(';');
    }

    void type_reference() {
        note(at.line(), "SIG_TYPE_REF_ is not used: the signal stays as its SG_ says");
        at.skip_past(';');
    }

    /// Keywords that the file may use, up to the statement that follows by the book.
    void namespace_list() {
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

    /// "BS_:" or "BS_: 500 : 1,2"
    void bit_timing() {
        at.expect(':', "behind BS_");
        while (at.has_number() || at.has(':') || at.has(',')) {
            if (at.has_number())
                at.number("a bit rate or timing");
            else if (!at.take(':'))
                at.take(',');
        }
        at.take(';');
    }

    void nodes() {
        at.expect(':', "behind BU_");
        std::string name;             // the one before
        std::size_t line = at.line(); // of it
        bool begins_line = false;     // it does
        while (!at.at_end() && !dbc_keyword(at.peek())) {
            if (at.take(',') || at.take(';'))
                continue;
            if (begins_line && (at.has_number() || at.has_text())) // no name of a node, but a statement whose keyword is misspelt
                if (const std::string near = nearest_keyword(name); !near.empty())
                    at.refuse_at(line, fmt::format("'{}'", printable(name)), near);
            name = at.word("names of nodes");
            begins_line = at.line() != line;
            line = at.line();
        }
    }

    void message() {
        DbcMessage read;
        read.id = static_cast<std::uint32_t>(at.whole("an identifier of a message", any_dbc_id));
        read.line = at.line();
        read.message.name = at.word("a name of a message");
        at.expect(':', "behind the message's name");
        read.message.length = static_cast<std::uint16_t>(at.whole("a length in bytes", 65535));
        if (at.line_goes_on() && !dbc_keyword(at.peek()))
            at.word("a sender");
        at.take(';');
        result.messages.push_back(std::move(read));
    }

    /// "", "M", "m3", "m3M"; vw_pq of opendbc has "m" for a multiplexor
    void multiplexing(DbcSignal& read) {
        if (at.has(':'))
            return;
        const std::string word = at.word("M, m0, m0M ... or ':'");
        const auto refuse = [&] {
            at.refuse_at(read.line, fmt::format("'{}'", printable(word)), "M, m0, m0M ... or ':' behind the signal's name");
        };
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
                    refuse();
                value = value * 10 + static_cast<std::uint64_t>(c - '0');
            }
            read.when = value;
        } else if (rest == "M")
            read.signal.multiplexor = true;
        else
            refuse();
    }

    /// SG_ Name m0 : 7|16@0- (0.1,-40) [0|100] "unit" Receiver,Receiver
    void signal() {
        if (result.messages.empty())
            at.refuse_at(at.line(), "a signal (SG_) before the first message", "BO_");
        DbcSignal read;
        CanSignal& signal = read.signal;
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
            at.word("a receiver");
            more = at.line_goes_on();
            if (more && at.take(','))
                at.peek(); // a list may go on in the next line
        }
        result.messages.back().signals.push_back(std::move(read));
    }

    DbcObject message_object() {
        DbcObject on{DbcObject::Kind::message, 0, {}, 0};
        on.id = static_cast<std::uint32_t>(at.whole("an identifier of a message", any_dbc_id));
        on.line = at.line();
        return on;
    }

    DbcObject signal_object() {
        DbcObject on = message_object();
        on.kind = DbcObject::Kind::signal;
        on.name = at.word("a name of a signal");
        return on;
    }

    /// What stands before the value of a comment or an attribute: nothing, BU_ Node, BO_ 12, SG_ 12 Signal, EV_ Variable
    DbcObject object() {
        const std::string next(at.peek());
        DbcObject on{DbcObject::Kind::other, 0, {}, at.line()};
        if (next != "BU_" && next != "BO_" && next != "SG_" && next != "EV_")
            return on;
        at.word("a kind of object");
        if (next == "BO_")
            return message_object();
        if (next == "SG_")
            return signal_object();
        at.word(next == "BU_" ? "a name of a node" : "a name of a variable");
        return on;
    }

    void senders() {
        message_object();
        at.take(':');
        while (!at.has(';') && !at.at_end() && !dbc_keyword(at.peek()))
            if (!at.take(','))
                at.word("senders");
        at.take(';');
    }

    void comment() {
        object();
        at.text("a comment in quotes, or BU_, BO_, SG_, EV_");
        end("the comment");
    }

    /// BA_DEF_ BO_ "Name" INT 0 100;
    void definition() {
        const std::string_view kind = at.peek();
        if (kind == "BU_" || kind == "BO_" || kind == "SG_" || kind == "EV_")
            at.word("a kind");
        std::vector<std::string>& choices = result.choices[at.text("a name of an attribute in quotes")];
        choices.clear();
        const std::string type = at.word("INT, HEX, FLOAT, STRING or ENUM");
        if (type == "ENUM") {
            while (at.has_text()) {
                choices.push_back(at.text("a choice"));
                at.take(',');
            }
        } else if (type == "INT" || type == "HEX" || type == "FLOAT") {
            while (at.has_number())
                at.number("a limit of the attribute");
        } else if (type != "STRING")
            at.refuse_at(at.line(), fmt::format("'{}'", printable(type)), "INT, HEX, FLOAT, STRING or ENUM");
        end("the attribute's definition");
    }

    void default_value() {
        const std::string name = at.text("a name of an attribute in quotes");
        if (!at.has(';'))
            result.defaults[name] = value();
        end("the attribute's default");
    }

    std::string value() {
        if (at.has_text())
            return at.text("a text");
        if (!at.has_number())
            at.refuse("a number or a text in quotes");
        return fmt::format("{}", at.number("a number or a text in quotes"));
    }

    /// BA_ "Name" SG_ 12 Signal 5;
    void attribute() {
        DbcAttribute read;
        read.name = at.text("a name of an attribute in quotes");
        read.on = object();
        read.quoted = at.has_text();
        read.value = value();
        end("the attribute");
        result.attributes.push_back(std::move(read));
    }

    DbcLabelList label_list() {
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

    void table() {
        const std::string name = at.word("a name of a value table");
        tables[name] = label_list();
        end("the value table");
    }

    /// VAL_ 12 Signal 1 "On" 0 "Off" ; or of an environment variable: VAL_ Variable 1 "On" ...
    void labels() {
        DbcObject on;
        DbcLabelList read;
        if (at.has_number())
            on = signal_object();
        else
            at.word("an identifier of a message or a name of a variable");
        if (!at.has_number() && !at.has(';') && at.line_goes_on()) { // name of a table, as some tools write
            const std::string name = at.word("pairs of a number and a text in quotes");
            const auto found = tables.find(name);
            if (found == tables.end())
                at.refuse_at(at.line(), fmt::format("'{}'", printable(name)), "pairs of a number and a text in quotes");
            read = found->second;
        } else
            read = label_list();
        end("the values' texts");
        if (on.kind == DbcObject::Kind::signal)
            result.labels.emplace_back(std::move(on), std::move(read));
    }

    /// SG_MUL_VAL_ 12 Signal Multiplexor 0-0, 3-5;
    void multiplexed_ranges() {
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

    /// SIG_VALTYPE_ 12 Signal : 1;
    void value_type() {
        DbcObject on = signal_object();
        at.take(':');
        result.value_types.emplace_back(std::move(on), at.whole("0 = whole number, 1 = float, 2 = double", 2));
        end("the signal's type");
    }

    DbcCursor at;
    DbcStatements result;
    std::map<std::string, DbcLabelList> tables;
};

} // namespace

DbcStatements parse_dbc(const std::string& text, const std::filesystem::path& file) { return DbcParser(text, file).run(); }

} // namespace fernlicht
