#include "runner/experiments/film/film_run.h"

#include "runner/findings/extent_keys.h"
#include "runner/findings/figures.h"
#include "runner/play/capture.h"
#include "runner/play/display_pipeline.h"
#include "runner/play/extent_fold.h"
#include "runner/play/lux_map.h"
#include "runner/play/preparation.h"
#include "runner/play/progress.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/stage.h"
#include "scenarios/drives/edits/adapting_white.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <set>

namespace fernlicht {
namespace {

constexpr double usual_threshold_lx = 5.0;
constexpr std::size_t frames_waiting = 2; ///< drawn, and not yet taken

/// What a film does not show is not computed. Of extents one threshold and one distance are told.
Drive as_filmed(Drive drive, const FilmRequest& request) {
    drive.step_s = request.rate.frame_s();
    drive.probes.clear();
    drive.limits.clear();
    drive.seeing = {};
    if (!request.overlays.readings) {
        drive.extent.reset();
        return drive;
    }
    if (!drive.extent)
        throw InputError({drive.file, 0, 0, "measure.extent"}, "found none", "one, for --overlay readings");
    std::vector<double>& thresholds = drive.extent->thresholds_lx;
    const bool usual = std::ranges::find(thresholds, usual_threshold_lx) != thresholds.end();
    thresholds = {usual ? usual_threshold_lx : thresholds[thresholds.size() / 2]};
    drive.extent->width_at_m.resize(std::min<std::size_t>(1, drive.extent->width_at_m.size()));
    return drive;
}

/// A drive on its stage, ready to be drawn with any of its lamp sets.
class FilmedDrive {
  public:
    FilmedDrive(const Stage& stage, Device& device, const RendererSettings& settings)
        : stage_(stage), renderer_(device, stage.scene, settings_for(stage.drive, settings)), display_(stage.drive) {
        if (stage.drive.extent)
            extents_.emplace(stage.drive, stage.route);
        for (const Mesh& mesh : stage.scene.meshes)
            is_ground_.push_back(std::ranges::all_of(
                mesh.batches, [&](const Batch& batch) { return is_ground(stage.scene.materials[batch.material].kind); }));
    }

    const Stage& stage() const { return stage_; }
    Renderer& renderer() { return renderer_; }
    const DisplayStep& display() const { return display_; }
    const std::optional<ExtentFold>& extents() const { return extents_; }

    Moment moment_of(int frame, const LampSet& lamp_set) const {
        const State state = state_at(std::min(frame, tick_count(stage_.drive) - 1), stage_.drive);
        return moment_at(state, stage_.drive, stage_.route, lamp_set);
    }

    bool is_ground_mesh(std::uint32_t id) const { return id > 0 && id <= is_ground_.size() && is_ground_[id - 1]; }

