#include "scenarios/drives/play/beam_masks.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/masked_beam.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double mask_steps = 16.0; ///< levels of a file's windows are rounded to this part: each is a beam of its own
constexpr double most_mask_bytes = 2.0 * 1024.0 * 1024.0 * 1024.0; ///< of the beams that are drawn with, in all

/// What a beam takes when it is drawn with, here and on the GPU: a float each 0.05 degrees, or as `beams` of the drive says.
double beam_bytes(const CandelaTable& table, const std::optional<BeamTexels>& texels) {
    if (texels)
        return static_cast<double>(texels->width) * texels->height * (4.0 + texels->bits / 8.0);
    const auto steps = [](const std::vector<double>& axis) { return (std::min(axis.back(), 90.0) - std::max(axis.front(), -90.0)) / 0.05; };
    return 8.0 * std::clamp(steps(table.h_deg) * steps(table.v_deg), 4.0, 4.0 * 1024.0 * 1024.0);
}

} // namespace

BeamMasks::BeamMasks(const Drive& drive, const Variant& variant) : drive_(drive), variant_(variant) {}

void BeamMasks::add(ControlRun& run) {
    if (!variant_.control || !variant_.control->glare_free)
        return;
    run.masks.resize(run.lamps.size());
    for (const SegmentedLamp& segmented : variant_.control->glare_free->lamps) {
        const std::size_t lamp = run.lamp(segmented.name);
        for (const auto& [from_s, exact] : run.runs[lamp].segments) {
            std::vector<double> levels;
            for (const double level : exact)
                levels.push_back(std::round(level * mask_steps) / mask_steps);
            std::shared_ptr<const LampFile>& file = known_[{lamp, levels}];
            if (!file && std::ranges::any_of(levels, [](double level) { return level != 1.0; })) {
                LampFile dark = *variant_.lamps[lamp].file;
                dark.table = masked(dark.table, segmented.windows_deg, levels);
                bytes_ += beam_bytes(dark.table, drive_.beams);
                ++states_;
                if (bytes_ > most_mask_bytes)
                    throw InputError(
                        {},
                        fmt::format("more than {} states of the glare-free beam's windows, {:.0f} MiB each", states_ - 1,
                                    beam_bytes(dark.table, drive_.beams) / 1048576.0),
                        fmt::format("at most {:.0f} MiB of them in all: fewer windows, or coarser beams (beams: {{width, height, "
                                    "bits}} of the drive)",
                                    most_mask_bytes / 1048576.0));
                file = std::make_shared<const LampFile>(std::move(dark));
            }
            run.masks[lamp].emplace_back(from_s, file);
        }
    }
}

std::vector<std::string> BeamMasks::notes() const {
    if (!variant_.control || !variant_.control->glare_free)
        return {};
    return {fmt::format("glare-free high beam: {} states of windows, {:.0f} MiB of beams", states_, bytes_ / 1048576.0)};
}

} // namespace fernlicht
