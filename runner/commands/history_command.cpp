#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/history/history_document.h"
#include "runner/experiments/history/night_of_study.h"
#include "runner/files/json_text.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/files/page_link.h"
#include "runner/files/value_json.h"
#include "runner/findings/figures.h"
#include "runner/findings/library_versions.h"
#include "runner/findings/run_context.h"
#include "runner/history/history.h"
#include "runner/judge/known_failures.h"
#include "runner/write/document.h"
#include "runner/write/document_json.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>
#include <set>

namespace fernlicht {
namespace {

/// The flags as typed.
struct HistoryFlags {
    std::string history, folder, study, night, reading, note, drift = "0.5%", before, out;
    std::optional<std::size_t> keep;
    const OutputFormat* tables = nullptr;
    bool accept = false, withdraw = false, fails_on_change = false, dry = false, json = false, force = false;
    std::vector<std::string> command, only{"*"};
};

std::filesystem::path file_of(const HistoryFlags& flags) {
    std::filesystem::path file = flags.history.empty() ? default_history_file() : std::filesystem::path(flags.history);
    if (file.empty())
        throw InputError({{}, 0, 0, "--history"}, "found none, and neither XDG_DATA_HOME nor HOME", "a file for the history");
    return file;
}

std::vector<std::string> studies_in(const std::vector<Night>& nights) {
    std::vector<std::string> studies;
    for (const Night& night : nights)
        if (std::ranges::find(studies, night.study) == studies.end())
            studies.push_back(night.study);
    return studies;
}

/// Of the named study, of all where none is named.
std::vector<Night> nights_named(const HistoryFlags& flags) {
    const std::filesystem::path file = file_of(flags);
    std::vector<Night> nights = History(file, History::For::reading).nights();
    if (flags.study.empty() || nights.empty())
        return nights;
    const std::vector<std::string> studies = studies_in(nights);
    if (std::ranges::find(studies, flags.study) == studies.end())
        throw InputError({file, 0, 0, "--study"}, "found '" + printable(flags.study) + "'",
                         fmt::format("one of {}", fmt::join(studies, ", ")));
    std::erase_if(nights, [&](const Night& night) { return night.study != flags.study; });
    return nights;
}

/// Of one study: of the named one, else of that of the night that was added last.
std::vector<Night> nights_of_study(const HistoryFlags& flags) {
    std::vector<Night> nights = nights_named(flags);
    if (nights.empty())
        throw InputError({file_of(flags), 0, 0, {}}, "holds no night", "one; `fernlicht history add FOLDER` adds it");
    const std::string study = nights.back().study;
    std::erase_if(nights, [&](const Night& night) { return night.study != study; });
    return nights;
}

/// By "last", a number, or a date, of which the last night counts.
std::size_t place_of_night(const std::vector<Night>& nights, const std::string& word) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc{} && end == word.data() + word.size();
    for (std::size_t i = nights.size(); i > 0; --i)
        if (word == "last" || (is_number && nights[i - 1].number == number) || nights[i - 1].date() == word ||
            nights[i - 1].played_utc == word)
            return i - 1;
    throw InputError({{}, 0, 0, "NIGHT"}, "found '" + printable(word) + "'",
                     "last, a number or a date that `fernlicht history show` lists");
}

std::size_t readings_in(const Night& night) {
    std::size_t readings = 0;
    for (const NightCell& cell : night.cells)
        readings += cell.readings->size();
    return readings;
}

std::string device_in(const Night& night) {
    std::string device;
    for (const CellInput& input : night.machine)
        if (input.kind == InputKind::device && (input.name == "renderer" || input.name == "CPU class"))
            device += (device.empty() ? "" : ", ") + input.hash;
    return device;
}

int add(const HistoryFlags& flags) {
    if (!flags.note.empty() && !flags.accept)
        throw InputError({{}, 0, 0, "--note"}, "found without --accept", "both, or none");
    const std::filesystem::path file = file_of(flags);
    std::string part;
    const Night night = read_night(flags.folder, &part);
    if (flags.accept && !night.has_readings())
        throw InputError({flags.folder, 0, 0, "--accept"}, "found a night in which no cell was played",
                         "one with readings to compare with");
    History history(file, History::For::collecting);
    const History::Added added = history.add(night);
    if (flags.accept)
        history.accept(added.number, flags.note);
    fmt::print("night {} of {}, {}: {}, {}; {}{} {}\n", added.number, printable(night.study), night.date(),
               counted(night.cells.size(), "cell"), counted(readings_in(night), "reading"), flags.accept ? "accepted; " : "",
               added.is_new ? "added to" : "was there already, as it is, in", file.string());
    if (!part.empty())
        tell(LogLevel::warning, fmt::format("this night played only part of the study. {}.", part));
    return 0;
}

int accept_night(const HistoryFlags& flags) {
    const std::vector<Night> nights = nights_of_study(flags);
    const std::size_t place = place_of_night(nights, flags.night);
    const Night& night = nights[place];
    History history(file_of(flags), History::For::collecting);
    const std::string name = fmt::format("night {} of {}, {}", night.number, printable(night.study), night.date());
    if (flags.withdraw) {
        if (!night.accepted)
            throw InputError({{}, 0, 0, "--withdraw"}, "found " + name + ", which is not accepted",
                             "a night that `fernlicht history show` lists as accepted");
        history.withdraw(night.number);
        fmt::print("{}, is not accepted any more\n", name);
        return 0;
    }
    if (!night.has_readings())
        throw InputError({{}, 0, 0, "NIGHT"}, "found " + name + ", in which no cell was played", "one with readings to compare with");
    history.accept(night.number, flags.note);
    const auto newer = std::find_if(nights.rbegin(), nights.rend() - static_cast<std::ptrdiff_t>(place + 1),
                                    [](const Night& one) { return one.accepted; });
    fmt::print(
        "accepted {}: {}\n", name,
        newer == nights.rend() - static_cast<std::ptrdiff_t>(place + 1)
            ? "later nights are compared with it"
            : fmt::format("nights up to {} are compared with it; night {} is accepted, too, and nights after that one are compared with "
                          "that (`accept --withdraw {}` takes it back)",
                          newer->number, newer->number, newer->number));
    return 0;
}

nlohmann::ordered_json night_json(const Night& night) {
    return {{"night", night.number},       {"played_utc", night.played_utc}, {"study", night.study},
            {"cells", night.cells.size()}, {"readings", readings_in(night)}, {"accepted", night.accepted},
            {"note", night.note},          {"device", device_in(night)},     {"folder", night.folder}};
}

int list_nights(const HistoryFlags& flags) {
    const std::vector<Night> nights = nights_named(flags);
    if (flags.json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const Night& night : nights)
            all.push_back(night_json(night));
        fmt::print("{}", json_text(all));
        return 0;
    }
    if (nights.empty()) {
        fmt::print("no night is in {}\n", file_of(flags).string());
        return 0;
    }
    std::vector<std::vector<std::string>> rows{{"night", "played (UTC)", "study", "cells", "readings", "accepted", "device", "folder"}};
    std::error_code ignored;
    for (const Night& night : nights)
        rows.push_back({fmt::format("{}", night.number), night.played_utc, printable(night.study), fmt::format("{}", night.cells.size()),
                        fmt::format("{}", readings_in(night)),
                        night.accepted ? night.note.empty() ? "yes" : "yes: " + printable(night.note, 80) : "", printable(device_in(night)),
                        std::filesystem::is_directory(night.folder, ignored) ? printable(night.folder, 200)
                                                                             : "gone: " + printable(night.folder, 200)});
    fmt::print("{}", aligned_table(">" + std::string(2, '<') + ">>" + std::string(3, '<'), rows));
    return 0;
}

