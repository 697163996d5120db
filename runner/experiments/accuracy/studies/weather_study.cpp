#include "runner/experiments/accuracy/studies/studies.h"

#include "metrics/images/pixel_errors.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/accuracy/technique_sweep.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int compared_width = 40, compared_height = 30, timed_width = 256, timed_height = 192;
constexpr double min_cdm2 = 0.001;
constexpr int beside_the_road = -2; ///< LitLamp::body of what is fixed in the world

bool stands_beside(const LitLamp& lamp) { return lamp.body == beside_the_road; }

Scene without_textures(const Scene& scene) {
    Scene plain = scene;
    plain.textures.clear();
    for (Material& material : plain.materials)
        material.texture = -1;
    return plain;
}

/// One way to draw the moment.
struct MediumWay {
    std::string label, parameter, value, note;
    Moment moment;
    RendererSettings settings;
};

struct MediumStudy {
    std::string name, title, note;
    const Moment& moment;
    const RendererSettings& drawn;
    std::vector<MediumWay> ways = {};

    /// The moment as drives are drawn, for whoever adds it to change.
    MediumWay& add(const std::string& label, const std::string& parameter, const std::string& value, const std::string& way_note = {}) {
        return ways.emplace_back(MediumWay{label, parameter, value, way_note, moment, drawn});
    }
};

class MediaBench {
  public:
    MediaBench(const Stage& stage, const Moment& moment, Device& device)
        : scene_(without_textures(stage.scene)), device_(device),
          compared_(at_size(*driver_view(stage.drive), compared_width, compared_height)),
          timed_(at_size(*driver_view(stage.drive), timed_width, timed_height)) {
        ReferenceSettings settings;
        settings.footprint = Footprint::centre;
        settings.shadows = stage.drive.shadows.objects_cast;
        truth_ = Reference(scene_).render(moment, compared_, {.luminance = true}, settings);
    }

    WorkPrecisionRow row_of(const MediumWay& way) const {
        WorkPrecisionRow row;
        row.label = way.label;
        row.note = way.note;
        Renderer renderer(device_, scene_, way.settings);
        const Frame frame = renderer.draw(way.moment, compared_, {.luminance = true, .ids = true});
        PixelErrorFold fold(ErrorRule{min_cdm2});
        for (int y = 0; y < compared_height; ++y)
            for (int x = 0; x < compared_width; ++x)
                if (frame.ids.at(x, y) == truth_.ids.at(x, y)) // not where the outline of a thing lies to the other side of the centre
                    fold.add({.tested = static_cast<double>(frame.luminance_cdm2.at(x, y)),
                              .reference = static_cast<double>(truth_.luminance_cdm2.mean.at(x, y)),
                              .standard_error = 0.0,
                              .area_m2 = {},
                              .x = x,
                              .y = y});
        const PixelErrors errors = fold.finish().value_or(PixelErrors{});
        row.parameters = {{way.parameter, way.value},
                          {"median_percent", fmt::format("{:.3g}", 100.0 * errors.error.median)},
                          {"mean_percent", fmt::format("{:.3g}", 100.0 * errors.mean)}};
        if (errors.pixels == 0) {
            row.why_not = "no pixel has 0.001 cd/m2";
            return row;
        }
        row.error = exactly(100.0 * errors.error.p95);
        const FrameOutputs colour{.colour = true};
        renderer.prepare({way.moment}, timed_, colour);
        row.seconds = timed([&] {
            renderer.render(way.moment, timed_, colour);
            renderer.finish();
        });
        return row;
    }

  private:
    Scene scene_;
    Device& device_;
    View compared_, timed_;
    ReferenceImage truth_;
};

MediumStudy fog_ways(const Moment& moment, const RendererSettings& drawn) {
    MediumStudy study{"fog", "Fog by midpoints along each ray", "", moment, drawn};
    for (const int samples : {4, 8, 16, 32, 64, 128, 256})
        study
            .add(fmt::format("{} midpoints", samples), "fog_samples", fmt::format("{}", samples),
                 samples == drawn.fog_samples ? "as drives are rendered" : "")
            .settings.fog_samples = samples;
    study.add("left out", "fog_samples", "0").moment.weather.extinction_per_m = 0.0;
    return study;
}

