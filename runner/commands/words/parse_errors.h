// Errors of the command line's parser, in the words of this program.
#pragma once

#include "scenarios/values/errors.h"

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace fernlicht {

/// "unknown flag --ouput; did you mean --out?", "--count: found 'abc', expected a whole number from 1 to 1000". `line`: as typed.
InputError in_our_words(const CLI::ParseError& error, const CLI::App& program, const std::vector<std::string>& line);

} // namespace fernlicht