int show(const HistoryFlags& flags) {
    if (flags.night.empty())
        return list_nights(flags);
    const std::vector<Night> nights = nights_of_study(flags);
    const Night& night = nights[place_of_night(nights, flags.night)];
    if (flags.json) {
        nlohmann::ordered_json all = night_json(night), cells = nlohmann::ordered_json::array();
        for (const NightCell& cell : night.cells) {
            nlohmann::ordered_json readings = nlohmann::ordered_json::object();
            for (const auto& [name, value] : *cell.readings)
                readings[name] = value_json(value);
            cells.push_back({{"name", cell.name},
                             {"failed", cell.failed.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(cell.failed)},
                             {"frame_s", cell.frame_s ? nlohmann::ordered_json(*cell.frame_s) : nlohmann::ordered_json(nullptr)},
                             {"readings", std::move(readings)}});
        }
        all["cells"] = std::move(cells);
        fmt::print("{}", json_text(all));
        return 0;
    }
    std::vector<std::vector<std::string>> facts{
        {"night", fmt::format("{} of {}", night.number, printable(night.study))},
        {"played", night.played_utc},
        {"folder", printable(night.folder, 400)},
        {"accepted", night.accepted ? night.note.empty() ? "yes" : "yes: " + printable(night.note, 200) : "no"}};
    const bool told_below = std::ranges::any_of(night.cells, [](const NightCell& cell) { return !cell.inputs->empty(); });
    for (const CellInput& input : night.machine)
        if (!told_below || input.name == "CPU" || input.name == "system")
            facts.push_back({input.name, printable(input.hash, 200)});
    fmt::print("{}\n", aligned_table("<<", facts));
    std::vector<std::vector<std::string>> rows{{"cell", "readings", "frame, ms"}};
    std::map<CellInput, std::size_t> cells_with; // input
    for (const NightCell& cell : night.cells) {
        for (const CellInput& input : std::set(cell.inputs->begin(), cell.inputs->end()))
            ++cells_with[input];
        rows.push_back({printable(cell.name, 80),
                        !cell.failed.empty()   ? "not played"
                        : cell.inputs->empty() ? fmt::format("{}, inputs not kept", cell.readings->size())
                                               : fmt::format("{}", cell.readings->size()),
                        cell.frame_s ? fmt::format("{:.2f}", 1e3 * *cell.frame_s) : ""});
    }
    fmt::print("{}\n", aligned_table("<>>", rows));
    rows = {{"input", "name", "hash, version", "cells"}};
    for (const auto& [input, cells] : cells_with)
        rows.push_back({input_kind_name(input.kind), printable(input.name, 80),
                        printable(input.kind > InputKind::program ? input.hash : input.hash.substr(0, 12), 80), fmt::format("{}", cells)});
    fmt::print("{}", aligned_table("<<<>", rows));
    return 0;
}

