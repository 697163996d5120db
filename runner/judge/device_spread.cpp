#include "runner/judge/device_spread.h"

#include "metrics/statistics/statistics.h"

#include <map>
#include <utility>

namespace fernlicht {
namespace {

/// What tells readings apart.
using Name = std::pair<ReadingKey, int>;
using Values = std::map<Name, std::vector<double>>;

Values values_of(const AcceptedReference& reference) {
    Values values;
    for (const AcceptedReading& reading : reference.readings)
        if (const auto mean = reading.mean.figure())
            values[{reading.key, reading.tick}].push_back(*mean);
    return values;
}

} // namespace

DeviceSpread spread_over_devices(const std::filesystem::path& store, const std::vector<StoredReference>& all, const ReferenceKey& key,
                                 const std::string& but) {
    std::map<std::string, Values> by_device;
    DeviceSpread spread;
    for (const StoredReference& entry : all) {
        const std::string device = device_text(entry.key);
        if (!same_but_device(entry.key, key) || device == but)
            continue;
        spread.entries.push_back(entry);
        for (const auto& [name, values] : values_of(load_reference(store, entry)))
            by_device[device][name].insert(by_device[device][name].end(), values.begin(), values.end());
    }
    spread.devices = by_device.size();
    Values means;
    for (const auto& [device, values] : by_device)
        for (const auto& [name, samples] : values)
            means[name].push_back(spread_of(samples)->mean);
    for (const auto& [name, samples] : means)
        if (samples.size() == spread.devices) {
            const Spread over = *spread_of(samples);
            spread.readings.push_back(
                {name.first, name.second, over.mean, static_cast<int>(over.count), over.standard_deviation * over.standard_deviation});
        }
    return spread;
}

} // namespace fernlicht
