// The smallest change of a lamp that improves readings over drives as far as asked.
#pragma once

#include "runner/experiments/improve/improve_result.h"
#include "runner/play/play.h"
#include "scenarios/lamps/lamp_file.h"

namespace fernlicht {

/// "[DRIVE:]KEY by AMOUNT", "KEY", "KEY within AMOUNT", "KEY at least FIGURE", "KEY at most FIGURE"; an amount may be in per cent.
struct ImproveDemand {
    enum class Kind { gain, within, at_least, at_most } kind = Kind::gain;
    std::string text, drive; ///< as typed; "" for every drive
    ReadingKey reading;
    double amount = 0.0;
    bool in_percent = false;
};
/// Throws InputError naming --gain or --keep.
ImproveDemand gain_of(const std::string& text);
ImproveDemand kept_of(const std::string& text);

struct NamedDrive {
    std::string name;
    Drive drive; ///< its first lamp set is played
};

struct ImproveRequest : ExperimentRequest<ImproveResult> {
    std::filesystem::path lamp;
    LampReadOptions lamp_options;
    std::string extension = ".ies"; ///< of the lamp that is written
    /// All drives with this lamp in place of the one that is improved. Asked twice.
    std::function<std::vector<NamedDrive>(const std::filesystem::path& lamp)> drives;
    TickRange ticks;
    std::vector<ImproveDemand> demands;
    TableLimits limits;
    std::string regulation;             ///< "" for none
    std::vector<std::string> kept_rows; ///< of it, which get no worse
    bool left_hand_traffic = false;
    std::optional<double> floor_cd; ///< nullopt: a thousandth of the lamp's peak
    double narrowest_deg = 1.0;
};

/// Needs no device. Throws InputError for readings without a gradient or that a drive does not measure.
ImproveResult run_improve(const ImproveRequest& request);

} // namespace fernlicht
