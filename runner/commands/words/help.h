// How --help, man pages and completions word a command's flags: one grammar for all.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
class FormatterBase;
class Option;
} // namespace CLI

namespace fernlicht {

bool takes_value(const CLI::Option& flag);
/// What stands for its value: "FOLDER", "WIDTHxHEIGHT"; N of a number for which nothing is said.
std::string value_name(const CLI::Option& option);
/// What it means, with the range and the default of its value: "number of moments (1 to 1000; default: 3)".
std::string meaning(const CLI::Option& option);
/// What may be given, as an error says it: "a whole number from 1 to 1000", "FILE".
std::string expected_value(const CLI::Option& option);
/// All that the command must have, and what it may have: "fernlicht film [options] DRIVE... --film FILE".
std::string usage(const CLI::App& command);

std::shared_ptr<CLI::FormatterBase> help_formatter();

} // namespace fernlicht
