// What the program says while it works and when it fails: on standard error, as sentences for people or a JSON object a line for programs.
// What it found is no message: that goes to standard output.
#pragma once

#include "scenarios/values/errors.h"

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace fernlicht {

enum class LogLevel { error, warning, info, debug };

/// Of the process; set by flags before anything is said.
struct LogSettings {
    LogLevel level = LogLevel::info; ///< and what weighs more
    bool json = false;               ///< {"time": "2026-11-26T09:12:00.250Z", "level": "info", "message": ..., and a message's own fields}
    bool github = false;             ///< annotate() writes workflow commands
};
LogSettings& log_settings();
inline bool is_told(LogLevel level) { return level <= log_settings().level; }

using LogFields = std::vector<std::pair<const char*, std::variant<std::int64_t, double, std::string>>>;

/// One line. For people errors and warnings begin with "fernlicht: "; `fields` are for programs alone, whose message says the same.
void tell(LogLevel level, const std::string& message, const LogFields& fields = {});

/// What ends the program, as an error and as an annotation; fields `exit_code`, and of an InputError `file`, `line`, `column`, `key`.
void tell_end(const std::exception& error, int exit_code);

/// Something red, at a place in a user's file as far as it is known, for the pages of a CI server; nothing unless the settings ask for it.
/// `::error file=...,line=...,title=...::message`, which GitHub's runner takes from standard error, too.
void annotate(const InputError::Where& where, const std::string& title, const std::string& message);

} // namespace fernlicht
