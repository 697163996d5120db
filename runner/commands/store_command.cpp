#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/json_text.h"
#include "runner/findings/figures.h"
#include "runner/store/store_upkeep.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

struct StoreFlags {
    std::string store, study, older_than, at_most;
    bool dry = false, json = false;
};

CellStore store_of(const StoreFlags& flags) {
    const std::filesystem::path folder = flags.store.empty() ? default_store() : std::filesystem::path(flags.store);
    std::error_code ignored;
    CellStore store(folder);
    if (!std::filesystem::is_regular_file(store.mark(), ignored))
        throw InputError({folder, 0, 0, "--store"}, "is no store of cells", "one that `fernlicht study` made");
    return store;
}

/// A number and one of the units; throws InputError naming the flag.
double number_with_unit(const char* flag, const std::string& text, const std::vector<std::pair<std::string, double>>& units,
                        const char* expected) {
    for (const auto& [unit, factor] : units)
        if (text.size() > unit.size() && text.ends_with(unit)) {
            std::size_t used = 0;
            try {
                const double number = std::stod(text, &used);
                if (used == text.size() - unit.size() && std::isfinite(number) && number >= 0.0)
                    return number * factor;
            } catch (const std::logic_error&) { // no number
            }
        }
    refuse_flag(flag, text, expected);
}

std::string size_text(std::uint64_t bytes) {
    const double mib = static_cast<double>(bytes) / 1048576.0;
    return mib >= 1024.0 ? fmt::format("{:.1f} GiB", mib / 1024.0) : fmt::format("{:.1f} MiB", mib);
}

int list_store(const StoreFlags& flags) {
    std::uint64_t bytes = 0;
    std::size_t count = 0;
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (const StoredCell& cell : store_of(flags).list()) {
        if (!flags.study.empty() && !matches(flags.study, cell.study))
            continue;
        const std::tm used = fmt::gmtime(static_cast<std::time_t>(cell.used_s));
        if (flags.json) {
            cells.push_back({{"key", cell.key},
                             {"used_utc", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", used)},
                             {"bytes", cell.bytes},
                             {"study", cell.study},
                             {"cell", cell.cell}});
            continue;
        }
        fmt::print("{}  {:%Y-%m-%dT%H:%M:%SZ}  {:>9}  {:<24} {}\n", cell.key.substr(0, 12), used, size_text(cell.bytes),
                   printable(cell.study), printable(cell.cell));
        bytes += cell.bytes;
        ++count;
    }
    if (flags.json)
        fmt::print("{}", json_text(cells));
    else
        fmt::print("{}, {}\n", counted(count, "cell"), size_text(bytes));
    return 0;
}

int verify(const StoreFlags& flags) {
    const std::vector<StoreDamage> damage = verify_store(store_of(flags));
    if (flags.json) {
        nlohmann::ordered_json removed = nlohmann::ordered_json::array();
        for (const StoreDamage& one : damage)
            removed.push_back({{"what", one.what}, {"why", one.why}});
        fmt::print("{}", json_text({{"removed", removed}}));
        return damage.empty() ? 0 : 1;
    }
    for (const StoreDamage& one : damage)
        fmt::print("removed {}: {}\n", one.what, one.why);
    fmt::print("{}\n", damage.empty()
                           ? "nothing is damaged"
                           : fmt::format("{} removed; what was taken out is played again", counted(damage.size(), "damaged part")));
    return damage.empty() ? 0 : 1;
}

int prune(const StoreFlags& flags) {
    if (flags.study.empty() && flags.older_than.empty() && flags.at_most.empty())
        throw InputError({{}, 0, 0, "store prune"}, "found nothing to prune by", "--older-than, --at-most or --study");
    Pruning pruning{{}, {}, flags.study, flags.dry};
    if (!flags.older_than.empty())
        pruning.older_than_s = number_with_unit("--older-than", flags.older_than, {{"d", 86400.0}, {"h", 3600.0}, {"min", 60.0}},
                                                "a number with its unit, d, h or min: 30d");
    if (!flags.at_most.empty())
        pruning.at_most_bytes = static_cast<std::uint64_t>(
            number_with_unit("--at-most", flags.at_most, {{"MiB", 1048576.0}, {"GiB", 1073741824.0}, {"TiB", 1099511627776.0}},
                             "a number of MiB, GiB or TiB: 20GiB"));
    const double now_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const Pruned pruned = prune_store(store_of(flags), pruning, now_s);
    if (flags.json) {
        fmt::print("{}", json_text({{"dry_run", flags.dry},
                                    {"cells", pruned.cells},
                                    {"files", pruned.files},
                                    {"bytes", pruned.bytes},
                                    {"cells_left", pruned.cells_left},
                                    {"bytes_left", pruned.bytes_left}}));
        return 0;
    }
    fmt::print("{}{} and {}, {}; {} left, {}\n", flags.dry ? "would remove " : "removed ", counted(pruned.cells, "cell"),
               counted(pruned.files, "file"), size_text(pruned.bytes), counted(pruned.cells_left, "cell"), size_text(pruned.bytes_left));
    return 0;
}

} // namespace

void add_store_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<StoreFlags>();
    CLI::App* store = app.add_subcommand("store", "list, verify and prune the cells that studies keep");
    store->require_subcommand(1);
    const auto add = [&](const char* name, const char* text, int (*does)(const StoreFlags&)) {
        CLI::App* sub = store->add_subcommand(name, text);
        add_shared(*sub, "--store", flags->store);
        add_shared(*sub, "--json", flags->json);
        sub->callback([flags, does, &chosen] { chosen = [flags, does] { return does(*flags); }; });
        return sub;
    };
    CLI::App* list = add("ls", "list cells with when each was last used (UTC), least recently used first", list_store);
    add("verify", "check every cell; take out damaged ones, so that they are played again; exit with 1 if anything was", verify);
    CLI::App* pruned = add("prune", "remove cells, then files that no cell needs", prune);
    for (CLI::App* sub : {list, pruned}) {
        add_shared(*sub, "--study", flags->study)->default_str("all; * and ? allowed");
        sub->footer("A cell belongs to the study that was the first to play it.");
    }
    pruned->add_option("--older-than", flags->older_than, "remove cells last used longer ago than this: 30d, 12h or 90min")
        ->option_text("AGE");
    pruned->add_option("--at-most", flags->at_most, "remove the least recently used cells until at most this much is left: 20GiB")
        ->option_text("SIZE");
    add_shared(*pruned, "--dry-run", flags->dry);
}

} // namespace fernlicht
