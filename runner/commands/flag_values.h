// Values of command-line flags that are more than a word.
#pragma once

#include "runner/write/document.h"
#include "scenarios/lamps/beam_texels.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// Throws InputError naming the flag.
[[noreturn]] void refuse_flag(const char* flag, const std::string& found, const char* expected);

/// Two whole numbers from 0 up with a separator: "1024x768", "0:59". Either may be missing where `open` says so (-1).
/// Throws InputError naming the flag.
std::pair<int, int> two_numbers(const char* flag, const std::string& text, char separator, bool open, const char* expected);

/// The items of "a,b" and of a flag given several times, in order. Throws InputError naming the flag for an item that is empty.
std::vector<std::string> items_of(const char* flag, const std::vector<std::string>& lists);

/// "1024x768", sides from 1 to largest_view_px. Throws InputError naming --resolution.
std::pair<int, int> resolution_of(const std::string& text);

/// A share above 0 and up to 1: "0.5%" and "0.005" are the same. Throws InputError naming the flag.
double share_of(const char* flag, const std::string& text);

/// "float" (nullopt), "eight-bit" or "512x128x8". Throws InputError naming --beams.
std::vector<std::optional<BeamTexels>> beams_of(const std::vector<std::string>& texts);

/// --tables, the same for all commands that write a document.
void add_tables_flag(CLI::App& command, std::string& tables);
/// "csv", "tex" or "". Throws InputError naming --tables.
TableFormat table_format(const std::string& text);

} // namespace fernlicht
