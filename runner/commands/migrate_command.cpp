#include "runner/commands/commands.h"

#include "metrics/readings/reading_key.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/durable_files.h"
#include "runner/files/log.h"
#include "runner/judge/old_baselines.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/old_names.h"
#include "scenarios/yaml/yaml_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <set>
#include <sstream>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

struct MigrateFlags {
    std::vector<fs::path> files;
    std::string out;
    bool in_place = false;
};

constexpr std::size_t largest_bytes = std::size_t{16} << 20;

const YamlValue* find_member(const YamlValue& map, std::string_view key) {
    const auto found = std::ranges::find(map.members, key, &YamlMember::key);
    return found == map.members.end() ? nullptr : &found->value;
}

bool is_study(const YamlValue& tree) { return find_member(tree, "fernlicht_study") != nullptr; }
bool is_known_failures(const YamlValue& tree) { return find_member(tree, "known") != nullptr; }
bool is_baselines(const fs::path& file) { return fs::is_directory(file) || file.filename() == "index.json"; }
fs::path store_of(const fs::path& file) { return fs::is_directory(file) ? file : fs::absolute(file).parent_path(); }

void check_reading(const YamlValue& name, std::vector<std::string>& unmatched) {
    if (!key_of(name.text))
        unmatched.push_back(fmt::format("{}: no reading is called '{}' (`fernlicht readings` lists all)", name.line, printable(name.text)));
}

/// Limits of drives and studies, and what decides in a study.
void check_readings(const YamlValue& tree, std::vector<std::string>& unmatched) {
    if (const YamlValue* limits = find_member(tree, "limits"))
        for (const YamlValue& limit : limits->items)
            if (const YamlValue* reading = find_member(limit, "reading"))
                check_reading(*reading, unmatched);
    for (const char* const decide : {"decide", "readings"})
        if (const YamlValue* readings = find_member(tree, decide))
            for (const YamlValue& reading : readings->items)
                if (reading.text.find_first_of("*?") == std::string::npos)
                    check_reading(reading, unmatched);
}

/// A reading, a word of its own, or several words.
bool names_a_verdict(const std::string& name) {
    static constexpr std::string_view words[] = {"repeats", "played", "complete", "baseline"};
    return name.find_first_of("*? ") != std::string::npos || std::ranges::find(words, name) != std::end(words) || key_of(name) ||
           verdict_id_of_today("/" + name) != "/" + name;
}

std::string converted_known_failures(const std::string& text, const YamlValue& tree, std::vector<std::string>& unmatched) {
    std::vector<TextEdit> edits;
    for (const YamlValue& entry : find_member(tree, "known")->items)
        if (const YamlValue* id = find_member(entry, "id")) {
            if (const std::string now = verdict_id_of_today(id->text); now != id->text)
                edits.push_back({id->line, id->column, id->text, now});
            const std::size_t third = id->text.find('/', id->text.find('/', id->text.find('/') + 1) + 1);
            if (std::ranges::count(id->text, '/') == 3 && !names_a_verdict(id->text.substr(third + 1)))
                unmatched.push_back(fmt::format("{}: no verdict is called '{}'", id->line, printable(id->text.substr(third + 1))));
        }
    return edited(text, std::move(edits), unmatched);
}

constexpr std::string_view old_log = "variant,tick,", log_of_today = "lamp_set,tick,"; ///< the logs that runs write of their drives
bool is_drive_log(const std::string& text) { return text.starts_with(old_log) || text.starts_with(log_of_today); }

/// A file of whichever kind; `unmatched` gets "FILE:LINE: ...".
std::string converted(const fs::path& file, std::vector<std::string>& unmatched) {
    FilesRead opened;
    const std::string text = read_file(file, opened, largest_bytes);
    if (is_drive_log(text))
        return text.starts_with(old_log) ? std::string(log_of_today).append(text, old_log.size()) : text;
    const YamlValue tree = parse_yaml(text, file);
    if (!is_study(tree) && !is_known_failures(tree) && !find_member(tree, "fernlicht"))
        throw InputError({file, 0, 0, {}}, "is no drive, study, list of known failures or drive's log",
                         "one of these, or a folder of baselines");
    std::vector<std::string> found;
    std::string now =
        is_known_failures(tree) ? converted_known_failures(text, tree, found) : renamed_keys(text, file, Naming::today, found);
    check_readings(tree, found);
    for (const std::string& one : found)
        unmatched.push_back(fmt::format("{}:{}", file.string(), one));
    return now;
}