  private:
    const Stage& stage_;
    Renderer renderer_;
    DisplayStep display_;
    std::optional<ExtentFold> extents_;
    std::vector<bool> is_ground_;
};

struct FilmedPanel {
    std::size_t drive = 0;
    const LampSet* lamp_set = nullptr;
    std::string title;
};

/// A panel of one frame as it was drawn; what is made of it is left to another thread.
struct DrawnPanel {
    const FilmedDrive* drive = nullptr;
    std::string title;
    double speed_mps = 0.0;
    View view;
    Camera camera;
    Frame frame;
    LuxMap map;
    std::optional<ExtentDrawing> extent;
    std::string picture;          ///< what a run would store it as
    std::optional<Moment> moment; ///< where its sky is lit
};

std::string shown_name(const Drive& drive) { return drive.title.empty() ? drive.name : drive.title; }

std::vector<FilmedPanel> panels_of(const std::deque<Stage>& stages, const std::vector<std::string>& wanted) {
    std::vector<FilmedPanel> panels;
    std::set<std::string> known;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const Drive& drive = stages[i].drive;
        const auto add = [&](const LampSet& lamp_set) {
            panels.push_back({i, &lamp_set, stages.size() == 1 ? lamp_set.name : shown_name(drive) + ": " + lamp_set.name});
        };
        for (const LampSet& lamp_set : drive.lamp_sets) {
            known.insert(lamp_set.name);
            if (wanted.empty())
                add(lamp_set);
        }
        for (const std::string& name : wanted)
            for (const LampSet& lamp_set : drive.lamp_sets)
                if (lamp_set.name == name)
                    add(lamp_set);
    }
    for (const std::string& name : wanted)
        if (!known.contains(name))
            throw InputError({{}, 0, 0, "--lamp-sets"}, "found '" + printable(name) + "'",
                             fmt::format("one of {}", fmt::join(known, ", ")));
    return panels;
}

/// One exposure, and one that a video says rightly.
void check_shown(const std::deque<Stage>& stages) {
    const Drive& first = stages.front().drive;
    for (const Stage& stage : stages) {
        const Drive& drive = stage.drive;
        if (drive.display.adaptation)
            throw InputError({drive.file, 0, 0, "display.adaptation"}, "white that follows each lamp set's pictures",
                             "one exposure for all panels of a film");
        if (drive.display.profile && !is_srgb(*drive.display.profile))
            throw InputError({drive.file, 0, 0, "display.profile"}, "found '" + printable(drive.display.profile->name) + "'",
                             "srgb, for which films are made");
        if (!(drive.tone_mapper == first.tone_mapper && drive.display == first.display))
            throw InputError({drive.file, 0, 0, "tone_mapper"},
                             fmt::format("pictures shown by '{}', those of {} by '{}'", shown_by(drive.display, drive.tone_mapper),
                                         printable(first.file.string()), shown_by(first.display, first.tone_mapper)),
                             "one tone mapper and display for all panels of a film");
    }
}

/// Beside what is shown nothing is drawn, unless an eye or a windscreen spreads its light.
View view_in(const FilmPanelBoxes& boxes, const Drive& drive, const std::optional<double>& vertical_fov_rad) {
    View view = at_size(*driver_view(drive), boxes.picture.width, boxes.picture.height);
    view.vertical_fov_rad = vertical_fov_rad.value_or(view.vertical_fov_rad);
    if (!(boxes.shown == boxes.picture) && !is_shown_after_drawing(drive.display, drive.tone_mapper))
        view.looked_at = {{boxes.shown.x - boxes.picture.x, boxes.shown.y - boxes.picture.y, boxes.shown.width, boxes.shown.height}};
    return view;
}

View map_in(const PixelBox& box) {
    const double beside_m = 0.5 * box.height * (film_map_ahead_m + film_map_behind_m) / box.width;
    return map_of("film's map", -film_map_behind_m, film_map_ahead_m, beside_m, box.height, box.width);
}

DrawnPanel drawn(FilmedDrive& filmed, const FilmedPanel& panel, const FilmPanelBoxes& boxes, int frame, const FilmRequest& request) {
    const FilmOverlays& overlays = request.overlays;
    const Drive& drive = filmed.stage().drive;
    Renderer& renderer = filmed.renderer();
    const Moment moment = filmed.moment_of(frame, *panel.lamp_set);
    DrawnPanel out{&filmed, panel.title, moment.speed_mps, view_in(boxes, drive, request.vertical_fov_rad), {}, {}, {}, {}, {}, {}};
    out.picture = frame_stem(drive.name + "-" + panel.lamp_set->name, out.view, moment.tick) + ".png";
    if (drive.display.sky)
        out.moment = moment;
    out.camera = camera_of(moment, out.view);
    FrameOutputs outputs{.colour = true};
    outputs.illuminance = outputs.depth = outputs.ids = overlays.isolux;
    outputs = filmed.display().with_light(outputs, out.view, true, true);
    Pending picture = renderer.submit(moment, out.view, outputs), above;
    const View map = map_in(boxes.map.height > 0 ? boxes.map : PixelBox{0, 0, 1, 1});
    if (boxes.map.height > 0)
        above = renderer.submit(moment, map, {.illuminance = true});
    if (filmed.extents())
        out.extent = filmed.extents()->draw(
            moment, [&](const Moment& m, const View& view, const FrameOutputs& wanted) { return renderer.submit(m, view, wanted); });
    out.frame = picture();
    if (above)
        out.map = lux_map_of(above(), moment, map, filmed.stage().route, drive.bumper_m);
    return out;
}

/// "5 lx on targets: reach 62 m, 11.4 m wide at 20 m"
std::string told_readings(const DrawnPanel& drawn) {
    if (!drawn.extent)
        return "";
    const ExtentParameters& asked = *drawn.drive->stage().drive.extent;
    const std::vector<LaneExtent> extents = drawn.drive->extents()->rendered(*drawn.extent);
    const double threshold_lx = asked.thresholds_lx.front();
    for (const Surface surface : {Surface::target, Surface::road}) {
        const LaneExtent* const own = find_extent(extents, {surface, "own", threshold_lx});
        if (own == nullptr)
            continue;
        std::string text = fmt::format("{:g} lx on {}: reach {}{} m", threshold_lx, surface == Surface::target ? "targets" : "the road",
                                       own->reach_is_cut_off ? "> " : "", figure(own->reach_centre_m, 0));
        const LaneExtent* const all = find_extent(extents, {surface, "all", threshold_lx});
        if (all != nullptr && !all->widths.empty())
            text += fmt::format(", {}{} m wide at {:g} m", all->widths.front().cut_off ? "> " : "", figure(all->widths.front().width_m, 1),
                                all->widths.front().at_m);
        return text;
    }
    return fmt::format("{:g} lx: the own lane ends", threshold_lx);
}

/// NaN where the picture shows anything but ground, and on kerbs' faces: what stands upright has other light.
Image<float> ground_lx(const DrawnPanel& drawn) {
    constexpr double least_upward = 0.8; // of a normal
    const Frame& frame = drawn.frame;
    Image<float> lx(frame.ids.width(), frame.ids.height(), std::numeric_limits<float>::quiet_NaN());
    const auto place = [&](int x, int y) { return shown_at(drawn.camera, drawn.view, x, y, frame.depth_m.at(x, y)); };
    for (int y = 1; y < lx.height(); ++y)
        for (int x = 1; x < lx.width(); ++x) {
            if (!drawn.drive->is_ground_mesh(frame.ids.at(x, y)) || frame.ids.at(x - 1, y) == 0 || frame.ids.at(x, y - 1) == 0)
                continue;
            const glm::dvec3 here = place(x, y), normal = glm::cross(place(x - 1, y) - here, place(x, y - 1) - here);
            if (std::abs(normal.z) >= least_upward * glm::length(normal))
                lx.at(x, y) = frame.illuminance_lx.at(x, y);
        }
    return lx;
}

FilmPanelMoment told(DrawnPanel& drawn, const FilmOverlays& overlays) {
    const FilmedDrive& filmed = *drawn.drive;
    FilmPanelMoment moment;
    moment.title = drawn.title;
    if (overlays.speed)
        moment.speed = figure(3.6 * drawn.speed_mps, 0) + " km/h";
    moment.readings = told_readings(drawn);
    if (overlays.isolux)
        moment.ground_lx = ground_lx(drawn);
    moment.map = std::move(drawn.map);
    if (drawn.frame.light.empty()) {
        moment.picture = std::move(drawn.frame.colour);
        return moment;
    }
    const Drive& drive = filmed.stage().drive;
    const ShownPicture shown =
        show_frame(drawn.frame, drawn.moment, drawn.view, drive.display, drive.tone_mapper, drive.seed, drawn.picture);
    moment.picture = mapped(shown.codes, [](const glm::u16vec3& code) {
        return Rgb8{static_cast<std::uint8_t>(code.r), static_cast<std::uint8_t>(code.g), static_cast<std::uint8_t>(code.b)};
    });
    return moment;
}

/// Where drives leave it open the eye of all panels is adapted to one white: under the first drive's sky, and of the lamps of each drive
/// alike, as who compares them is adapted to none.
void share_white(const std::vector<Drive>& asked, std::deque<Stage>& stages) {
    if (stages.size() < 2)
        return;
    glm::dvec3 lamps(0.0);
    double shining = 0.0;
    for (const Stage& stage : stages)
        if (const std::optional<glm::dvec3> white = white_of_lamps(stage.drive)) {
            lamps += *white;
            shining += 1.0;
        }
    Drive all = stages.front().drive;
    all.display.white = {};
    close_white(all, shining > 0.0 ? std::optional(lamps / shining) : std::nullopt);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const WhiteAdaptation& given = asked[i].display.white;
        WhiteAdaptation& white = stages[i].drive.display.white;
        if (!given.chromaticity)
            white.chromaticity = all.display.white.chromaticity;
        if (!given.degree && white.adapts()) // published techniques never do
            white.degree = all.display.white.degree;
    }
}

