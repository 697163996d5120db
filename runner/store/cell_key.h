// The key of a cell: the hash of all that decides its figures.
#pragma once

#include "runner/findings/cell_inputs.h"
#include "runner/findings/findings.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

/// How a cell is played, beside its drive.
struct CellSettings {
    int first_tick = 0, last_tick = 0;
    bool accuracy = true;
    int repeats = 1;
};

/// Of a drive with one lamp set: the drive by what is off its defaults, its road, lamps that it uses, and all other files by their
/// contents, and how it is played. `road`, `others`: opened for the road and for all else but lamps, as its stage tells. Neither paths nor
/// titles, limits, comments or names of keys count.
CellInputs cell_inputs(const Drive& drive, const FilesRead& road, const FilesRead& others, const CellSettings& settings);

/// This program's sources that compute, libraries, and the class of the device.
CellInputs machine_inputs(const RunContext& context, bool accuracy);

/// 32 hexadecimal digits. Names of files do not count, their order does.
std::string cell_key(const CellInputs& inputs);

/// The folders of this program whose sources decide figures, and the hash of each as it was built.
const std::vector<std::pair<std::string, std::string>>& program_sources();

} // namespace fernlicht
