#include "runner/judge/baselines.h"

#include "metrics/readings/significance.h"
#include "metrics/statistics/statistics.h"
#include "runner/files/durable_files.h"
#include "runner/findings/summary.h"
#include "runner/judge/input_hashes.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <tuple>
#include <utility>

namespace fernlicht {
namespace {

/// Each thing that differs by itself, called `kind` and its name; those that agree in one sum, called `green`.
std::vector<Verdict> verdicts_on(const std::vector<ResultDifference>& differences, const std::string& kind, const std::string& green,
                                 const std::string& things, const std::string& accepted_as) {
    std::vector<Verdict> verdicts;
    const ResultDifference* farthest = nullptr;
    for (const ResultDifference& difference : differences)
        if (difference.agreement == Agreement::agrees)
            farthest = farthest && farthest->of_allowed >= difference.of_allowed ? farthest : &difference;
        else
            verdicts.push_back({difference.agreement == Agreement::differs ? VerdictKind::fail : VerdictKind::not_measured,
                                kind + " " + difference.what, difference.text + accepted_as, ""});
    if (verdicts.empty() && farthest)
        verdicts.push_back({VerdictKind::pass, green,
                            farthest->of_allowed == 0.0 ? fmt::format("{} {} agree exactly{}", differences.size(), things, accepted_as)
                                                        : fmt::format("{} {} agree; largest deviation: {}, {}{}", differences.size(),
                                                                      things, farthest->what, farthest->text, accepted_as),
                            ""});
    return verdicts;
}

std::size_t count_of_not_green(const std::vector<Verdict>& verdicts) {
    return static_cast<std::size_t>(
        std::ranges::count_if(verdicts, [](const Verdict& verdict) { return verdict.kind != VerdictKind::pass; }));
}

using Inputs = std::vector<std::pair<std::string, std::string>>;

/// Which of a run's inputs are not those of accepted results.
std::vector<std::string> other_inputs(const Inputs& run, const Inputs& accepted) {
    std::vector<std::string> names;
    const auto add = [&](const Inputs& some, const Inputs& others) {
        for (const auto& input : some)
            if (std::ranges::find(others, input) == others.end() && std::ranges::find(names, input.first) == names.end())
                names.push_back(input.first);
    };
    add(run, accepted);
    add(accepted, run);
    return names;
}

/// "lamp file 1 (led-low.ies)" where there are several; of one alone "lamp file (led-low.ies)". `opened`: the run's files; what was read
/// from several has no name. A drive counts with its moments.
std::string input_text(const std::string& name, const Inputs& of_run, const FilesRead& opened) {
    if (name == "drive")
        return "drive (its keys, or --frames)";
    const bool several = std::ranges::any_of(of_run, [](const auto& input) { return input.first == "lamp file 2"; });
    const std::string text = name == "lamp file 1" && !several ? "lamp file" : name;
    const auto input = std::ranges::find(of_run, name, &Inputs::value_type::first);
    const auto file =
        std::ranges::find_if(opened, [&](const FileRead& read) { return input != of_run.end() && input_hash({read}) == input->second; });
    return file == opened.end() ? text : fmt::format("{} ({})", text, printable(file->path.filename().string(), 200));
}

struct MovedReadings {
    std::size_t count;
    std::string text;
};

/// What other inputs came to: "of 859 readings 312 differ, largest deviation: ...". What usually decides goes before other readings, and
/// all of these before their errors.
MovedReadings moved_readings(const Baseline& run, const Baseline& accepted, const BaselineTolerance& tolerance) {
    std::vector<ResultDifference> differences = compare_readings(run.readings, accepted.readings, tolerance);
    const std::size_t all = differences.size();
    std::erase_if(differences, [](const ResultDifference& difference) { return difference.agreement == Agreement::agrees; });
    if (differences.empty())
        return {0, fmt::format("all {} readings agree", all)};
    const ResultDifference& farthest = *std::ranges::max_element(differences, {}, [](const ResultDifference& difference) {
        return std::tuple(place_among(*difference.reading, decides_by_default()).has_value(), !is_uncertainty(*difference.reading),
                          difference.of_allowed);
    });
    return {differences.size(),
            fmt::format("of {} readings {} differ, {}: {}, {}", all, differences.size(),
                        place_among(*farthest.reading, decides_by_default()) ? "largest deviation among the readings that decide by default"
                                                                             : "largest deviation",
                        farthest.what, farthest.text)};
}

/// Why there is nothing to judge by. Where all but the inputs is known, which of them are others, and what that came to.
std::string nothing_accepted(const std::filesystem::path& store, const std::vector<StoredBaseline>& entries, const Baseline& run,
                             const FilesRead& opened, const BaselineTolerance& tolerance) {
    std::string text = fmt::format("nothing accepted in {} for {}", store.string(), key_text(run.key));
    std::string nearest;
    std::pair<std::size_t, std::size_t> fewest; // inputs, and readings where these are as many
    for (const StoredBaseline& entry : entries) {
        if (!same_but_inputs(entry.key, run.key))
            continue;
        const Baseline accepted = load_baseline(store, entry);
        const std::vector<std::string> others = other_inputs(run.producer.inputs, accepted.producer.inputs);
        const MovedReadings moved = moved_readings(run, accepted, tolerance);
        const std::pair differing(others.size(), moved.count);
        if (!nearest.empty() && differing >= fewest)
            continue;
        fewest = differing;
        std::vector<std::string> texts;
        for (const std::string& other : others)
            texts.push_back(input_text(other, run.producer.inputs, opened));
        nearest = fmt::format("{} changed since {}: {}; ", fmt::join(texts, ", "), short_id(entry.id), moved.text);
    }
    if (!nearest.empty())
        return nearest + "no baseline has these inputs; if that is meant, `fernlicht accept` takes these results";
    for (const StoredBaseline& entry : entries)
        if (same_but_lamp_set(entry.key, run.key))
            return text + fmt::format("; of this drive {} ({}) is accepted: {}", printable(entry.key.lamp_set), short_id(entry.id),
                                      moved_readings(run, load_baseline(store, entry), tolerance).text);
    for (const StoredBaseline& entry : entries)
        if (same_but_device(entry.key, run.key))
            return text + fmt::format("; {} is of {}", short_id(entry.id), device_text(entry.key));
    return text;
}

std::vector<Verdict> judge_readings(const Baseline& run, const std::vector<AcceptedReading>& accepted, const std::string& accepted_as,
                                    const BaselineTolerance& tolerance) {
    return verdicts_on(compare_readings(run.readings, accepted, tolerance), "baseline reading", "baseline", "readings", accepted_as);
}

std::vector<Verdict> judge_frames(const Baseline& run, const Baseline& accepted, const std::string& accepted_as,
                                  const BaselineTolerance& tolerance) {
    if (accepted.frames_left_out)
        return {};
    return verdicts_on(compare_frames(run.frames, accepted.frames, tolerance), "baseline frame", "baseline frames", "channels of pictures",
                       accepted_as);
}

/// Of the verdicts that each entry gives, those with the fewest that are not green. `judge` takes the results and how they are called.
template <class Judge>
std::vector<Verdict> nearest(const std::filesystem::path& store, const std::vector<StoredBaseline>& entries, const Judge& judge) {
    std::vector<Verdict> best;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string several = entries.size() > 1 ? fmt::format(", of {} accepted", entries.size()) : "";
        const Baseline accepted = load_baseline(store, entries[i]);
        const std::string pictures = accepted.frames_left_out ? ", accepted without pictures" : "";
        std::vector<Verdict> verdicts = judge(accepted, fmt::format(" ({}{}{})", short_id(entries[i].id), several, pictures));
        if (i == 0 || count_of_not_green(verdicts) < count_of_not_green(best))
            best = std::move(verdicts);
    }
    return best;
}

/// The device classes that results are of, each once.
std::string devices_text(const std::vector<StoredBaseline>& entries) {
    std::string text;
    for (const StoredBaseline& entry : entries)
        if (const std::string device = device_text(entry.key); text.find(device) == std::string::npos)
            text += (text.empty() ? "" : "; ") + device;
    return text;
}

/// What runs of other classes gave: one of them by the tolerance alone, several by their spread, too.
std::vector<Verdict> judge_across(const std::filesystem::path& store, const DeviceSpread& others, const Baseline& run,
                                  const BaselineTolerance& tolerance) {
    Baseline measured = run; // what was measured on all of them; what was not has no spread
    std::erase_if(measured.readings, [](const AcceptedReading& reading) { return !reading.mean.measured(); });
    const std::string over = fmt::format(" (over {} other device class{})", others.devices, others.devices == 1 ? "" : "es");
    std::vector<Verdict> verdicts = judge_readings(measured, others.readings, over, tolerance);
    verdicts.push_back({VerdictKind::pass, other_device_class,
                        fmt::format("nothing is accepted for {}; judged by {}", device_text(run.key), devices_text(others.entries)), ""});
    std::ranges::move(nearest(store, others.entries,
                              [&](const Baseline& accepted, const std::string& accepted_as) {
                                  return judge_frames(run, accepted, accepted_as, tolerance);
                              }),
                      std::back_inserter(verdicts));
    return verdicts;
}

/// Baselines store whether a reading was measured, not why.
Value without_reason(const Value& value) { return value.measured() ? value : Value(); }

/// What tells readings apart.
using Name = std::pair<ReadingKey, int>;
using Values = std::map<Name, std::vector<double>>;

Values values_of(const Baseline& baseline) {
    Values values;
    for (const AcceptedReading& reading : baseline.readings)
        if (const auto mean = reading.mean.figure())
            values[{reading.key, reading.tick}].push_back(*mean);
    return values;
}

} // namespace

