#include "metrics/images/image_difference.h"
#include "renderer/renderer.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double beyond = 0.01;

/// Every `across`th pixel of every `down`th row.
Image<float> thinned(const Image<float>& picture, int across, int down) {
    Image<float> few((picture.width() + across - 1) / across, (picture.height() + down - 1) / down);
    for (int y = 0; y < few.height(); ++y)
        for (int x = 0; x < few.width(); ++x)
            few.at(x, y) = picture.at(x * across, y * down);
    return few;
}

ImageDifference compared(const Image<float>& a, const Image<float>& b, int across, int down) {
    return across * down == 1 ? compare_images(a, b, 0.0, beyond)
                              : compare_images(thinned(a, across, down), thinned(b, across, down), 0.0, beyond);
}

} // namespace

WorkPrecision metrics_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on) {
    WorkPrecision diagram{
        "metrics",
        "Comparing pictures",
        "error of root mean square and of the share beyond 1 %",
        "%",
        "time of a comparison",
        "",
        {"lux images of light-map-2d against photometric in the driver's view; the larger of both errors, in shares of what all "
         "pixels give, bars from the smaller"},
        {}};
    const Moment moment = moments_at({tick_count(stage.drive) / 2}, stage, lamp_set).front();
    std::vector<Image<float>> pictures;
    for (const char* technique : {"light-map-2d", "photometric"}) {
        RendererSettings settings;
        settings.technique = technique;
        settings.shadows = stage.drive.shadows;
        Renderer renderer(device, stage.scene, settings);
        pictures.push_back(renderer.draw(moment, *driver_view(stage.drive), {.illuminance = true}).illuminance_lx);
    }
    const ImageDifference truth = compared(pictures[0], pictures[1], 1, 1);
    for (const auto& [across, down] : {std::pair(1, 1), std::pair(1, 2), std::pair(1, 4), std::pair(1, 16), std::pair(2, 2),
                                       std::pair(4, 4), std::pair(8, 8), std::pair(16, 16)}) {
        if (!go_on())
            break;
        WorkPrecisionRow row;
        row.label = across * down == 1 ? "every pixel"
                    : across == 1      ? fmt::format("every {} row", down == 2 ? "2nd" : fmt::format("{}th", down))
                                       : fmt::format("every {} pixel both ways", across == 2 ? "2nd" : fmt::format("{}th", across));
        const ImageDifference found = compared(pictures[0], pictures[1], across, down);
        if (truth.rmse > 0.0 && truth.percent_over > 0.0) {
            const double rmse = 100.0 * std::abs(found.rmse / truth.rmse - 1.0),
                         share = 100.0 * std::abs(found.percent_over / truth.percent_over - 1.0);
            row.error = {std::max(rmse, share), std::min(rmse, share), std::max(rmse, share)};
        } else {
            row.why_not = "the pictures are the same";
        }
        row.seconds = timed([&, x = across, y = down] { compared(pictures[0], pictures[1], x, y); });
        diagram.rows.push_back(std::move(row));
    }
    return diagram;
}

} // namespace fernlicht
