#include "runner/commands/commands.h"

#include "runner/commands/accept_command.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/durable_files.h"
#include "runner/files/json_text.h"
#include "runner/files/value_json.h"
#include "runner/findings/figures.h"
#include "runner/judge/baseline_difference.h"
#include "runner/judge/baseline_json.h"
#include "runner/judge/baselines.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

/// The flags as typed.
struct BaselinesFlags {
    std::string store = "baselines";
    std::string word, other;
    std::vector<std::string> words;
    bool json = false, dry = false, all = false, unreferenced = false;
};

/// The first row is the head.
std::string table(const std::vector<std::vector<std::string>>& rows) { return aligned_table(std::string(rows.front().size(), '<'), rows); }

int list(const BaselinesFlags& flags) {
    refuse_missing_store(flags.store);
    const FolderLock lock(flags.store, FolderLock::For::reading);
    const std::vector<StoredBaseline> entries = list_baselines(flags.store);
    if (flags.json) {
        fmt::print("{}", json_text(as_json(entries, stored_members)));
        return 0;
    }
    if (entries.empty()) {
        fmt::print("nothing is accepted in {}\n", flags.store);
        return 0;
    }
    std::vector<std::vector<std::string>> rows{{"id", "drive/lamp set/technique", "device", "played", "note"}};
    for (const StoredBaseline& entry : entries)
        rows.push_back({short_id(entry.id), printable(cell_text(entry.key), 100), printable(device_text(entry.key), 100), entry.played_utc,
                        printable(entry.note, 200)});
    fmt::print("{}", table(rows));
    return 0;
}

std::string figure_of(const AcceptedReading& reading) {
    return reading.mean.measured() ? with_bound(reading.mean, fmt::format("{:.6g}", *reading.mean.figure())) : "not measured";
}

Json baseline_json(const StoredBaseline& entry, const Baseline& baseline) {
    Json out = as_json(entry, stored_members), readings = Json::array(), frames = Json::array();
    for (const AcceptedReading& reading : baseline.readings)
        readings.push_back({{"name", name_of(reading.key)},
                            {"frame", reading.tick < 0 ? Json(nullptr) : Json(reading.tick)},
                            {"mean", value_json(reading.mean)},
                            {"unit", unit_of(reading.key)},
                            {"count", reading.count},
                            {"variance", reading.variance}});
    for (const BaselineFrame& frame : baseline.frames)
        frames.push_back({{"frame", frame.tick}, {"view", frame.view}, {"xxh128", frame.xxh128}, {"file", frame.exr.string()}});
    out["producer"] = as_json(baseline.producer, producer_members);
    out["readings"] = readings;
    out["frames"] = baseline.frames_left_out ? Json(nullptr) : frames;
    return out;
}

void print_facts(const StoredBaseline& entry, const Producer& producer) {
    std::vector<std::vector<std::string>> rows{{"id", entry.id},
                                               {"drive", printable(entry.key.drive, 100)},
                                               {"lamp set", printable(entry.key.lamp_set, 100)},
                                               {"technique", printable(entry.key.technique, 100)},
                                               {"device", printable(device_text(entry.key), 200)},
                                               {"played", printable(entry.played_utc)},
                                               {"note", entry.note.empty() ? "none" : printable(entry.note, 400)},
                                               {"driver", printable(producer.gl_version, 200)},
                                               {"CPU", printable(producer.cpu, 200)},
                                               {"system", printable(producer.os, 200)}};
    for (const auto& [name, version] : producer.versions)
        rows.push_back({printable(name), printable(version, 100)});
    for (const auto& [name, hash] : producer.inputs)
        rows.push_back({"input " + printable(name), hash});
    fmt::print("{}", table(rows));
}