DeviceSpread spread_over_devices(const std::filesystem::path& store, const std::vector<StoredBaseline>& all, const BaselineKey& key,
                                 const std::string& but) {
    std::map<std::string, Values> by_device;
    DeviceSpread spread;
    for (const StoredBaseline& entry : all) {
        const std::string device = device_text(entry.key);
        if (!same_but_device(entry.key, key) || device == but)
            continue;
        spread.entries.push_back(entry);
        for (const auto& [name, values] : values_of(load_baseline(store, entry)))
            by_device[device][name].insert(by_device[device][name].end(), values.begin(), values.end());
    }
    spread.devices = by_device.size();
    Values means;
    for (const auto& [device, values] : by_device)
        for (const auto& [name, samples] : values)
            means[name].push_back(spread_of(samples)->mean);
    for (const auto& [name, samples] : means)
        if (samples.size() == spread.devices) {
            const Spread over = *spread_of(samples);
            spread.readings.push_back(
                {name.first, name.second, over.mean, static_cast<int>(over.count), over.standard_deviation * over.standard_deviation});
        }
    return spread;
}

Baseline results_of(const PlayedCell& played, const RunContext& context, const std::filesystem::path& run_folder,
                    const std::string& technique) {
    Baseline results;
    results.key = baseline_key(played.drive, played.lamp_set, technique, context, played.input_hashes);
    results.producer = {context.versions, context.gl_version, context.cpu, context.os, played.input_hashes};
    results.played_utc = context.started_utc;
    for (const Reading& reading : played.readings) {
        if (is_time(reading.key))
            continue;
        AcceptedReading result{reading.key, reading.tick, without_reason(reading.value),
                               reading.value.measured() ? played.repeats.count : 0, 0.0};
        for (const ReadingSpread& spread : played.repeats.spread)
            if (spread.key == reading.key && spread.tick == reading.tick) {
                result.mean = spread.mean;
                result.count = spread.count;
                result.variance = spread.variance;
            }
        results.readings.push_back(std::move(result));
    }
    for (const StoredFrame& frame : played.frames)
        if (!frame.exr.empty())
            results.frames.push_back({frame.tick, frame.view, run_folder / frame.exr, ""});
    return results;
}

