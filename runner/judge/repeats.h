// The same lamp set played several times in one run: whether every byte agrees, times apart.
#pragma once

#include "runner/findings/report.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>

namespace fernlicht {

/// Compares each play with the first, then says so in it. The first must outlive it.
class RepeatFold {
  public:
    /// All that is reported of a play but readings, moments and times.
    using Told = std::function<nlohmann::ordered_json(const PlayedCell&)>;
    /// `folder` is where the frames of the first play lie.
    RepeatFold(const PlayedCell& first, std::filesystem::path folder, Told told);

    /// True where nothing differs: readings, moments and all else in report.json to the last bit, lux maps, the bytes of all stored files,
    /// and the verdicts on limits. Times do not count, other than by a verdict that they turn.
    bool add(const PlayedCell& again, const std::filesystem::path& folder);

    /// Sets `repeats` of the first play and adds the verdict "repeats": pass, flaky with what differs, or not measured where fewer than the
    /// `asked` plays were made.
    void finish(PlayedCell& first, int asked) const;

  private:
    const PlayedCell* first_;
    std::filesystem::path folder_;
    Told told_;
    int plays_ = 1;
    std::vector<std::string> differ_;
    std::map<std::size_t, std::vector<double>> values_; ///< by reading: of the plays that measured it
    std::vector<std::size_t> varying_;                  ///< readings that differ
};

/// Where two texts in JSON differ first, as "extents.rendered[0].area_m2[3]: 12.5, at first 12.4"; "" where they are the same.
std::string first_difference(const std::string& first, const std::string& again);

} // namespace fernlicht