/// Only where several device classes have results, and of what differs between them.
void print_device_spread(const DeviceSpread& spread) {
    if (spread.devices < 2)
        return;
    std::vector<std::vector<std::string>> rows{{"differs between devices", "frame", "mean", "unit", "classes", "standard deviation"}};
    for (const AcceptedReading& reading : spread.readings)
        if (reading.variance > 0.0)
            rows.push_back({name_of(reading.key), reading.tick < 0 ? "" : fmt::format("{}", reading.tick), figure_of(reading),
                            unit_of(reading.key), fmt::format("{}", reading.count), fmt::format("{:.3g}", std::sqrt(reading.variance))});
    if (rows.size() == 1)
        fmt::print("\n{} device classes agree in every reading\n", spread.devices);
    else
        fmt::print("\n{}", table(rows));
}

int show(const BaselinesFlags& flags) {
    const FolderLock lock(flags.store, FolderLock::For::reading);
    const StoredBaseline entry = choose_baseline(flags.store, flags.word);
    const Baseline baseline = load_baseline(flags.store, entry);
    if (flags.json) {
        fmt::print("{}", json_text(baseline_json(entry, baseline)));
        return 0;
    }
    print_facts(entry, baseline.producer);
    std::vector<std::vector<std::string>> readings{{"reading", "frame", "mean", "unit", "repeats", "standard deviation"}};
    for (const AcceptedReading& reading : baseline.readings)
        readings.push_back({name_of(reading.key), reading.tick < 0 ? "" : fmt::format("{}", reading.tick), figure_of(reading),
                            unit_of(reading.key), fmt::format("{}", reading.count),
                            reading.count > 1 ? fmt::format("{:.3g}", std::sqrt(reading.variance)) : ""});
    fmt::print("\n{}", table(readings));
    print_device_spread(spread_over_devices(flags.store, list_baselines(flags.store), entry.key));
    std::vector<std::vector<std::string>> frames{{"frame", "view", "file"}};
    for (const BaselineFrame& frame : baseline.frames)
        frames.push_back({fmt::format("{}", frame.tick), printable(frame.view), frame.exr.string()});
    if (!baseline.frames.empty())
        fmt::print("\n{}", table(frames));
    if (baseline.frames_left_out)
        fmt::print("\naccepted without pictures\n");
    return 0;
}

/// The same drive, lamp set and technique among a run's results; or its only result, whatever it is called: another lamp has another name.
Baseline counterpart(const std::string& folder, const BaselineKey& key) {
    std::vector<Baseline> all = read_run(folder);
    if (all.size() == 1)
        return std::move(all.front());
    for (Baseline& results : all) // one drive may be played under several conditions
        if (results.key == key)
            return std::move(results);
    for (Baseline& results : all)
        if (results.key.drive == key.drive && results.key.lamp_set == key.lamp_set && results.key.technique == key.technique)
            return std::move(results);
    throw InputError({folder, 0, 0, {}}, "has no " + printable(cell_text(key), 200), "a run of what is compared");
}

const char* word_for(Agreement agreement) {
    return agreement == Agreement::agrees ? "same" : agreement == Agreement::differs ? "DIFFERS" : "UNDECIDED";
}

/// One line for each thing; those that agree only where all are asked for. Returns how many do not agree.
std::size_t print_differences(const std::vector<ResultDifference>& differences, const std::string& things, bool all) {
    std::size_t others = 0;
    for (const ResultDifference& difference : differences) {
        const bool agrees = difference.agreement == Agreement::agrees;
        others += agrees ? 0 : 1;
        if (all || !agrees)
            fmt::print("{:<9}  {}: {}\n", word_for(difference.agreement), printable(difference.what, 100), printable(difference.text, 600));
    }
    fmt::print("{} of {} {} agree\n", differences.size() - others, differences.size(), things);
    return others;
}

void print_other_keys(const Baseline& a, const Baseline& b) {
    if (cell_text(a.key) != cell_text(b.key))
        fmt::print("{} against {}\n", printable(cell_text(a.key), 200), printable(cell_text(b.key), 200));
    if (device_text(a.key) != device_text(b.key))
        fmt::print("{} against {}\n", printable(device_text(a.key), 200), printable(device_text(b.key), 200));
    for (const auto& [name, hash] : a.producer.inputs)
        if (std::ranges::find(b.producer.inputs, std::pair(name, hash)) == b.producer.inputs.end())
            fmt::print("another {}\n", printable(name));
}