std::vector<Verdict> judge_against_baselines(const PlayedCell& played, const RunContext& context, const std::filesystem::path& run_folder,
                                             const std::filesystem::path& baselines_folder, const std::string& technique,
                                             bool across_devices, const BaselineTolerance& tolerance) {
    const FolderLock lock(baselines_folder, FolderLock::For::reading);
    const Baseline run = results_of(played, context, run_folder, technique);
    const auto failed = [&](const std::string& text) { return std::vector<Verdict>{{VerdictKind::fail, "baseline", text, ""}}; };
    try {
        const std::vector<StoredBaseline> all = list_baselines(baselines_folder);
        std::vector<StoredBaseline> entries;
        std::ranges::copy_if(all, std::back_inserter(entries), [&](const StoredBaseline& entry) { return entry.key == run.key; });
        if (entries.empty() && across_devices)
            if (const DeviceSpread others = spread_over_devices(baselines_folder, all, run.key); others.devices > 0)
                return judge_across(baselines_folder, others, run, tolerance);
        if (entries.empty())
            return failed(nothing_accepted(baselines_folder, all, run, context.inputs, tolerance));
        std::vector<Verdict> verdicts = nearest(baselines_folder, entries, [&](const Baseline& accepted, const std::string& accepted_as) {
            std::vector<Verdict> both = judge_readings(run, accepted.readings, accepted_as, tolerance);
            std::ranges::move(judge_frames(run, accepted, accepted_as, tolerance), std::back_inserter(both));
            return both;
        });
        return verdicts.empty() ? failed("the baseline holds neither readings nor frames") : verdicts;
    } catch (const InputError& error) {
        return failed(error.what());
    }
}

} // namespace fernlicht
