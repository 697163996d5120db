#include "scenarios/can/can_database.h"

#include "scenarios/can/dbc/dbc_meaning.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

// CR LF and CR alone become LF; a line stays a line.
std::string with_unix_line_ends(const std::string& text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\r')
            result += text[i];
        else if (i + 1 == text.size() || text[i + 1] != '\n')
            result += '\n';
    }
    return result;
}

// UTF-8, and a note if a character's meaning hangs on the encoding.
std::string decoded_dbc(const std::string& bytes, const std::filesystem::path& file, std::vector<std::string>& notes) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
        throw InputError({file, 1, 0, {}}, "found UTF-16", "UTF-8 or Windows-1252");
    const auto line_of = [&](std::size_t place) {
        return 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(place), '\n');
    };
    if (const std::size_t zero = bytes.find('\0'); zero != std::string::npos)
        throw InputError({file, static_cast<std::size_t>(line_of(zero)), 0, {}}, "found a zero byte", "the text of a DBC file");
    const bool marked = bytes.starts_with("\xEF\xBB\xBF");
    const auto beyond =
        std::find_if(bytes.begin() + (marked ? 3 : 0), bytes.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
    std::string text = to_utf8(bytes);
    if (beyond != bytes.end()) {
        const std::size_t place = static_cast<std::size_t>(beyond - bytes.begin());
        const bool as_it_was = bytes.compare(marked ? 3 : 0, std::string::npos, text) == 0;
        notes.push_back(fmt::format("line {}: characters beyond ASCII are taken as {}", line_of(place),
                                    as_it_was ? "UTF-8" : "Windows-1252, because they are not UTF-8"));
    }
    return text;
}

} // namespace

const CanSignal* CanMessage::signal(const std::string& wanted) const {
    const auto found = std::ranges::find(signals, wanted, &CanSignal::name);
    return found == signals.end() ? nullptr : &*found;
}

const CanMessage* CanDatabase::message(std::uint32_t id, bool extended) const {
    const auto found =
        std::ranges::find_if(messages, [&](const CanMessage& message) { return message.id == id && message.extended == extended; });
    return found == messages.end() ? nullptr : &*found;
}

const CanMessage* CanDatabase::message(const std::string& name) const {
    const auto found = std::ranges::find(messages, name, &CanMessage::name);
    return found == messages.end() ? nullptr : &*found;
}

CanDatabase read_dbc(const std::filesystem::path& path, FilesRead& opened) {
    DbcReading reading;
    reading.file = path;
    const std::string text = with_unix_line_ends(decoded_dbc(read_file(path, opened, std::size_t{64} << 20), path, reading.notes));
    reading.statements = parse_dbc(text, path);
    reading.notes.insert(reading.notes.end(), reading.statements.notes.begin(), reading.statements.notes.end());
    check_dbc_names(reading);
    apply_dbc_value_types(reading);
    apply_dbc_multiplexing(reading);
    check_dbc_layout(reading);
    CanDatabase database;
    apply_dbc_labels(reading);
    apply_dbc_attributes(reading); // last, because it gives long names
    database.file = path;
    for (DbcMessage& read : reading.statements.messages) {
        for (DbcSignal& signal : read.signals)
            read.message.signals.push_back(std::move(signal.signal));
        database.messages.push_back(std::move(read.message));
    }
    database.notes = std::move(reading.notes);
    return database;
}

} // namespace fernlicht
