#include "runner/experiments/aliasing/aliasing_result.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace fernlicht {
namespace {

using plots::Colour;

constexpr int crop_px = 48;
constexpr std::size_t max_places = 4;
constexpr double half_width_px = 560.0, spacing_px = 16.0, lettering_px = 12.0;

/// The value that only one pixel in `one_in` exceeds; above 0.
template <class T> double nearly_largest(const Image<T>& picture, std::size_t one_in) {
    std::vector<double> values;
    for (const T value : picture.pixels())
        values.push_back(std::abs(static_cast<double>(value)));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1 - values.size() / one_in);
    std::nth_element(values.begin(), at, values.end());
    return std::max(*at, 1e-9);
}

/// As an sRGB display shows it, `white` as white.
template <class T> Image<Colour> grey(const Image<T>& picture, double white) {
    return mapped(picture, [&](T value) {
        const double v = std::clamp(static_cast<double>(value) / white, 0.0, 1.0);
        const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
        const auto level = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
        return Colour{level, level, level};
    });
}

Image<Colour> false_colours(const Image<double>& picture, double limit) {
    return mapped(picture, [&](double value) { return plots::diverging(value / limit); });
}

/// The part of a picture that is shown enlarged.
struct Crop {
    int left = 0, top = 0, width = 0, height = 0;
    std::string why;
};

template <class T> Image<T> cut(const Image<T>& picture, const Crop& crop) {
    return part_of(picture, crop.left, crop.top, crop.width, crop.height);
}

/// The row whose aliasing is most visible somewhere: colours of all rows mean the same as its own.
const AliasingRow& worst_row(const AliasingResult& result) {
    const std::vector<std::size_t> measured = ranked(result);
    return result.rows[*std::ranges::max_element(measured, {}, [&](std::size_t i) { return result.rows[i].spatial.worst_visible; })];
}

/// The first row that was measured, which the others of its technique are variations of.
const AliasingRow& first_row(const AliasingResult& result, const AliasingRow& row) {
    return *std::ranges::find_if(result.rows, [&](const AliasingRow& other) {
        return measured_over_space(other) && other.configuration.technique == row.configuration.technique;
    });
}

/// Where a row's aliasing differs most from that of the first, in contrast; of the first, where it is worst.
Crop crop_of(const AliasingResult& result, const AliasingRow& row) {
    const int width = std::min(crop_px, result.view.width_px), height = std::min(crop_px, result.view.height_px);
    const AliasingRow& first = first_row(result, row);
    const auto from = [](int middle, int size, int all) { return std::clamp(middle - size / 2, 0, all - size); };
    Crop crop{from(row.spatial.worst_x, width, result.view.width_px), from(row.spatial.worst_y, height, result.view.height_px), width,
              height, "where it is worst"};
    double most = 0.0;
    for (int top = 0; top + height <= result.view.height_px && &first != &row; top += crop_px / 4)
        for (int left = 0; left + width <= result.view.width_px; left += crop_px / 4) {
            double sum = 0.0;
            for (int y = top; y < top + height; ++y)
                for (int x = left; x < left + width; ++x) {
                    const double away = row.spatial.aliasing_picture.at(x, y) - first.spatial.aliasing_picture.at(x, y);
                    sum += away * away / (first.spatial.level_picture.at(x, y) * first.spatial.level_picture.at(x, y));
                }
            if (sum > most) {
                most = sum;
                crop = {left, top, width, height, "where it differs most from " + name_of(first.configuration)};
            }
        }
    return crop;
}

void letter(plots::Drawing& canvas, double left, double base, const std::string& text) {
    canvas.text(left, base, text, {.size_px = lettering_px});
}

void draw_legend(plots::Drawing& canvas, double left, double top, double limit) {
    constexpr int steps = 201;
    Image<Colour> strip(steps, 1);
    for (int i = 0; i < steps; ++i)
        strip.at(i, 0) = plots::diverging(2.0 * i / (steps - 1) - 1.0);
    const double width = half_width_px - 260.0;
    letter(canvas, left, top + 10.0, fmt::format("\xE2\x88\x92{:.2g} cd/m\xC2\xB2, too dark", limit));
    canvas.picture(left + 140.0, top, width - 10.0, 12.0, strip);
    letter(canvas, left + 140.0 + width, top + 10.0, fmt::format("+{:.2g}, too bright", limit));
}

/// Curves of contrast over frequency.
struct Spectra {
    Spectra(const std::string& title, const std::string& subtitle) {
        figure.title = title;
        figure.subtitle = subtitle;
    }
    template <class Bands, class PointOf>
    void add(const AliasingResult& result, std::size_t row, bool markers, const Bands& bands, PointOf point_of) {
        plots::Series& series = figure.series.emplace_back();
        series.name = name_of(result.rows[row].configuration);
        series.colour = plots::series_colour(row);
        series.markers = markers;
        for (const auto& band : bands) {
            series.points.push_back(point_of(band));
            frequencies.push_back(series.points.back().x);
            contrasts.push_back(series.points.back().y);
        }
    }
    plots::Figure drawn(plots::Axis x, double marked, const std::string& mark) {
        figure.x = std::move(x);
        figure.y = plots::axis_around("contrast", "%", contrasts, plots::Scale::linear, true);
        figure.marks.push_back({plots::Mark::Across::at_x, marked, mark});
        return std::move(figure);
    }