MediumStudy wet_ways(const Moment& moment, const RendererSettings& drawn) {
    MediumStudy study{"wet-road", "Wet road", "", moment, drawn};
    study.add("rendered", "wetness", "as given", "as drives are rendered");
    study.add("left out", "wetness", "0").moment.weather.wetness = 0.0;
    return study;
}

MediumStudy sun_ways(const Moment& moment, const RendererSettings& drawn) {
    MediumStudy study{"sun", "Sun or moon",
                      "the map has 2048 x 2048 texels of 0.12 m; all other lights keep their shadows but in the second way", moment, drawn};
    study.add("with its shadow map", "shadows", "map", "as drives are rendered");
    study.add("without any shadows", "shadows", "none").settings.shadows.method = ShadowMethod::none;
    Daylight& dark = study.add("left out", "shadows", "no light").moment.daylight;
    dark.sun = dark.moon = {};
    return study;
}

MediumStudy lamp_ways(const Moment& moment, const RendererSettings& drawn) {
    MediumStudy study{"street-lamps", fmt::format("Street lamps, {}", std::ranges::count_if(moment.other_lamps, stands_beside)),
                      "light of any one lamp fainter than this is left out (traffic_light: min_lx); shadows by maps but in the way without",
                      moment, drawn};
    for (const double min_lx : {0.005, 0.05, 0.2, 1.0, 5.0})
        study
            .add(fmt::format("from {:g} lx on", min_lx), "min_lx", fmt::format("{:g}", min_lx),
                 min_lx == moment.min_traffic_lx ? "as the drive is rendered" : "")
            .moment.min_traffic_lx = min_lx;
    study.add("without their shadows", "shadows", "none").settings.traffic_shadows = false;
    std::erase_if(study.add("left out", "min_lx", "all").moment.other_lamps, stands_beside);
    return study;
}

} // namespace

std::vector<WorkPrecision> weather_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on) {
    Moment moment = moments_at({tick_count(stage.drive) / 2}, stage, lamp_set).front();
    std::erase_if(moment.other_lamps, [](const LitLamp& lamp) { return !stands_beside(lamp); });
    Configuration as_drawn;
    as_drawn.technique = "photometric";
    as_drawn.shadows = stage.drive.shadows;
    const RendererSettings drawn = settings_of(stage.drive, as_drawn);
    std::vector<MediumStudy> studies;
    if (moment.weather.extinction_per_m > 0.0)
        studies.push_back(fog_ways(moment, drawn));
    if (moment.weather.wetness > 0.0)
        studies.push_back(wet_ways(moment, drawn));
    if (moment.daylight.direct() != nullptr)
        studies.push_back(sun_ways(moment, drawn));
    if (std::ranges::any_of(moment.other_lamps, stands_beside))
        studies.push_back(lamp_ways(moment, drawn));
    std::vector<WorkPrecision> diagrams;
    if (studies.empty() || !go_on())
        return diagrams;
    const MediaBench bench(stage, moment, device);
    for (const MediumStudy& study : studies) {
        WorkPrecision diagram{
            study.name,
            study.title,
            "error of luminance, 95 % of the pixels",
            "%",
            "time a frame",
            "",
            {fmt::format("{} x {} pixels of the driver's view at {:.1f} s with at least {:g} cd/m2, surfaces without textures, against the "
                         "reference's direct light by the ray through each centre; lamps of other road users are switched off; times are "
                         "of {} x {} pixels",
                         compared_width, compared_height, moment.time_s, min_cdm2, timed_width, timed_height)},
            {}};
        if (!study.note.empty())
            diagram.notes.push_back(study.note);
        for (const MediumWay& way : study.ways) {
            if (!go_on())
                break;
            diagram.rows.push_back(bench.row_of(way));
        }
        diagrams.push_back(std::move(diagram));
    }
    return diagrams;
}

} // namespace fernlicht
