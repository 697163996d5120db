#include "runner/play/display_step.h"

#include "metrics/display/display_colour.h"
#include "runner/files/picture_file.h"
#include "runner/play/display_pipeline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {

DisplayStep::DisplayStep(const Drive& drive)
    : drive_(drive), after_drawing_(is_shown_after_drawing(drive.display, drive.tone_mapper)), written_(std::make_shared<Written>()) {
    if (const auto& adaptation = drive.display.adaptation)
        adapted_.emplace(adaptation->brighter_s, adaptation->darker_s);
    if (drive.display.profile && !is_srgb(*drive.display.profile))
        icc_ = icc_profile(*drive.display.profile);
}

FrameOutputs DisplayStep::with_light(FrameOutputs outputs, const View& view, bool stored, bool drivers) const {
    if (after_drawing_ && outputs.colour && view.projection == Projection::perspective) {
        outputs.light = stored || (drivers && adapted_);
        outputs.ids = outputs.ids || (outputs.light && drive_.display.sky);
    }
    return outputs;
}

void DisplayStep::see(const Frame& frame) {
    if (!adapted_ || frame.light.empty())
        return;
    LuminanceHistogram histogram;
    for (const glm::vec3& light : frame.light.pixels())
        histogram.add(glm::dot(glm::dvec3(light), glm::dvec3(0.2126, 0.7152, 0.0722)));
    adapted_->see(histogram.log_mean_cdm2(), drive_.step_s);
    if (first_cdm2_ == 0.0)
        first_cdm2_ = adapted_->cdm2();
}

ToneMapper DisplayStep::mapper() const {
    ToneMapper mapper = drive_.tone_mapper;
    if (!adapted_ || first_cdm2_ == 0.0)
        return mapper;
    const double moved = adapted_->cdm2() / first_cdm2_;
    mapper.l_max_cdm2 *= moved;
    for (ToneKnot& knot : mapper.curve)
        knot.ln_luminance += std::log(moved);
    return mapper;
}

WritePicture DisplayStep::writer(const Moment& moment) const {
    const PictureTags tags{shown_by(drive_.display, drive_.tone_mapper), icc_};
    if (!after_drawing_)
        return [tags](const Frame& frame, const View&, const std::filesystem::path& path) { write_png(frame.colour, tags, path); };
    return [tags, mapper = mapper(), display = drive_.display, written = written_, seed = drive_.seed,
            lit_sky = drive_.display.sky ? std::optional(moment) : std::nullopt](const Frame& frame, const View& view,
                                                                                 const std::filesystem::path& path) {
        if (frame.light.empty()) {
            write_png(frame.colour, {shown_by({}, mapper), ""}, path);
            return;
        }
        const ShownPicture shown = show_frame(frame, lit_sky, view, display, mapper, seed, path);
        PictureTags own = tags;
        own.shown_by = shown_by(display, mapper);
        write_png(shown.codes, shown.bits, own, path);
        const std::optional<double> mean_cdm2 =
            display.profile && display.profile->pixel_deg() ? std::optional(mean_shown_cdm2(*display.profile, shown.codes)) : std::nullopt;
        const std::lock_guard lock(written->mutex);
        if (mean_cdm2)
            written->mean_cdm2[view.name][path] = *mean_cdm2;
        for (const auto& [name, seconds] : shown.stage_s) {
            const std::string pass = "display: " + name;
            auto known = std::ranges::find(written->stages, pass, &PassTime::name);
            if (known == written->stages.end())
                known = written->stages.insert(known, PassTime{pass, {}});
            known->seconds.push_back(seconds);
        }
    };
}

std::vector<PassTime> DisplayStep::times() const {
    const std::lock_guard lock(written_->mutex);
    return written_->stages;
}

std::shared_ptr<const SeenDisplay> DisplayStep::seen() const {
    const auto& profile = drive_.display.profile;
    if (!profile || !profile->pixel_deg())
        return nullptr;
    SeenDisplay seen{profile->name, *profile->viewing_distance_m, *profile->pixel_pitch_mm, {}};
    const std::lock_guard lock(written_->mutex);
    for (const View& view : drive_.views) {
        if (view.projection != Projection::perspective)
            continue;
        SeenView row{view.name, seen_size(view.vertical_fov_rad, view.height_px, seen.pixel_pitch_mm, seen.viewing_distance_m), 0,
                     std::nullopt};
        double sum = 0.0;
        for (const auto& [path, mean_cdm2] : written_->mean_cdm2[view.name]) {
            sum += mean_cdm2;
            ++row.pictures;
        }
        if (row.pictures > 0)
            row.mean_cdm2 = sum / row.pictures;
        seen.views.push_back(row);
    }
    return std::make_shared<const SeenDisplay>(std::move(seen));
}

} // namespace fernlicht