int diff(const BaselinesFlags& flags) {
    const FolderLock lock(flags.store, FolderLock::For::reading);
    const StoredBaseline entry = choose_baseline(flags.store, flags.word);
    const Baseline accepted = load_baseline(flags.store, entry);
    std::error_code ignored;
    const bool is_run = std::filesystem::is_directory(flags.other, ignored);
    const Baseline tested =
        is_run ? counterpart(flags.other, entry.key) : load_baseline(flags.store, choose_baseline(flags.store, flags.other));
    print_other_keys(accepted, tested);
    const std::size_t readings = print_differences(compare_readings(tested.readings, accepted.readings, {}), "readings", flags.all);
    if (accepted.frames_left_out || tested.frames_left_out) {
        fmt::print("pictures are not compared: {} was accepted without\n", accepted.frames_left_out ? short_id(entry.id) : flags.other);
        return readings == 0 ? 0 : 1;
    }
    const std::size_t frames = print_differences(compare_frames(tested.frames, accepted.frames, {}), "channels of pictures", flags.all);
    return readings + frames == 0 ? 0 : 1;
}

int remove(const BaselinesFlags& flags) {
    if (flags.words.empty() && !flags.unreferenced)
        throw InputError({{}, 0, 0, "remove"}, "found no ID", "one or more, or --unreferenced");
    std::vector<std::string> ids;
    for (const std::string& word : flags.words) {
        const StoredBaseline entry = choose_baseline(flags.store, word);
        ids.push_back(entry.id);
        fmt::print("{}{}  {}; {}\n", flags.dry ? "would remove " : "removes ", short_id(entry.id), printable(cell_text(entry.key), 200),
                   printable(device_text(entry.key), 200));
    }
    const Removal removal = remove_baselines(flags.store, ids, flags.dry);
    fmt::print("{}{} and {} of {} bytes that nothing else needs\n", flags.dry ? "would remove " : "removed ",
               counted(removal.baselines, "baseline"), counted(removal.objects, "file"), removal.bytes);
    return 0;
}

} // namespace

void add_baselines_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<BaselinesFlags>();
    CLI::App* command = app.add_subcommand("baselines", "list, show, compare and remove baselines");
    command->require_subcommand(0, 1);
    const auto add = [&](const char* name, const char* text, int (*action)(const BaselinesFlags&)) {
        CLI::App* sub = command->add_subcommand(name, text);
        add_shared(*sub, "--baselines", flags->store)->capture_default_str();
        sub->callback([flags, action, &chosen] { chosen = [flags, action] { return action(*flags); }; });
        return sub;
    };
    CLI::App* listing = add("list", "list the baselines", list);
    add_shared(*listing, "--json", flags->json);
    CLI::App* showing = add("show", "show one baseline: who made it, readings, frames", show);
    add_shared(*showing, "ID", flags->word)->required();
    add_shared(*showing, "--json", flags->json);
    CLI::App* comparing = add("diff", "compare two results, reading by reading and pixel by pixel", diff);
    add_shared(*comparing, "ID", flags->word)->required();
    comparing->add_option("OTHER", flags->other, "a run's folder, or another id")->required();
    comparing->add_flag("--all", flags->all, "list what agrees, too");
    CLI::App* removing = add("remove", "remove baselines, and files no longer needed", remove);
    add_shared(*removing, "IDS", flags->words);
    add_shared(*removing, "--dry-run", flags->dry);
    removing->add_flag("--unreferenced", flags->unreferenced, "without an ID: remove only files that nothing refers to");
    command->allow_extras(); // to say what is wrong with them; the actions, added before, take none
    command->callback([command, &chosen] {
        if (command->get_subcommands().empty())
            chosen = [extras = command->remaining()]() -> int {
                throw InputError({{}, 0, 0, "baselines"}, extras.empty() ? "found nothing" : "found '" + printable(extras.front()) + "'",
                                 "list, show, diff or remove; `fernlicht reference DRIVE` ray-traces a moment");
            };
    });
}

} // namespace fernlicht
