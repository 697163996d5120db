#include "runner/references.h"

#include "runner/device_spread.h"
#include "runner/reference_store.h"
#include "runner/summary.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Each thing that differs by itself, those that agree in one sum.
std::vector<Verdict> verdicts_on(const std::vector<ResultDifference>& differences, const std::string& kind, const std::string& things,
                                 const std::string& accepted_as, const std::string& rerun) {
    std::vector<Verdict> verdicts;
    const ResultDifference* farthest = nullptr;
    for (const ResultDifference& difference : differences)
        if (difference.agreement == Agreement::agrees)
            farthest = farthest && farthest->of_allowed >= difference.of_allowed ? farthest : &difference;
        else
            verdicts.push_back({difference.agreement == Agreement::differs ? VerdictKind::fail : VerdictKind::not_measured,
                                kind + " " + difference.what, difference.text + accepted_as, rerun});
    if (verdicts.empty() && farthest)
        verdicts.push_back({VerdictKind::pass, kind,
                            fmt::format("{} {} agree; the farthest off: {}, {}{}", differences.size(), things, farthest->what,
                                        farthest->text, accepted_as),
                            rerun});
    return verdicts;
}

std::size_t count_of_not_green(const std::vector<Verdict>& verdicts) {
    return static_cast<std::size_t>(
        std::ranges::count_if(verdicts, [](const Verdict& verdict) { return verdict.kind != VerdictKind::pass; }));
}

/// Which of a run's inputs are not those of accepted results.
std::string other_inputs(const std::vector<std::pair<std::string, std::string>>& run,
                         const std::vector<std::pair<std::string, std::string>>& accepted) {
    std::string names;
    const auto add = [&](const auto& some, const auto& others) {
        for (const auto& [name, hash] : some)
            if (std::ranges::find(others, std::pair(name, hash)) == others.end() && names.find(name) == std::string::npos)
                names += (names.empty() ? "" : ", ") + name;
    };
    add(run, accepted);
    add(accepted, run);
    return names;
}

/// Why there is nothing to judge by.
std::string nothing_accepted(const std::filesystem::path& store, const std::vector<StoredReference>& entries,
                             const AcceptedReference& run) {
    std::string text = fmt::format("nothing accepted in {} for {}", store.string(), key_text(run.key));
    for (const StoredReference& entry : entries)
        if (same_but_inputs(entry.key, run.key))
            return text + fmt::format(" with these inputs; {} had another {}", short_id(entry.id),
                                      other_inputs(run.producer.inputs, load_reference(store, entry).producer.inputs));
    for (const StoredReference& entry : entries)
        if (same_but_device(entry.key, run.key))
            return text + fmt::format("; {} is of {}", short_id(entry.id), device_text(entry.key));
    return text;
}

std::vector<Verdict> judge_readings(const AcceptedReference& run, const std::vector<AcceptedReading>& accepted,
                                    const std::string& accepted_as, const std::string& rerun, const ReferenceTolerance& tolerance) {
    return verdicts_on(compare_readings(run.readings, accepted, tolerance), "reference reading", "readings", accepted_as, rerun);
}

std::vector<Verdict> judge_frames(const AcceptedReference& run, const AcceptedReference& accepted, const std::string& accepted_as,
                                  const std::string& rerun, const ReferenceTolerance& tolerance) {
    return verdicts_on(compare_frames(run.frames, accepted.frames, tolerance), "reference frame", "pictures", accepted_as, rerun);
}

/// Of the verdicts that each entry gives, those with the fewest that are not green. `judge` takes the results and how they are called.
template <class Judge>
std::vector<Verdict> nearest(const std::filesystem::path& store, const std::vector<StoredReference>& entries, const Judge& judge) {
    std::vector<Verdict> best;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string several = entries.size() > 1 ? fmt::format(", of {} accepted", entries.size()) : "";
        std::vector<Verdict> verdicts = judge(load_reference(store, entries[i]), fmt::format(" ({}{})", short_id(entries[i].id), several));
        if (i == 0 || count_of_not_green(verdicts) < count_of_not_green(best))
            best = std::move(verdicts);
    }
    return best;
}

std::vector<Verdict> judge_across(const std::filesystem::path& store, const DeviceSpread& others, const AcceptedReference& run,
                                  const std::string& rerun, const ReferenceTolerance& tolerance) {
    AcceptedReference measured = run; // what was measured on all of them; what was not has no spread
    std::erase_if(measured.readings, [](const AcceptedReading& reading) { return !reading.mean; });
    std::vector<Verdict> verdicts =
        judge_readings(measured, others.readings, fmt::format(" (over {} other classes of device)", others.devices), rerun, tolerance);
    std::ranges::move(nearest(store, others.entries,
                              [&](const AcceptedReference& accepted, const std::string& accepted_as) {
                                  return judge_frames(run, accepted, accepted_as, rerun, tolerance);
                              }),
                      std::back_inserter(verdicts));
    return verdicts;
}

} // namespace

AcceptedReference results_of(const PlayedVariant& played, const RunContext& context, const std::filesystem::path& run_folder,
                             const std::string& technique) {
    AcceptedReference results;
    results.key = reference_key(played.drive, played.variant, technique, context, played.inputs);
    results.producer = {context.versions, context.gl_version, context.cpu, context.os, played.inputs};
    for (const Reading& reading : played.readings) {
        if (is_unit_of_time(reading.unit))
            continue;
        AcceptedReading result{reading.name, reading.unit, reading.tick, reading.value, reading.value ? played.repeats.count : 0, 0.0};
        for (const ReadingSpread& spread : played.repeats.spread)
            if (spread.name == reading.name && spread.tick == reading.tick) {
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

std::vector<Verdict> judge_against_references(const PlayedVariant& played, const RunContext& context,
                                              const std::filesystem::path& run_folder, const std::filesystem::path& references_folder,
                                              const std::string& technique, bool across_devices, const ReferenceTolerance& tolerance) {
    const AcceptedReference run = results_of(played, context, run_folder, technique);
    const auto failed = [&](const std::string& text) {
        return std::vector<Verdict>{{VerdictKind::fail, "reference", text, context.command}};
    };
    try {
        const std::vector<StoredReference> all = list_references(references_folder);
        std::vector<StoredReference> entries;
        std::ranges::copy_if(all, std::back_inserter(entries), [&](const StoredReference& entry) { return entry.key == run.key; });
        if (entries.empty() && across_devices)
            if (const DeviceSpread others = spread_over_devices(references_folder, all, run.key); others.devices > 1)
                return judge_across(references_folder, others, run, context.command, tolerance);
        if (entries.empty())
            return failed(nothing_accepted(references_folder, all, run));
        std::vector<Verdict> verdicts =
            nearest(references_folder, entries, [&](const AcceptedReference& accepted, const std::string& accepted_as) {
                std::vector<Verdict> both = judge_readings(run, accepted.readings, accepted_as, context.command, tolerance);
                std::ranges::move(judge_frames(run, accepted, accepted_as, context.command, tolerance), std::back_inserter(both));
                return both;
            });
        return verdicts.empty() ? failed("the accepted reference holds neither readings nor frames") : verdicts;
    } catch (const InputError& error) {
        return failed(error.what());
    }
}

} // namespace fernlicht