/// The drives with each lamp set, and the studies' cells: whose results baselines may be. Files that are none give nothing.
std::vector<Drive> cells_in(const std::vector<fs::path>& files) {
    std::vector<Drive> cells;
    for (const fs::path& file : files) {
        FilesRead opened;
        const std::string text = read_file(file, opened, largest_bytes);
        if (is_drive_log(text))
            continue;
        const YamlValue tree = parse_yaml(text, file);
        if (is_study(tree)) {
            const Study study = read_study(file);
            for (const StudyCell& cell : cells_of(study))
                cells.push_back(cell_drive(study, cell));
        } else if (!is_known_failures(tree)) {
            const Drive drive = read_drive(file);
            for (const LampSet& lamp_set : drive.lamp_sets)
                cells.emplace_back(drive).lamp_sets = {lamp_set};
        }
    }
    return cells;
}

fs::path target(const MigrateFlags& flags, const fs::path& file) {
    if (flags.in_place)
        return file;
    if (flags.out.empty()) // printed
        return {};
    fs::path target = fs::path(flags.out) / fs::absolute(file).lexically_normal().filename();
    if (fs::exists(target))
        throw InputError({target, 0, 0, {}}, "is there already", "a folder without it");
    return target;
}

constexpr const char* unchanged = "has today's names already";

/// "changed in line 2, 5"; names are put otherwise within their lines.
std::string changes(const std::string& before, const std::string& now) {
    std::istringstream old_lines(before), lines(now);
    std::string told, old_line, line;
    for (int n = 1; std::getline(old_lines, old_line) && std::getline(lines, line); ++n)
        if (line != old_line)
            told += fmt::format("{} {}", told.empty() ? "changed in line" : ",", n);
    return told.empty() ? unchanged : told;
}

int migrate(const MigrateFlags& flags) {
    if (flags.in_place && !flags.out.empty())
        throw InputError({{}, 0, 0, "--in-place"}, "found --out beside it", "one of them");
    std::vector<fs::path> files;
    std::vector<std::string> unmatched, texts;
    for (const fs::path& file : flags.files) // all are read before the first is written
        if (!is_baselines(file)) {
            texts.push_back(converted(file, unmatched));
            files.push_back(file);
        } else if (!flags.in_place)
            throw fs::exists(store_of(file) / "index.json")
                ? InputError({file, 0, 0, {}}, "is a folder of baselines", "--in-place beside it")
                : InputError({file, 0, 0, {}}, "is a folder without index.json", "a file, or a folder of baselines");
    std::vector<fs::path> targets;
    for (const fs::path& file : files)
        targets.push_back(target(flags, file));
    if (std::set<fs::path>(targets.begin(), targets.end()).size() < targets.size())
        throw InputError({{}, 0, 0, "--out"}, "found two files of one name", "files of different names");
    if (!flags.out.empty())
        make_folder(flags.out);
    for (std::size_t i = 0; i < files.size(); ++i)
        if (targets[i].empty()) {
            fmt::print("{}", texts[i]);
        } else {
            FilesRead opened;
            const std::string before = read_file(files[i], opened);
            if (!flags.in_place || before != texts[i])
                write_file(targets[i], texts[i]);
            fmt::print("{}: {}\n", targets[i].string(), changes(before, texts[i]));
        }
    for (const fs::path& file : flags.files)
        if (is_baselines(file)) {
            FilesRead opened;
            const fs::path index = store_of(file) / "index.json";
            const std::string before = fs::exists(index) ? read_file(index, opened) : "";
            std::ranges::move(convert_baselines(store_of(file), cells_in(files)), std::back_inserter(unmatched));
            fmt::print("{}: {}\n", file.string(), read_file(index, opened) == before ? unchanged : "changed");
        }
    for (const std::string& one : unmatched)
        tell(LogLevel::warning, one);
    return unmatched.empty() ? 0 : 1;
}

} // namespace

void add_migrate_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<MigrateFlags>();
    CLI::App* sub = app.add_subcommand("migrate", "convert files of version 0.1 to today's names; printed unless a flag is given");
    sub->add_option("FILE", flags->files, "drives, studies, lists of known failures, logs of drives, and folders of baselines")->required();
    sub->add_flag("--in-place", flags->in_place, "write over the files");
    add_shared(*sub, "--out", flags->out);
    sub->callback([flags, &chosen] { chosen = [flags] { return migrate(*flags); }; });
}

} // namespace fernlicht
