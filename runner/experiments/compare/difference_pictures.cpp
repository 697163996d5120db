#include "runner/experiments/compare/picture_comparison.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for_each.h>

namespace fernlicht {
namespace {

using plots::Colour;
using Pixels = Image<Colour>;

constexpr Colour line_of_a{86, 180, 233}, line_of_b{255, 176, 0}; // apart for every kind of colour vision, and on grey
constexpr double isolines_lx[] = {0.25, 1.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0};

template <class From, class Value> Pixels coloured(const Image<From>& image, const Value& value) {
    Pixels out(image.width(), image.height());
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] = value(image.pixels()[i]);
    return out;
}

/// Left half of one, right half of the other, a white line between.
Pixels split(const Pixels& left, const Pixels& right) {
    Pixels out = left;
    for (int y = 0; y < out.height(); ++y)
        for (int x = out.width() / 2; x < out.width(); ++x)
            out.at(x, y) = x == out.width() / 2 ? Colour{255, 255, 255} : right.at(x, y);
    return out;
}

/// File names, with the folders that tell them apart where they are the same.
std::string names_of(const PicturePair& pair) {
    const auto ends = [](const std::filesystem::path& path, int parts) {
        std::filesystem::path end = path.filename(), rest = path.parent_path();
        for (; parts > 1 && rest.has_filename(); --parts, rest = rest.parent_path())
            end = rest.filename() / end;
        return end;
    };
    int parts = 1;
    while (parts < 8 && ends(pair.reference, parts) == ends(pair.tested, parts))
        ++parts;
    return fmt::format("A {}, B {}", printable(ends(pair.reference, parts).string(), 120),
                       printable(ends(pair.tested, parts).string(), 120));
}

class DifferencePictures {
  public:
    explicit DifferencePictures(const PicturePair& pair) : names_(names_of(pair)) {}

    void display(const PicturePair& pair, const LayerComparison& layer) {
        const Pixels a = pixels_of(pair.reference_display), b = pixels_of(pair.tested_display);
        beside("", "Side by side", a, b, {});
        sheet("split", {"Split: A left, B right", names_, {{"A | B", split(a, b)}}});
        difference("", "Difference of the channel that differs most", layer);
        flip("", layer);
        const plots::Axis axis{.label = "CIEDE2000, 10 and more", .unit = "", .from = 0.0, .to = 10.0};
        sheet("ciede2000", {"Difference of colour, CIEDE2000", names_, {{"", plots::heat_map(layer.colours, axis)}}, legend_of(axis)});
        histogram("", layer);
    }

    void linear(const LinearPair& pair, const LayerComparison& layer) {
        const std::string prefix = plain(pair.name) + "-";
        float largest = 0.0F;
        for (const Image<float>* image : {&pair.reference, &pair.tested})
            largest = std::max(largest, *std::ranges::max_element(image->pixels()));
        const double top = rounded_up(static_cast<double>(largest));
        const plots::Axis axis{.label = pair.name.substr(0, pair.name.rfind('.')),
                               .unit = pair.unit,
                               .from = top * 1e-4,
                               .to = top,
                               .scale = plots::Scale::logarithmic};
        const Pixels a = plots::heat_map(pair.reference, axis), b = plots::heat_map(pair.tested, axis);
        beside(prefix, "Side by side: " + pair.name, a, b, legend_of(axis));
        sheet(prefix + "split", {"Split: A left, B right: " + pair.name, names_, {{"A | B", split(a, b)}}, legend_of(axis)});
        difference(prefix, "Difference of " + pair.name, layer);
        if (pair.unit == "lx")
            isolux(prefix, pair, axis);
        flip(prefix, layer);
        histogram(prefix, layer);
    }

    std::vector<std::string> finish(const TakePlot& take) {
        oneapi::tbb::parallel_for_each(plots_, take);
        return std::move(drawn_);
    }

  private:
    static std::string plain(const std::string& channel) {
        std::string name;
        for (const char c : channel.substr(0, channel.rfind('.')))
            name += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '-';
        return name;
    }

    void sheet(const std::string& name, Sheet sheet) {
        plots_.push_back({.name = name, .figure = std::move(sheet), .png_alone = true});
        drawn_.push_back(name + ".png");
    }
    /// What is made of lines is kept as lines, too.
    void lines(const std::string& name, decltype(Plot::figure) figure) {
        plots_.push_back({.name = name, .figure = std::move(figure)});
        drawn_.insert(drawn_.end(), {name + ".png", name + ".svg"});
    }

    void beside(const std::string& prefix, const std::string& title, const Pixels& a, const Pixels& b, std::optional<SheetLegend> legend) {
        sheet(prefix + "side-by-side", {title, names_, {{"A", a}, {"B", b}}, std::move(legend)});
    }

    void difference(const std::string& prefix, const std::string& title, const LayerComparison& layer) {
        double largest = 0.0;
        for (const float d : layer.difference.pixels())
            largest = std::max(largest, std::abs(static_cast<double>(d)));
        const SignedScale scale{rounded_up(largest)};
        const Pixels pixels = coloured(layer.difference, [&](float d) { return scale.colour(static_cast<double>(d)); });
        sheet(prefix + "difference",
              {title + ", B - A", names_, {{"orange: B is brighter, blue: A is brighter", pixels}}, scale.legend("B - A", layer.unit)});
    }

