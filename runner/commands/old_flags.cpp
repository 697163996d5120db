#include "runner/commands/old_flags.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct OldFlag {
    const char *command, *old, *now; ///< command: "" for all
};

constexpr OldFlag old_flags[] = {{"", "references", "baselines"},
                                 {"", "--variant", "--lamp-set"},
                                 {"", "--references", "--baselines"},
                                 {"accept", "--to", "--baselines"},
                                 {"accept", "--store", "--baselines"},
                                 {"baselines", "--store", "--baselines"},
                                 {"references", "--store", "--baselines"},
                                 {"accuracy", "--moments", "--count"},
                                 {"accuracy", "--samples", "--max-samples"},
                                 {"shadows", "--moments", "--count"},
                                 {"bench", "--frames", "--count"},
                                 {"bench", "--drive", "FILE alone"},
                                 {"reference", "--most-samples", "--max-samples"}};

} // namespace

std::string old_word_in(const std::vector<std::string>& command_line) {
    for (std::size_t i = 1; i < command_line.size(); ++i) {
        const std::string word = command_line[i].substr(0, command_line[i].find('='));
        if (i > 1 && !word.starts_with("--"))
            continue;
        const auto known = std::ranges::find_if(
            old_flags, [&](const OldFlag& flag) { return flag.old == word && (*flag.command == '\0' || flag.command == command_line[1]); });
        if (known != std::end(old_flags))
            return fmt::format("found '{}' of version 0.1, expected {} (`fernlicht migrate` converts files)", word, known->now);
    }
    return {};
}

} // namespace fernlicht
