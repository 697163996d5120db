#include "runner/commands/words/old_flags.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct OldFlag {
    const char *command, *old, *now; ///< command: "" for all
};

constexpr OldFlag of_version_0_1[] = {{"", "references", "baselines"},
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

/// Names that meant another thing in another command, or that one thing had beside another.
constexpr OldFlag renamed[] = {{"accept", "--add", "--also"},
                               {"aliasing", "--against", "--supersampled"},
                               {"aliasing", "--filter", "--texture-filters"},
                               {"aliasing", "--picture", "--values"},
                               {"aliasing", "--view-fov", "--vertical-fov"},
                               {"can decode", "--known", "--skip-unknown"},
                               {"can merge", "--channel", "--rename-channel"},
                               {"can record", "--start", "--can-start"},
                               {"compare", "--lamps", "--as-lamps"},
                               {"compare", "--view-fov", "--vertical-fov"},
                               {"film", "--lamp-set", "--lamp-sets"},
                               {"history prune", "--keep", "--keep-nights"},
                               {"history trend", "--cells", "--only"},
                               {"importance", "--check", "--trials"},
                               {"improve", "--floor", "--floor-cd"},
                               {"improve", "--study", "--cells-of"},
                               {"lamp", "--aim", "--aim-rule"},
                               {"lamp", "--model", "--lamp-model"},
                               {"masks", "--against", "--full-light"},
                               {"masks", "--limits", "--rating"},
                               {"model", "--lamp", "--low-beams"},
                               {"model", "--scale", "--metres-per-unit"},
                               {"shadows", "--floor", "--floor-lx"},
                               {"shadows", "--lamp", "--scene-lamp"},
                               {"shadows", "--map-texels", "--shadow-map"},
                               {"storyboard", "--quiet", "--brief"}};

} // namespace

std::string old_word_in(const std::vector<std::string>& command_line) {
    for (std::size_t i = 1; i < command_line.size(); ++i) {
        const std::string word = command_line[i].substr(0, command_line[i].find('='));
        if (i > 1 && !word.starts_with("--"))
            continue;
        const auto is_meant = [&](const OldFlag& flag) {
            const std::string command = flag.command, here = command_line[1] + (command_line.size() > 2 ? " " + command_line[2] : "");
            return flag.old == word && (command.empty() || command == command_line[1] || command == here);
        };
        if (const auto known = std::ranges::find_if(of_version_0_1, is_meant); known != std::end(of_version_0_1))
            return fmt::format("found '{}' of version 0.1, expected {} (`fernlicht migrate` converts files)", word, known->now);
        if (const auto known = std::ranges::find_if(renamed, is_meant); known != std::end(renamed))
            return fmt::format("found '{}', expected {}, as it is called now", word, known->now);
    }
    return {};
}

} // namespace fernlicht
