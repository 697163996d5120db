// A run against accepted results: frames pixel by pixel on the linear pictures, readings by relative difference. Changes no reference.
#pragma once

#include "runner/report/report.h"

namespace fernlicht {

/// Within one class of device the same bytes are promised. These tolerances forgive what another patch level of a driver or a
/// library may round otherwise, and nothing that light could explain: 2 % more light exceeds them twentyfold.
struct ReferenceTolerance {
    double relative = 1e-3;          ///< of the accepted value
    double absolute = 1e-4;          ///< lx, cd/m2 or the reading's unit: where the accepted value is next to nothing
    double percent_of_pixels = 0.01; ///< may lie beyond: edges where one triangle wins over another
};

/// Verdicts on all frames and readings against what was accepted for this drive, lamp set, technique and class of device. What differs
/// gets a verdict of its own; what agrees is summed up in one. Nothing accepted, a damaged reference, a frame or reading that only one
/// side has: failed.
std::vector<Verdict> judge_against_references(const PlayedVariant& played, const RunContext& context,
                                              const std::filesystem::path& run_folder, const std::filesystem::path& references_folder,
                                              const std::string& technique, const ReferenceTolerance& tolerance = {});

} // namespace fernlicht
