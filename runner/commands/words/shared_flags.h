// Flags and arguments that several commands have: one name, one value, one sentence for each (shared_flags.cpp).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <type_traits>

namespace fernlicht {

struct SharedFlag {
    const char* name;    ///< "--out", "-o,--out"; of an argument its word here: "DRIVES"
    const char* value;   ///< what stands for its value: "FOLDER", "DRIVE..."; "" of one that takes none
    const char* meaning; ///< as --help says it
};

/// Throws std::logic_error for a name that is not in the table.
const SharedFlag& shared_flag(const std::string& name);
/// As CLI11 takes it: an argument is called as its value.
std::string parser_name(const SharedFlag& flag);

/// Adds it to a command; of a bool it takes no value. What a command takes by default is set by default_str.
template <class Value> CLI::Option* add_shared(CLI::App& command, const std::string& name, Value& value) {
    const SharedFlag& flag = shared_flag(name);
    if constexpr (std::is_same_v<Value, bool>) {
        return command.add_flag(flag.name, value, flag.meaning);
    } else {
        CLI::Option* const option = command.add_option(parser_name(flag), value, flag.meaning)->option_text(flag.value);
        return *flag.name == '-' ? option->allow_extra_args(false) : option; // a flag takes one value each time
    }
}

/// The same, where a function takes the value.
template <class Take> CLI::Option* add_shared_taken(CLI::App& command, const std::string& name, Take take) {
    const SharedFlag& flag = shared_flag(name);
    return command.add_option_function<std::string>(flag.name, take, flag.meaning)->option_text(flag.value);
}

} // namespace fernlicht
