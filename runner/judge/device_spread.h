// What several classes of device gave for the same drive, lamp set, technique and inputs: how much a device decides.
#pragma once

#include "runner/judge/reference_store.h"

namespace fernlicht {

struct DeviceSpread {
    std::size_t devices = 0; ///< classes with accepted results
    /// Readings that all of them have: mean over the classes, their number, and the variance between them (n - 1). A class with several
    /// results counts once, by their mean.
    std::vector<AcceptedReading> readings;
    std::vector<StoredReference> entries; ///< all results behind it
};

/// Over all classes of device but `but` ("" for all), as key_text's device. Throws InputError as load_reference.
DeviceSpread spread_over_devices(const std::filesystem::path& store, const std::vector<StoredReference>& all, const ReferenceKey& key,
                                 const std::string& but = "");

} // namespace fernlicht
