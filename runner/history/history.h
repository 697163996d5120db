// What nights of a study read, over months, in one SQLite file (docs/history.md). Only this folder knows how it is stored.
#pragma once

#include "metrics/readings/value.h"
#include "runner/findings/cell_inputs.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fernlicht {

/// By name; all of a whole drive but times of this machine.
using NightReadings = std::map<std::string, Value>;

struct NightCell {
    std::string name, drive, lamp, technique, condition;
    std::string failed = {}; ///< why it was not played; "" where it was
    /// What decided its figures, and what it read. Cells whose inputs or readings are equal to the last bit share one object; never
    /// nullptr.
    std::shared_ptr<const CellInputs> inputs = std::make_shared<CellInputs>();
    std::shared_ptr<const NightReadings> readings = std::make_shared<NightReadings>();
    /// What it read when it was played again with that night's program and machine and with the inputs of the night before it; nullptr:
    /// not.
    std::shared_ptr<const NightReadings> with_earlier_inputs = nullptr;
    std::optional<double> frame_s = {}; ///< timed by itself that night, never from a store
};

struct Night {
    std::int64_t number = 0; ///< in its file, from 1; 0: in no file
    std::string study;
    std::string played_utc; ///< when it began: 2026-01-31T22:15:00Z
    std::string folder;     ///< where its report and frames were written, absolute
    bool accepted = false;
    std::string note;                ///< why it was accepted
    CellInputs machine;              ///< device, driver, CPU, system, libraries and program, as the night's context names them
    std::vector<std::string> decide; ///< the study's deciding readings, by name or pattern
    std::vector<NightCell> cells;    ///< in the study's order

    std::string date() const { return played_utc.substr(0, 10); }
    /// nullptr: it has none. `likely`: where it stands as a rule.
    const NightCell* cell(const std::string& name, std::size_t likely = 0) const;
    bool has_readings() const; ///< of any cell
};

class History {
  public:
    enum class For {
        reading,   ///< changes nothing
        collecting ///< makes the file where there is none; waits while another process collects
    };
    /// Throws InputError for what is no history, is damaged or was written by a newer fernlicht, DeviceError where the disk refuses.
    History(const std::filesystem::path& file, For what);
    ~History();

    /// How the file keeps its changes safe: "wal" or "delete" (a rollback journal).
    std::string journal() const;

    struct Added {
        std::int64_t number = 0;
        /// False: a night of this study, time and folder is there, and stays as it is. One of which fewer cells failed by now is written
        /// anew.
        bool is_new = true;
    };
    Added add(const Night& night);
    /// Throws InputError where there is no such night.
    void accept(std::int64_t number, const std::string& note);
    void withdraw(std::int64_t number); ///< as if it had not been accepted
    /// In the order in which they were added, as clocks may be wrong; of all studies for "".
    std::vector<Night> nights(const std::string& study = "") const;

    struct Pruned {
        std::vector<Night> nights;     ///< that are gone, without their cells
        std::size_t kept_accepted = 0; ///< that would have gone, and stay because they are accepted
    };
    /// Removes nights of each study but the `keep` that were added last, or those dated before `before`, where it is no "": one of both.
    /// Accepted nights stay. `dry`: only says what would go.
    Pruned prune(std::optional<std::size_t> keep, const std::string& before, bool dry);

  private:
    struct Tables;
    std::unique_ptr<Tables> tables_;
};

/// $XDG_DATA_HOME/fernlicht/history.db, else that below ~/.local/share; "" where neither variable is set.
std::filesystem::path default_history_file();

/// Each brings a file from one version to the next; `history_mark` tells that it is ours.
std::span<const char* const> history_steps();
inline constexpr std::int64_t history_mark = 0x6665726e;

} // namespace fernlicht