    void flip(const std::string& prefix, const LayerComparison& layer) {
        if (layer.flip.empty())
            return;
        const plots::Axis axis{.label = "FLIP", .unit = "", .from = 0.0, .to = 1.0};
        sheet(prefix + "flip",
              {"FLIP: what one sees who flips between A and B", names_, {{"", plots::heat_map(layer.flip, axis)}}, legend_of(axis)});
    }

    /// Isolines of both over A in grey.
    void isolux(const std::string& prefix, const LinearPair& pair, const plots::Axis& axis) {
        SheetPanel panel{"", coloured(pair.reference, [&](float v) {
                             const double t = std::clamp(plots::position(axis, std::max(static_cast<double>(v), axis.from)), 0.0, 1.0);
                             const auto grey = static_cast<std::uint8_t>(std::lround(20.0 + 100.0 * t));
                             return Colour{grey, grey, grey};
                         })};
        std::string drawn;
        for (const double level : isolines_lx) {
            const bool any =
                add_isolines(panel, pair.reference, level, line_of_a, "") | add_isolines(panel, pair.tested, level, line_of_b, "5 3");
            drawn += any ? (drawn.empty() ? "" : ", ") + plots::number(level) : "";
        }
        panel.caption = drawn.empty() ? "no light reaches 0.25 lx" : "lines at " + drawn + " lx, over A in grey";
        lines(prefix + "isolux",
              Sheet{"Isolux lines of " + pair.name, names_, {panel}, {}, {{"A", {{}, line_of_a, ""}}, {"B", {{}, line_of_b, "5 3"}}}});
    }

    static bool add_isolines(SheetPanel& panel, const Image<float>& values, double level, Colour colour, const std::string& dash) {
        plots::Grid grid;
        for (int x = 0; x < values.width(); ++x)
            grid.x.push_back(x + 0.5);
        for (int y = 0; y < values.height(); ++y)
            grid.y.push_back(y + 0.5);
        grid.values.assign(values.pixels().begin(), values.pixels().end());
        std::vector<plots::Polyline> lines = plots::isolines(grid, level);
        std::ranges::sort(lines, std::ranges::greater{}, &plots::Polyline::size);
        for (std::size_t i = 0; i < lines.size(); ++i)
            panel.lines.push_back({std::move(lines[i]), colour, dash, i == 0 ? plots::number(level) : ""});
        return !lines.empty();
    }

    void histogram(const std::string& prefix, const LayerComparison& layer) {
        const ErrorHistogram& h = layer.histogram;
        const auto all = static_cast<double>(h.pixels());
        plots::Polyline steps;
        int first = ErrorHistogram::bins, last = -1;
        for (int i = 0; i < ErrorHistogram::bins; ++i)
            if (h.counts[static_cast<std::size_t>(i)] > 0) {
                first = std::min(first, i);
                last = i;
            }
        const double least = 50.0 / all; // half a pixel: the floor of a log scale without a 0
        for (int i = first; i <= last; ++i) {
            const double percent = std::max(least, 100.0 * static_cast<double>(h.counts[static_cast<std::size_t>(i)]) / all);
            steps.push_back({ErrorHistogram::edge(i), percent});
            steps.push_back({ErrorHistogram::edge(i + 1), percent});
        }
        plots::Figure figure;
        figure.title = fmt::format("Pixels by size of the difference, {}", layer.name);
        figure.subtitle = fmt::format("{:.4g} % of {} pixels do not differ; bins of a third of a decade",
                                      100.0 * static_cast<double>(h.equal) / all, h.pixels());
        if (const std::string whole = figure.subtitle + ". " + names_; plots::text_width(whole, 12.0) < figure.width_px - 90.0)
            figure.subtitle = whole;
        const bool any = last >= 0;
        figure.x = {.label = "|B - A|",
                    .unit = layer.unit,
                    .from = any ? ErrorHistogram::edge(first) : 0.1,
                    .to = any ? ErrorHistogram::edge(last + 1) : 10.0,
                    .scale = plots::Scale::logarithmic};
        figure.y = {.label = "pixels", .unit = "%", .from = std::min(least, 0.1), .to = 100.0, .scale = plots::Scale::logarithmic};
        figure.series.push_back({.points = std::move(steps), .colour = plots::series_colour(0)});
        lines(prefix + "histogram", std::move(figure));
    }

    std::string names_;
    std::vector<Plot> plots_;
    std::vector<std::string> drawn_;
};

} // namespace

std::vector<std::string> draw_difference(const PictureComparison& comparison, const PicturePair& pair, const TakePlot& take) {
    DifferencePictures pictures(pair);
    if (pair.is_display())
        pictures.display(pair, comparison.layers.at(0));
    for (std::size_t i = 0; i < pair.linear.size(); ++i)
        if (pair.linear[i].unit == "lx" || pair.linear[i].unit == "cd/m2") // light; a difference of depths is told in numbers
            pictures.linear(pair.linear[i], comparison.layers.at(i));
    return pictures.finish(take);
}

} // namespace fernlicht
