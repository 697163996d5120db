#include "runner/play/live/live_drawing.h"

#include "runner/play/lux_map.h"
#include "runner/play/preparation.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/values/errors.h"

#include <algorithm>

namespace fernlicht {
namespace {

constexpr std::size_t max_live_maps = 64; ///< the page shows twelve

/// The lamp set with all lamps as their switches have them, at rest: what can be compiled beforehand.
LampSet at_rest(const LampSet& lamp_set) {
    LampSet resting = lamp_set;
    Motion motion = lamp_set.motion ? *lamp_set.motion : Motion{};
    motion.control.emplace();
    for (const MountedLamp& lamp : lamp_set.lamps)
        motion.control->lamps.push_back(lamp.name);
    motion.control->runs.resize(lamp_set.lamps.size());
    motion.control->has_modes.resize(lamp_set.lamps.size());
    resting.motion = std::make_shared<const Motion>(std::move(motion));
    return resting;
}

} // namespace

LiveDrawing::LiveDrawing(const Stage& stage, const LampSet& lamp_set, Device& device, std::filesystem::path folder)
    : stage_(stage), set_(stage.drive.name + "-" + lamp_set.name), folder_(std::move(folder)),
      renderer_(device, stage.scene, settings_for(stage.drive, settings_for(device, false))), display_(stage.drive) {
    refuse_unfitted_tone_mapper(stage.drive);
    if (stage.drive.display.adaptation)
        throw InputError({stage.drive.file, 0, 0, "display.adaptation"},
                         "white that follows every picture in a live drive, which leaves some out",
                         "none, or a replay of the recording by `fernlicht run --can-log`");
    Drive scripted = stage.drive;
    scripted.bus_motion.reset(); // nobody knows yet how the bus moves the car
    prepare(renderer_, scripted, stage.route, at_rest(lamp_set), {}, Foreseen::nothing);
}

void LiveDrawing::draw(const LivePicture& picture) {
    const Drive& drive = stage_.drive;
    const Moment& moment = picture.moment;
    for (std::size_t i = 0; i < (picture.captured ? drive.views.size() : std::min<std::size_t>(1, drive.views.size())); ++i) {
        const View& view = drive.views[i];
        const FrameOutputs outputs = picture.captured ? stored_results(view, drive.capture) : FrameOutputs{.colour = true};
        Frame frame = renderer_.draw(moment, view, display_.with_light(outputs, view, picture.captured, i == 0));
        if (!picture.captured)
            continue;
        if (view.projection == Projection::map && !frame.illuminance_lx.empty() && maps_.size() < max_live_maps)
            maps_.push_back(lux_map_of(frame, moment, view, stage_.route, drive.bumper_m));
        frames_.push_back(store_frame(writers_, folder_, set_, drive.capture, std::move(frame), moment, view, display_.writer(moment)));
    }
    ++drawn_;
    captured_ += picture.captured ? 1 : 0;
}

void LiveDrawing::draw_all(LivePictures& pictures) {
    while (const std::optional<LivePicture> picture = pictures.take())
        draw(*picture);
    writers_.finish();
}

void LiveDrawing::finish(PlayedCell& played) {
    std::ranges::stable_sort(frames_, {}, &StoredFrame::tick);
    std::ranges::stable_sort(maps_, {}, &LuxMap::tick);
    played.frames = std::move(frames_);
    for (const std::size_t i : spread_over(maps_.size(), max_pictured_moments))
        played.maps.push_back(std::move(maps_[i]));
    std::ranges::copy(display_.times(), std::back_inserter(played.passes));
}

} // namespace fernlicht
