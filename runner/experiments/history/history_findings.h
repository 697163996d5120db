// What changed since the last accepted night: when, by how much and why. docs/history.md explains the rules.
#pragma once

#include "metrics/statistics/change_point.h"
#include "runner/experiments/history/causes.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

#include <functional>
#include <optional>
#include <set>

namespace fernlicht {

/// How far a reading may be off without having changed: the larger of both bounds, and of a reading that says how exact another is, that
/// part of the other on top.
struct HistoryRounding {
    double relative = 0.0, absolute = 0.0, of_other = 0.0;
};
/// Within one device class, where anything that decides the readings changed: what single precision may round otherwise in another order of
/// the same additions. Where nothing changed, every bit counts.
inline constexpr HistoryRounding rounding_of_class{1e-6, 1e-7, 1e-6};
/// From one device class or library to another: as baselines are judged (judge/baseline_difference.h).
inline constexpr HistoryRounding rounding_of_machines{1e-3, 1e-4, 1e-5};

/// A reading of a cell, earlier and later.
struct MovedReading {
    std::string cell, reading;
    Value before, now;
    std::optional<double> share() const; ///< (now - before) / |before|; nullopt where either is no figure or before is 0
    double size() const;                 ///< |share|; 2 where there is none, above all that is real
};

/// What a cell is to be played with: today's program and machine, and every other input as `inputs` has it, by its hash.
struct CellRequest {
    std::string study, cell;
    CellInputs inputs;
    std::string folder_before; ///< of the night that these inputs are from
};
struct Replayed {
    std::optional<NightReadings> readings;
    std::string why_not = {}; ///< where there are none
};
/// Plays the one cell that tells an input's change from the program's.
using TellApart = std::function<Replayed(const CellRequest&)>;

/// A change of inputs and of program or machine in one night, told apart in one cell.
struct ToldApart {
    struct Part {
        std::string reading;
        Value before, with_earlier_inputs, now; ///< from the first to the second: program and machine; on to the third: inputs
    };
    std::string cell;
    std::vector<Part> parts; ///< readings that moved; empty: not told apart
    std::string why_not;
    bool program_moved = false, inputs_moved = false; ///< beyond rounding, in any of the parts
};

/// What moved in one night in cells with the same causes.
struct HistoryEvent {
    std::size_t night = 0;               ///< in which it was first read
    InputChanges causes;                 ///< against the night before in which the cell was played; empty: nothing that decides changed
    std::vector<MovedReading> moved;     ///< beyond rounding, what decides first, then the largest
    std::set<std::string> cells;         ///< in which a bit changed
    std::size_t within_rounding = 0;     ///< readings that changed by less
    double most_within = 0.0;            ///< of those, the largest share
    std::optional<ToldApart> told_apart; ///< where inputs changed with program or machine
};

/// Readings that crept the same way in the same nights, each time by less than the drift bound.
struct HistoryDrift {
    std::vector<std::size_t> nights;     ///< three or more
    InputChanges causes;                 ///< of all of them, each input once, from its first value to its last
    std::vector<MovedReading> moved;     ///< from before the first of these nights to the last, what decides first, then the largest
    std::optional<std::size_t> exceeded; ///< the first night in which one of them is beyond the bound in sum
};

struct HistoryTimes {
    struct Change {
        std::string cell;
        std::size_t night = 0; ///< the first of the new level
        double ratio = 1.0, p = 1.0;
        InputChanges causes; ///< the system among them
    };
    std::vector<Change> changes; ///< since the base
    std::size_t cells = 0;       ///< whose times were tested
    std::size_t nights = 0;      ///< of the longest series
    double rate = 0.01;          ///< of false discoveries
};

struct NightFrames {
    std::string title, before, after; ///< PNGs, absolute
};

struct HistoryFindings : Findings {
    std::string study;
    std::vector<Night> nights;      ///< of the study, as they were added, up to the one that is looked at
    std::size_t base = 0;           ///< what it is compared with: the last accepted night before it, else the first that read anything
    std::vector<std::size_t> ahead; ///< nights from the base on that are dated after tonight: a clock was wrong
    double drift_bound = 0.005;
    std::vector<HistoryEvent> events; ///< by night
    std::vector<HistoryDrift> drifts;
    HistoryTimes times;
    std::vector<std::string> quiet;                        ///< nights and inputs that changed and moved nothing
    std::vector<std::string> absent;                       ///< cells that one of both nights has not, or did not play
    std::size_t cells_compared = 0, readings_compared = 0; ///< of tonight, with the base
    std::vector<MovedReading> since;                       ///< base against tonight beyond rounding, what decides first, then the largest
    std::size_t bits_moved = 0;                            ///< readings that are not the base's to the last bit
    std::map<std::pair<std::string, std::string>, double> aim_effects; ///< what 0.1° does tonight, by cell and reading; where it is known
    std::map<std::string, NightReadings> replays;                      ///< what was played tonight to tell causes apart, by cell
    std::vector<NightFrames> frames;
    std::string no_frames; ///< why there are none, or not all

    std::string when(std::size_t night) const; ///< when_of
    const Night& tonight() const { return nights.back(); }
    const Night& before() const { return nights[base]; }
    bool is_first() const { return base + 1 == nights.size(); } ///< nothing before it read anything
    bool is_accepted() const { return before().accepted; }
    bool nothing_changed() const { return events.empty() && drifts.empty() && times.changes.empty(); } ///< in what is compared
    /// Changes came and went: tonight is the base to the last bit.
    bool came_back() const { return !nothing_changed() && times.changes.empty() && cells_compared > 0 && bits_moved == 0; }
    /// What --fail-on-change asks: whether tonight is another than the base or cannot be compared with it. Whoever accepts a night accepts
    /// its changes; a first night has no base.
    bool is_off_base() const { return !is_first() && !tonight().accepted && !((nothing_changed() || came_back()) && absent.empty()); }
};

struct HistoryOptions {
    double drift_bound = 0.005; ///< relative, in sum; and what one night's step of a drift stays below
    double rate = 0.01;         ///< of false discoveries among changes of times
    TellApart tell_apart = {};  ///< where there is none, the reason is told
};

/// Looks at the last of the nights, all of one study, in the order in which they were added, at least one.
HistoryFindings explain_nights(std::vector<Night> nights, const HistoryOptions& options = {});

/// A night's date, with the time where several have that date, to the second where it must be.
std::string when_of(const std::vector<Night>& nights, std::size_t night);

/// A cell in all nights that lead to the last one: at each step back the latest earlier night of the same device class that played it;
/// where there is none, of another. Not beyond `first`. Oldest first; empty where the last night did not play it.
std::vector<std::size_t> chain_of(const std::vector<Night>& nights, const std::string& cell, std::size_t first);

/// Whether a reading changed: against what rounding of a step with these causes allows. `other`: the figure whose exactness it tells.
bool is_beyond(const Value& before, const Value& now, double other, const InputChanges& causes);

/// Of the nights that lead to the last one (chain_of) those on its CPU in which the cell was timed: a device class has fast CPUs and slow
/// ones.
std::vector<std::size_t> timed_nights(const std::vector<Night>& nights, const std::string& cell);
HistoryTimes changes_of_times(const std::vector<Night>& nights, std::size_t base, double rate);

/// Splits what inputs and program or machine did together in one night.
ToldApart tell_apart(const HistoryFindings& findings, const HistoryEvent& event, const TellApart& play,
                     std::map<std::string, NightReadings>& replays);

} // namespace fernlicht