/// The page and its tables where --out asks for them; then the text.
int tell(const HistoryFlags& flags, const Document& told, const HistoryFindings& findings) {
    if (!flags.out.empty()) {
        OutputFolder folder(flags.out);
        write_document(told, findings, folder.path(), "report", flags.tables);
        folder.finish();
    }
    if (flags.json) {
        fmt::print("{}", json_text(document_json(told)));
        return 0;
    }
    fmt::print("{}", document_text(told));
    if (!flags.out.empty())
        fmt::print("\n{}\n", page_link(std::filesystem::path(flags.out) / "report.html"));
    return 0;
}

RunContext context_of(const HistoryFlags& flags) {
    RunContext context;
    context.versions = library_versions();
    context.command = shell_quoted(flags.command);
    return context;
}

int trend(const HistoryFlags& flags) {
    HistoryFindings findings;
    findings.context = context_of(flags);
    return tell(flags, trend_document(nights_of_study(flags), flags.reading, items_of("--only", flags.only)), findings);
}

int explain(const HistoryFlags& flags) {
    std::vector<Night> nights = nights_of_study(flags);
    nights.resize(place_of_night(nights, flags.night.empty() ? "last" : flags.night) + 1);
    HistoryFindings findings = explain_nights(std::move(nights), {.drift_bound = share_of("--drift", flags.drift)});
    if (!findings.ahead.empty())
        fernlicht::tell(LogLevel::warning, clock_warning(findings));
    findings.context = context_of(flags);
    add_frames(findings);
    const int told = tell(flags, document(findings), findings);
    return flags.fails_on_change && findings.is_off_base() ? 1 : told;
}

int prune(const HistoryFlags& flags) {
    if (flags.keep.has_value() == !flags.before.empty())
        throw InputError({{}, 0, 0, "prune"}, flags.keep ? "found --keep-nights and --before" : "found neither --keep-nights nor --before",
                         "one of them");
    if (!flags.before.empty() && !is_date(flags.before))
        refuse_flag("--before", flags.before, "a date, e.g. 2026-01-31");
    const std::filesystem::path file = file_of(flags);
    if (std::error_code ignored; !std::filesystem::exists(file, ignored))
        throw InputError({file, 0, 0, {}}, "is no file", "a history");
    const History::Pruned pruned = History(file, History::For::collecting).prune(flags.keep, flags.before, flags.dry);
    if (flags.json) {
        nlohmann::ordered_json nights = nlohmann::ordered_json::array();
        for (const Night& night : pruned.nights)
            nights.push_back({{"night", night.number}, {"study", night.study}, {"played_utc", night.played_utc}});
        fmt::print("{}", json_text({{"dry_run", flags.dry}, {"removed", nights}, {"kept_accepted", pruned.kept_accepted}}));
        return 0;
    }
    for (const Night& night : pruned.nights)
        fmt::print("{} night {} of {}, {}\n", flags.dry ? "would remove" : "removed", night.number, printable(night.study), night.date());
    fmt::print("{} {}{}; their folders stay as they are\n", flags.dry ? "would remove" : "removed", counted(pruned.nights.size(), "night"),
               pruned.kept_accepted > 0 ? fmt::format(", kept {} that {} accepted", counted(pruned.kept_accepted, "older one"),
                                                      pruned.kept_accepted == 1 ? "is" : "are")
                                        : "");
    return 0;
}