    plots::Figure figure;
    std::vector<double> frequencies, contrasts;
};

} // namespace

plots::Drawing aliasing_sheet(const AliasingResult& result, const AliasingRow& row) {
    const double white = nearly_largest(worst_row(result).picture, 1000);
    const double limit = nearly_largest(worst_row(result).spatial.aliasing_picture, 100);
    const double height = half_width_px * result.view.height_px / result.view.width_px, quarter = (half_width_px - spacing_px) / 2.0;
    const double first_top = 64.0, second_top = first_top + height + 68.0, middle = 2.0 * spacing_px + half_width_px;
    plots::Drawing canvas{2.0 * half_width_px + 3.0 * spacing_px, second_top + quarter + spacing_px, name_of(row.configuration)};
    canvas.text(spacing_px, 24.0, name_of(row.configuration), {.size_px = 16.0, .bold = true});
    letter(canvas, spacing_px, 48.0, fmt::format("Luminance, white is {:.3g} cd/m\xC2\xB2", white));
    letter(canvas, middle, 48.0,
           fmt::format("Aliasing: {:.3g} times what an eye just sees, contrast {:.3g} %", row.spatial.aliasing.visible,
                       row.spatial.aliasing.contrast_percent));
    canvas.picture(spacing_px, first_top, half_width_px, height, grey(row.picture, white));
    canvas.picture(middle, first_top, half_width_px, height, false_colours(row.spatial.aliasing_picture, limit));
    draw_legend(canvas, middle, first_top + height + 8.0, limit);
    const Crop crop = crop_of(result, row);
    const Image<float> drawn = cut(row.picture, crop), ideal = cut(row.ideal, crop);
    const Image<double> aliasing = cut(row.spatial.aliasing_picture, crop), folded = cut(row.spatial.folded_picture, crop);
    const double crop_white = nearly_largest(drawn, 100), crop_limit = nearly_largest(aliasing, 100);
    letter(canvas, spacing_px, second_top - 28.0,
           fmt::format("{} x {} pixels from {}, {}, {}; white is {:.2g} cd/m\xC2\xB2, full colour is {:.2g}", crop.width, crop.height,
                       crop.left, crop.top, crop.why, crop_white, crop_limit));
    const std::pair<const char*, Image<Colour>> crops[] = {{"As rendered", grey(drawn, crop_white)},
                                                           {"What the display could show", grey(ideal, crop_white)},
                                                           {"Aliasing", false_colours(aliasing, crop_limit)},
                                                           {"Of it, folded back", false_colours(folded, crop_limit)}};
    for (int i = 0; i < 4; ++i) {
        const double x = spacing_px + i * (quarter + spacing_px);
        letter(canvas, x, second_top - 8.0, crops[i].first);
        canvas.picture(x, second_top, quarter, quarter * crop.height / crop.width, enlarged(crops[i].second, 6));
    }
    return canvas;
}

std::optional<plots::Drawing> ranking_sheet(const AliasingResult& result) {
    const std::vector<std::size_t> order = ranked(result);
    if (order.size() < 2)
        return std::nullopt;
    std::vector<Crop> places; // where each way differs most from the first, in the order they were asked for
    for (const AliasingRow& row : result.rows) {
        if (!measured_over_space(row) || &row == &first_row(result, row) || places.size() == max_places)
            continue;
        const Crop crop = crop_of(result, row);
        if (std::ranges::none_of(places, [&](const Crop& other) { return other.left == crop.left && other.top == crop.top; }))
            places.push_back(crop);
        places.back().why = row.configuration.varied;
    }
    const double side = 208.0, left = 350.0, first_top = 84.0;
    plots::Drawing canvas{left + static_cast<double>(places.size()) * (side + spacing_px),
                          first_top + static_cast<double>(order.size()) * (side + spacing_px),
                          "Ways to render, by what an eye sees of their aliasing"};
    canvas.text(spacing_px, 24.0, "Ways to render, least aliasing first", {.size_px = 16.0, .bold = true});
    letter(canvas, spacing_px, 46.0,
           fmt::format("{} x {} pixels, at the places where each way differs most from the first", places.front().width,
                       places.front().height));
    for (std::size_t p = 0; p < places.size(); ++p) {
        const double x = left + static_cast<double>(p) * (side + spacing_px);
        const double white = nearly_largest(cut(result.rows[order.front()].ideal, places[p]), 50);
        letter(canvas, x, first_top - 10.0,
               fmt::format("{}at {}, {}", places[p].why.empty() ? "" : places[p].why + ", ", places[p].left, places[p].top));
        for (std::size_t i = 0; i < order.size(); ++i)
            canvas.picture(x, first_top + static_cast<double>(i) * (side + spacing_px), side, side * places[p].height / places[p].width,
                           enlarged(grey(cut(result.rows[order[i]].picture, places[p]), white), 4));
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        const AliasingRow& row = result.rows[order[i]];
        const double y = first_top + static_cast<double>(i) * (side + spacing_px) + 20.0;
        canvas.text(spacing_px, y, fmt::format("{}. {:.3g} times what an eye just sees", i + 1, row.spatial.aliasing.visible),
                    {.size_px = 14.0, .bold = true});
        letter(canvas, spacing_px, y + 22.0, name_of(row.configuration));
        letter(canvas, spacing_px, y + 42.0,
               fmt::format("contrast {:.3g} %, of it folded back {:.3g} %", row.spatial.aliasing.contrast_percent,
                           row.spatial.folded.contrast_percent));
        if (row.cut_off)
            letter(canvas, spacing_px, y + 62.0, fmt::format("stairs of the cut-off {:.2f} px", row.cut_off->found.rms_px));
        if (row.marks)
            letter(canvas, spacing_px, y + 82.0, fmt::format("stairs of road marks {:.2f} px", row.marks->found.rms_px));
        if (row.temporal)
            letter(canvas, spacing_px, y + 102.0, fmt::format("flicker {:.3g} %", row.temporal->flicker_percent));
    }
    return canvas;
}

