// A run against accepted results. Changes no baseline.
#pragma once

#include "runner/judge/baseline_difference.h"
#include "runner/judge/baseline_store.h"

namespace fernlicht {

/// Passes, and says that results of other device classes judged.
inline constexpr const char* other_device_class = "baseline device";

/// What was played as it would be accepted; frames' paths lead into the run's folder, their hashes are left out.
Baseline results_of(const PlayedCell& played, const RunContext& context, const std::filesystem::path& run_folder,
                    const std::string& technique);

/// What several device classes gave for the same drive, lamp set, technique and inputs: how much a device decides.
struct DeviceSpread {
    std::size_t devices = 0; ///< classes with accepted results
    /// Readings that all of them have: mean over the classes, their number, and the variance between them (n - 1). A class with several
    /// results counts once, by their mean.
    std::vector<AcceptedReading> readings;
    std::vector<StoredBaseline> entries; ///< all results behind it
};

/// Over all device classes but `but` ("" for all), as key_text's device. Throws InputError as load_baseline.
DeviceSpread spread_over_devices(const std::filesystem::path& store, const std::vector<StoredBaseline>& all, const BaselineKey& key,
                                 const std::string& but = "");

/// Verdicts on all frames and readings against what was accepted for this drive, lamp set, technique, device class and inputs. Where
/// several results are accepted, one that agrees in everything decides, and the text says which; else the nearest, by the number of
/// things that differ. What differs gets a verdict of its own; what agrees is summed up in one. Nothing accepted, a damaged baseline,
/// a frame or reading that only one side has: failed. A reading that varies too much to tell: not measured.
/// `across_devices`: where nothing is accepted for this device class, readings are judged by what other classes gave (one by the
/// tolerance alone, several by their spread on top), frames by the nearest of them, and a verdict called other_device_class says so.
/// Never where something is accepted: within a class the same bytes are promised, and more would hide mistakes.
std::vector<Verdict> judge_against_baselines(const PlayedCell& played, const RunContext& context, const std::filesystem::path& run_folder,
                                             const std::filesystem::path& baselines_folder, const std::string& technique,
                                             bool across_devices = false, const BaselineTolerance& tolerance = {});

} // namespace fernlicht
