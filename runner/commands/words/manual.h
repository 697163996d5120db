// Man pages and completions of shells, out of the commands as CLI11 holds them: what --help says, in other forms.
#pragma once

#include "runner/findings/document.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace fernlicht {

/// Commands directly below, in order, but for hidden ones.
std::vector<const CLI::App*> commands_below(const CLI::App& command);
/// Its words from the program down: "fernlicht can record".
std::string full_name(const CLI::App& command);
/// The words that it takes, where they are listed ("as-is|auto"); else none.
std::vector<std::string> choices_of(const CLI::Option& option);

/// In roff's man macros: of the program, or of a command with all below it. No date, so the same bytes every time.
std::string man_page(const CLI::App& command);

/// The same as a document; what every command takes stands once.
Document commands_document(const CLI::App& program);
Document exit_codes_document();

/// `fernlicht docs`, which writes these and what else the program knows.
void add_docs_command(CLI::App& app, std::function<int()>& chosen);

std::string bash_completions(const CLI::App& program);
std::string zsh_completions(const CLI::App& program);
std::string fish_completions(const CLI::App& program);

} // namespace fernlicht