/// All that can be refused before a device is opened.
void read_stages(const FilmRequest& request, std::deque<Stage>& stages) {
    for (const Drive& drive : request.drives) {
        const View* view = driver_view(drive);
        if (view == nullptr)
            throw InputError({drive.file, 0, 0, "views"}, "found only maps", "a driver's view");
        Drive filmed = as_filmed(drive, request);
        View finest = at_size(*view, request.width_px, request.height_px); // levels of detail are chosen for it, too
        finest.vertical_fov_rad = request.vertical_fov_rad.value_or(finest.vertical_fov_rad);
        filmed.views.push_back(finest);
        stages.emplace_back(std::move(filmed));
        stages.back().drive.views.pop_back();
    }
    share_white(request.drives, stages);
}

int frames_of(const std::deque<Stage>& stages) {
    int most = 0;
    for (const Stage& stage : stages)
        most = std::max(most, tick_count(stage.drive));
    return most;
}

void check_illuminance(const FilmOverlays& overlays, FilmedDrive& filmed) {
    const Drive& drive = filmed.stage().drive;
    if ((overlays.lux || overlays.isolux || overlays.readings) && !filmed.renderer().available({.illuminance = true}).illuminance)
        throw InputError({drive.file, 0, 0, "technique"}, no_illuminance(drive.technique),
                         "photometric, for --overlay lux, isolux and readings");
}

} // namespace