std::optional<plots::Drawing> flow_sheet(const AliasingResult& result) {
    if (result.flows.empty())
        return std::nullopt;
    const FlowComparison& flow = result.flows.front();
    const double side = (2.0 * half_width_px - spacing_px) / 3.0, height = side * result.view.height_px / result.view.width_px, top = 74.0;
    const double max_motion = std::max(1.0, nearly_largest(flow.known_px, 20)), max_off = 2.0;
    plots::Drawing canvas{3.0 * side + 4.0 * spacing_px, top + height + 44.0, "Motion by optical flow"};
    canvas.text(spacing_px, 24.0, fmt::format("Motion by optical flow: {}, of {}", method_name(flow.method), flow.pictures),
                {.size_px = 16.0, .bold = true});
    letter(canvas, spacing_px, 44.0,
           "length from one frame to the next, pixels; grey: not known, or left out because going there and back ends elsewhere");
    const auto coloured = [](const Image<float>& picture, double most) {
        return mapped(picture, [most](float value) {
            return value < 0.0F ? Colour{170, 170, 170} : plots::sequential(static_cast<double>(value) / most);
        });
    };
    const std::tuple<const char*, const Image<float>*, double> parts[] = {
        {"Known, from depth and the car's path", &flow.known_px, max_motion},
        {"Estimated", &flow.estimated_px, max_motion},
        {"How far off", &flow.off_px, max_off}};
    Image<Colour> strip(101, 1);
    for (int i = 0; i < strip.width(); ++i)
        strip.at(i, 0) = plots::sequential(i / 100.0);
    double x = spacing_px;
    for (const auto& [name, picture, most] : parts) {
        letter(canvas, x, top - 8.0, name);
        canvas.picture(x, top, side, height, coloured(*picture, most));
        letter(canvas, x, top + height + 22.0, "0");
        canvas.picture(x + 16.0, top + height + 12.0, side - 130.0, 12.0, strip);
        letter(canvas, x + side - 106.0, top + height + 22.0, fmt::format("{:.3g} px and more", most));
        x += side + spacing_px;
    }
    return canvas;
}

plots::Figure spatial_plot(const AliasingResult& result) {
    Spectra spectra{
        "Aliasing by spatial frequency",
        fmt::format("octaves up to the display's limit of {:.1f} cycles per degree, and the corners beyond; r.m.s. over the picture",
                    0.5 * result.pixels_per_degree)};
    for (const std::size_t i : ranked(result))
        spectra.add(result, i, true, result.rows[i].spatial.bands, [&](const AliasingBand& band) -> plots::Point {
            return {std::sqrt(band.from * band.to) * result.pixels_per_degree, band.aliasing.contrast_percent};
        });
    return spectra.drawn(plots::axis_around("spatial frequency", "cycles per degree", spectra.frequencies, plots::Scale::logarithmic),
                         0.5 * result.pixels_per_degree, "limit");
}

std::optional<plots::Figure> temporal_plot(const AliasingResult& result) {
    Spectra spectra{"Aliasing by temporal frequency", "along the paths of points of the scene, r.m.s. over them, each frequency alone"};
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        if (const auto& temporal = result.rows[i].temporal)
            spectra.add(result, i, false, temporal->spectrum, [](const FlickerBand& band) -> plots::Point {
                return {band.hertz, band.contrast_percent};
            });
    if (spectra.figure.series.empty())
        return std::nullopt;
    return spectra.drawn(plots::axis_around("temporal frequency", "Hz", spectra.frequencies, plots::Scale::linear, true), crawl_below_hz,
                         "crawl | flicker");
}

} // namespace fernlicht
