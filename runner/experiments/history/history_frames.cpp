#include "runner/experiments/history/history_document.h"

#include "runner/experiments/history/night_of_study.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/log.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// PNGs of a cell in a night's folder, absolute; empty where there are none.
std::vector<StoredFrame> frames_in(const Night& night, const std::string& cell) {
    const std::filesystem::path folder = std::filesystem::path(night.folder) / "cells" / cell;
    std::error_code ignored;
    std::vector<StoredFrame> frames;
    if (!std::filesystem::exists(folder / "report.json", ignored))
        return frames;
    for (const PlayedCell& played : read_report(folder).played)
        for (StoredFrame frame : played.frames)
            if (!frame.png.empty() && std::filesystem::is_regular_file(folder / frame.png, ignored)) {
                frame.png = (folder / frame.png).string();
                frames.push_back(std::move(frame));
            }
    return frames;
}

/// The middle one of the first view that both nights stored.
std::optional<NightFrames> pair_of(const Night& before, const Night& tonight, const NightCell& cell) {
    const std::vector<StoredFrame> old_frames = frames_in(before, cell.name), new_frames = frames_in(tonight, cell.name);
    std::vector<std::pair<const StoredFrame*, const StoredFrame*>> pairs;
    for (const StoredFrame& now : new_frames)
        for (const StoredFrame& then : old_frames)
            if (now.tick == then.tick && now.view == then.view && (pairs.empty() || pairs.front().first->view == now.view))
                pairs.emplace_back(&now, &then);
    if (pairs.empty())
        return std::nullopt;
    const auto& [now, then] = pairs[pairs.size() / 2];
    return NightFrames{fmt::format("{} on {}{}{}, {}, after {:.1f} s", cell.lamp, cell.drive, cell.condition.empty() ? "" : ", ",
                                   cell.condition, now->view, now->time_s),
                       then->png, now->png};
}

} // namespace

void add_frames(HistoryFindings& findings, std::size_t most) {
    std::vector<std::string> cells;
    for (const MovedReading& moved : findings.since)
        if (std::ranges::find(cells, moved.cell) == cells.end())
            cells.push_back(moved.cell);
    if (cells.empty())
        return;
    std::error_code ignored;
    for (const Night* night : {&findings.before(), &findings.tonight()})
        if (!std::filesystem::is_directory(night->folder, ignored)) {
            findings.no_frames = fmt::format("The folder of the night of {} is gone ({}): there are no frames to stand beside each other.",
                                             night->date(), printable(night->folder, 400));
            return;
        }
    if (findings.before().folder == findings.tonight().folder) { // as in a CI, whose jobs all write to one place
        findings.no_frames =
            fmt::format("The folder of the night of {} was written anew ({}): there are no frames to stand beside each other.",
                        findings.before().date(), printable(findings.before().folder, 400));
        return;
    }
    std::vector<std::string> without;
    for (const std::string& cell : cells) {
        if (findings.frames.size() == most)
            break;
        std::optional<NightFrames> pair;
        try {
            pair = pair_of(findings.before(), findings.tonight(), *findings.tonight().cell(cell));
        } catch (const InputError& error) {
            findings.no_frames = fmt::format("A frame cannot be shown: {}.", error.what());
            continue;
        }
        if (pair)
            findings.frames.push_back(std::move(*pair));
        else
            without.push_back(cell);
    }
    if (!without.empty() && findings.no_frames.empty())
        findings.no_frames = fmt::format("Of {} not both nights stored the same moment.", fmt::join(without, ", "));
}

HistoryFindings history_of(const std::filesystem::path& file, const StudyResult& tonight, const std::filesystem::path& folder,
                           const HistoryOptions& options) {
    Night night = night_of_study(tonight, folder);
    std::vector<Night> nights;
    if (std::error_code ignored; std::filesystem::exists(file, ignored))
        nights = History(file, History::For::reading).nights(night.study);
    const auto same =
        std::ranges::find_if(nights, [&](const Night& one) { return one.played_utc == night.played_utc && one.folder == night.folder; });
    if (same != nights.end()) { // it was gone on with
        night.accepted = same->accepted;
        nights.erase(same, nights.end());
    }
    nights.push_back(std::move(night));
    HistoryFindings findings = explain_nights(std::move(nights), options);
    if (!findings.ahead.empty())
        tell(LogLevel::warning, clock_warning(findings));
    findings.context = tonight.context;
    for (const CellResult& cell : tonight.cells)
        for (const auto& [key, reading] : cell.readings)
            if (const std::optional<double> effect = by_aim(reading.sensitivity))
                findings.aim_effects[{cell.cell.name, name_of(key)}] = *effect;
    add_frames(findings);
    return findings;
}

} // namespace fernlicht