FilmFound run_film(const FilmRequest& request) {
    std::deque<Stage> stages;
    read_stages(request, stages);
    const std::vector<FilmedPanel> panels = panels_of(stages, request.lamp_sets);
    const FilmLayout layout = film_layout(request.arrangement, static_cast<int>(panels.size()), request.width_px, request.height_px,
                                          {.readings = request.overlays.readings, .maps = request.overlays.lux});
    FilmFound found;
    const int all = frames_of(stages), first = std::max(0, request.frames.first), last = std::min(all - 1, request.frames.last);
    found.planned = last - first + 1;
    if (found.planned <= 0)
        throw InputError({{}, 0, 0, "--frames"}, fmt::format("found a range from {} on", first),
                         fmt::format("frames of the film, which has 0 to {}", all - 1));
    if (request.frames.last >= all && request.frames.last != TickRange{}.last)
        found.notes.push_back(fmt::format("--frames: {} of the {} frames asked for, as the film ends with frame {}", found.planned,
                                          request.frames.last - first + 1, all - 1));
    Device device = open_device(request.backend);
    check_sanity(device);
    RendererSettings settings = settings_for(device, false);
    settings.light_pass = request.light_pass;
    for (Stage& stage : stages) {
        choose_shadows(stage, device, settings_for(stage.drive, settings));
        check_planar_shadows(stage, device);
        fit_tone_mapper(stage, device, settings_for(stage.drive, settings));
        std::ranges::copy(stage.drive.notes, std::back_inserter(found.notes));
    }
    check_shown(stages);
    std::deque<FilmedDrive> drives;
    for (const Stage& stage : stages) {
        drives.emplace_back(stage, device, settings);
        check_illuminance(request.overlays, drives.back());
    }
    const std::string caption = stages.size() == 1 ? shown_name(stages.front().drive) : "";
    request.begin();
    const Interruption listening;
    Progress progress("film of " + stages.front().drive.name, found.planned, request.quiet, "frames");
    Writers writers(has_core_beside_drawing() ? 1 : 0, frames_waiting);
    for (int frame = first; frame <= last && !Interruption::requested(); ++frame) {
        const TraceSpan span("frame", "film");
        const auto row = std::make_shared<std::vector<DrawnPanel>>();
        for (std::size_t i = 0; i < panels.size(); ++i)
            row->push_back(drawn(drives[panels[i].drive], panels[i], layout.panels[i], frame, request));
        writers.submit([row, frame, &request, &layout, &caption] {
            FilmMoment moment{request.rate.time_s(frame), caption, {}};
            for (DrawnPanel& panel : *row)
                moment.panels.push_back(told(panel, request.overlays));
            request.take(film_pixels(layout, moment), film_marks(layout, moment), frame);
        });
        progress.done(++found.filmed);
    }
    writers.finish();
    if (found.filmed < found.planned)
        found.interrupted = Interruption::words();
    return found;
}

} // namespace fernlicht
