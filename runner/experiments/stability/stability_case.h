// Extreme and degenerate inputs as rows of a table: each says what could break, measures how wrong it gets, and has a bound with a reason.
#pragma once

#include "renderer/device.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// What the cases share: the device, opened when the first case draws, and a folder for the files that they write.
class StabilityBench {
  public:
    /// The folder is made, with those above it, when the first file is asked for.
    StabilityBench(std::string backend, std::filesystem::path folder, bool search_long)
        : thorough(search_long), backend_(std::move(backend)), folder_(std::move(folder)) {}

    /// Throws DeviceError, InputError.
    Device& device();
    const std::string& backend() const { return backend_; }
    /// Gives the device back, for a case that plays a drive, which opens its own: two must not be open at a time.
    void close_device() { device_.reset(); }
    bool drew() const { return device_.has_value(); }
    std::string folder() const { return folder_.string(); }
    /// A path in the folder, for a case to write to.
    std::filesystem::path file(const std::string& name);
    /// Writes a text there.
    std::filesystem::path write(const std::string& name, std::string_view content);

    const bool thorough; ///< searches take ten times as long
    static constexpr std::uint64_t seed = 1;

  private:
    std::string backend_;
    std::filesystem::path folder_;
    std::optional<Device> device_;
};

/// The worst of what a case tried.
struct Found {
    double error = 0.0; ///< in the case's unit
    std::string where;  ///< at which of the values tried it was worst
    int trials = 0;
    int judged = 0; ///< pixels or other values in all of them

    /// Takes a trial's error when it is worse. One that is not finite is worse than all others and stays.
    void add(double trial_error, const std::string& trial, int values = 1);
};

struct StabilityCase {
    using Measure = std::function<void(StabilityBench&, Found& worst)>;

    std::string family, name; ///< "lamp", "distance"; together "lamp/distance"
    std::string could_break;
    double bound = 0.0; ///< on the error, in `unit`
    std::string unit;
    std::string reason; ///< of the bound, or of the marking that the case holds
    Measure measure;

    std::string full_name() const { return family + "/" + name; }
};

struct StabilityRow {
    const StabilityCase* of = nullptr;
    Found found;
    bool passed = false;
    double seconds = 0.0;
};

/// Measures one case. An error that is not finite fails, and so does a case that throws: `where` then tells what was thrown. DeviceError of
/// a device that cannot be opened is thrown on.
StabilityRow judge(const StabilityCase& one, StabilityBench& bench);

/// All cases, family by family.
const std::vector<StabilityCase>& stability_cases();

struct StabilityResult : Findings {
    std::vector<StabilityRow> rows;
    std::string device; ///< "" when nothing was drawn
};

/// One case, as soon as it is judged.
Document document(const StabilityRow& row);
/// A row a case, and how many passed. No times: the same on every run of one machine.
Document document(const StabilityResult& result);
std::string stability_json(const StabilityResult& result);

// The families, one file each.
std::vector<StabilityCase> lamp_cases(), camera_cases(), table_cases(), tone_cases(), geometry_cases(), shadow_cases(),
    shadow_plane_cases(), shadow_map_cases(), shadow_volume_cases(), road_cases(), image_cases(), time_cases(), number_cases(),
    motion_cases(), weather_cases(), traffic_cases(), equation_cases();

} // namespace fernlicht