int export_nights(const HistoryFlags& flags) {
    const std::vector<Night> nights = nights_named(flags);
    if (flags.out.empty() || flags.out == "-") {
        export_csv(nights, [](const std::string& lines) { fmt::print("{}", lines); });
        return 0;
    }
    check_target("--out", flags.out, flags.force);
    std::string all;
    export_csv(nights, [&all](const std::string& lines) { all += lines; });
    write_file(flags.out, all);
    return 0;
}

} // namespace

void add_history_command(CLI::App& app, const std::vector<std::string>& words, std::function<int()>& chosen) {
    const auto flags = std::make_shared<HistoryFlags>();
    flags->command = words;
    CLI::App* command = app.add_subcommand("history", "keep the readings of a study's nights, and say what changed, when and why");
    command->require_subcommand(1);
    command->footer("docs/history.md tells what counts as a change and how causes are found.");
    const auto add_action = [&](const char* name, const char* text, int (*action)(const HistoryFlags&)) {
        CLI::App* sub = command->add_subcommand(name, text);
        add_shared(*sub, "--history", flags->history)->default_str(default_history_file().string());
        sub->callback([flags, action, &chosen] { chosen = [flags, action] { return action(*flags); }; });
        return sub;
    };
    const auto add_study = [&](CLI::App* sub, const char* usual) { add_shared(*sub, "--study", flags->study)->default_str(usual); };
    const char* const last_study = "that of the night that was added last";
    CLI::App* adding = add_action("add", "add a night: the folder of a complete study", add);
    adding->add_option("FOLDER", flags->folder, "folder that `fernlicht study` wrote")->required();
    adding->add_flag("--accept", flags->accept, "compare later nights with this one");
    add_shared(*adding, "--note", flags->note);
    CLI::App* accepting = add_action("accept", "compare later nights with this one", accept_night);
    add_shared(*accepting, "NIGHT", flags->night)->required();
    add_shared(*accepting, "--note", flags->note);
    accepting->add_flag("--withdraw", flags->withdraw, "withdraw the acceptance");
    add_study(accepting, last_study);
    CLI::App* showing = add_action("show", "list the nights, or show one", show);
    add_shared(*showing, "NIGHT", flags->night);
    add_study(showing, "all; for one night that of the night that was added last");
    CLI::App* trending = add_action("trend", "show when a reading changed, and why", trend);
    trending->add_option("READING", flags->reading, "name or pattern of readings, * and ? allowed; frame_s for times")->required();
    add_shared(*trending, "--only", flags->only)->default_str("all cells");
    add_study(trending, last_study);
    CLI::App* explaining = add_action("explain", "say what changed since the last accepted night, when, and why", explain);
    add_shared(*explaining, "NIGHT", flags->night)->default_str("last");
    explaining->add_option("--drift", flags->drift, "report a drift when its sum exceeds this; each step is smaller")
        ->option_text("SHARE")
        ->capture_default_str();
    add_shared(*explaining, "--fail-on-change", flags->fails_on_change);
    add_study(explaining, last_study);
    for (CLI::App* sub : {trending, explaining}) {
        add_shared(*sub, "--out", flags->out);
        add_tables_flag(*sub, flags->tables);
    }
    CLI::App* pruning = add_action("prune", "remove old nights; accepted ones stay", prune);
    pruning->add_option("--keep-nights", flags->keep, "keep this many of the newest nights of each study")->check(CLI::Range(0, 1'000'000));
    pruning->add_option("--before", flags->before, "remove nights before this date")->option_text("DATE");
    add_shared(*pruning, "--dry-run", flags->dry);
    for (CLI::App* sub : {showing, trending, explaining, pruning})
        add_shared(*sub, "--json", flags->json);
    CLI::App* exporting = add_action("export", "write every reading of every night, one per line, as tidy CSV (RFC 4180)", export_nights);
    add_shared(*exporting, "-o,--out", flags->out);
    add_shared(*exporting, "--force", flags->force);
    add_study(exporting, "all");
}

} // namespace fernlicht
