#include "runner/commands/words/help.h"

#include "runner/commands/words/manual.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <vector>

namespace fernlicht {
namespace {

constexpr std::size_t text_column = 30, last_column = 110;

/// "1000000" for "1e+06".
std::string plain_number(const std::string& text) {
    const double number = std::stod(text);
    return number == std::floor(number) && std::abs(number) < 1e16 ? fmt::format("{:.0f}", number) : text;
}

/// Of a checked number: "1 to 1000"; else "".
std::string range_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find(" in ["), middle = type.find(" - ", begin), end = type.find(']', middle);
    if (begin == std::string::npos || middle == std::string::npos || end == std::string::npos)
        return "";
    return fmt::format("{} to {}", plain_number(type.substr(begin + 5, middle - begin - 5)),
                       plain_number(type.substr(middle + 3, end - middle - 3)));
}

bool is_whole(const CLI::Option& option) { return option.get_type_name().starts_with("INT") || option.get_type_name().starts_with("UINT"); }
bool is_number(const CLI::Option& option) { return is_whole(option) || option.get_type_name().starts_with("FLOAT"); }

/// "  NAMES   TEXT", the text broken between words.
std::string entry(const std::string& names, const std::string& text) {
    std::string out = "  " + names, line;
    out += out.size() < text_column ? std::string(text_column - out.size(), ' ') : "\n" + std::string(text_column, ' ');
    std::size_t column = text_column;
    std::istringstream words(text);
    for (std::string word; words >> word; column += word.size() + 1) {
        if (column > text_column && column + word.size() > last_column) {
            out += "\n" + std::string(text_column, ' ');
            column = text_column;
        } else if (column > text_column)
            out += ' ';
        out += word;
    }
    return out + "\n";
}

class Help : public CLI::Formatter {
  public:
    std::string make_usage(const CLI::App* app, std::string) const override { return "Usage: " + usage(*app) + "\n"; }
    std::string make_option(const CLI::Option* option, bool positional) const override {
        std::string names = positional ? value_name(*option) : option->get_name(false, true);
        if (!positional && takes_value(*option))
            names += " " + value_name(*option);
        return entry(names, meaning(*option));
    }
    std::string make_subcommand(const CLI::App* command) const override { return entry(command->get_name(), command->get_description()); }
};

} // namespace

bool takes_value(const CLI::Option& flag) { return flag.get_items_expected_max() > 0; }

std::string value_name(const CLI::Option& option) {
    if (!option.get_option_text().empty())
        return option.get_option_text();
    const std::vector<std::string> choices = choices_of(option);
    std::string name = option.get_positional() ? option.get_single_name()
                       : !choices.empty()      ? fmt::format("{}", fmt::join(choices, "|"))
                       : is_number(option)     ? "N"
                                               : option.get_type_name();
    if (option.get_expected_max() == CLI::detail::expected_max_vector_size && option.get_positional())
        return name + "...";
    return name;
}

std::string meaning(const CLI::Option& option) {
    std::string text = option.get_description(), more = range_of(option);
    if (takes_value(option) && !option.get_default_str().empty())
        more += (more.empty() ? "default: " : "; default: ") + option.get_default_str();
    if (more.empty())
        return text;
    if (text.ends_with(')') && text.rfind(" (") != std::string::npos) { // one pair of brackets
        text.pop_back();
        return text + "; " + more + ")";
    }
    return text + " (" + more + ")";
}

std::string expected_value(const CLI::Option& option) {
    const std::string range = range_of(option);
    const std::string number = is_whole(option) ? "a whole number" : "a number";
    if (option.get_expected_min() > 1 || !is_number(option))
        return value_name(option);
    return range.empty() ? number : number + " from " + range;
}

std::string usage(const CLI::App& command) {
    std::string line = full_name(command), flags, arguments;
    for (const CLI::Option* option : command.get_options()) {
        const std::string one = option->get_positional() ? value_name(*option) : option->get_name() + " " + value_name(*option);
        if (option->get_positional())
            arguments += option->get_required() ? " " + one : " [" + one + "]";
        else if (option->get_required())
            flags += " " + one;
    }
    const bool has_more = !command.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); }).empty();
    return line + (has_more ? " COMMAND" : "") + " [options]" + arguments + flags;
}

std::shared_ptr<CLI::FormatterBase> help_formatter() { return std::make_shared<Help>(); }

} // namespace fernlicht
