#include "runner/experiments/history/history_findings.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Today's program and machine, all else from before.
CellInputs inputs_from_before(const CellInputs& before, const CellInputs& now) {
    CellInputs inputs;
    for (const CellInput& input : before)
        if (cause_of(input.kind) == Cause::inputs)
            inputs.push_back(input);
    for (const CellInput& input : now)
        if (cause_of(input.kind) != Cause::inputs)
            inputs.push_back(input);
    return inputs;
}

/// The night before `night` in which the cell was played, as chain_of has it.
std::size_t night_before(const HistoryFindings& findings, const std::string& cell, std::size_t night) {
    const std::vector<std::size_t> chain = chain_of(findings.nights, cell, findings.base);
    const auto at = std::ranges::find(chain, night);
    return at == chain.begin() ? night : *(at - 1);
}

const char* needs_player = "no cell was played with tonight's program and the inputs of the night before";

Replayed replay_of(const HistoryFindings& findings, const HistoryEvent& event, const std::string& cell, const TellApart& play) {
    const Night& night = findings.nights[event.night];
    const NightCell& now = *night.cell(cell);
    if (now.with_earlier_inputs)
        return {*now.with_earlier_inputs};
    if (event.night + 1 != findings.nights.size())
        return {std::nullopt,
                "no cell was played that night with its program and the inputs before it, and its program is no longer the one at hand"};
    if (!play)
        return {std::nullopt, needs_player};
    const Night& earlier = findings.nights[night_before(findings, cell, event.night)];
    return play({findings.study, cell, inputs_from_before(deciding_inputs(earlier, *earlier.cell(cell)), deciding_inputs(night, now)),
                 earlier.folder});
}

} // namespace

ToldApart tell_apart(const HistoryFindings& findings, const HistoryEvent& event, const TellApart& play,
                     std::map<std::string, NightReadings>& replays) {
    ToldApart told;
    if (event.moved.empty())
        return {{}, {}, "nothing moved beyond rounding", false, false};
    // The one that was played, else that of the largest change.
    const auto was_played = std::ranges::find_if(event.moved, [&](const MovedReading& moved) {
        return findings.nights[event.night].cell(moved.cell)->with_earlier_inputs != nullptr;
    });
    told.cell = (was_played == event.moved.end() ? event.moved.begin() : was_played)->cell;
    const Replayed replayed = replay_of(findings, event, told.cell, play);
    if (!replayed.readings) {
        told.why_not = replayed.why_not.empty() ? needs_player : replayed.why_not;
        return told;
    }
    if (event.night + 1 == findings.nights.size() && !findings.tonight().cell(told.cell)->with_earlier_inputs)
        replays[told.cell] = *replayed.readings;
    InputChanges of_inputs, of_others;
    for (const InputChange& change : event.causes)
        (cause_of(change.kind) == Cause::inputs ? of_inputs : of_others).push_back(change);
    for (const MovedReading& moved : event.moved)
        if (moved.cell == told.cell) {
            const auto found = replayed.readings->find(moved.reading);
            const Value between = found == replayed.readings->end() ? Value::not_measured("not read") : found->second;
            told.parts.push_back({moved.reading, moved.before, between, moved.now});
            told.program_moved = told.program_moved || is_beyond(moved.before, between, 0.0, of_others);
            told.inputs_moved = told.inputs_moved || is_beyond(between, moved.now, 0.0, of_inputs);
        }
    return told;
}

} // namespace fernlicht
