#include "runner/accuracy/figures.h"
#include "runner/report/clean_text.h"
#include "runner/report/page_parts.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

std::string percent(double share, double floor) { return share < floor ? "< " + two_digits(100.0 * floor) : two_digits(100.0 * share); }

data error_row(const char* where, const PixelErrors& errors) {
    data row;
    const ErrorQuantiles &e = errors.error, &f = errors.floor;
    row.set("where", where);
    row.set("median", percent(e.median, f.median));
    row.set("p95", percent(e.p95, f.p95));
    row.set("p99", percent(e.p99, f.p99));
    row.set("floor", two_digits(100.0 * f.p95));
    row.set("mean", signed_figure(100.0 * errors.mean, 2));
    return row;
}

} // namespace

data error_part(const ComparedDrive& drive) {
    data part, sets{List::list};
    bool said = false, measured = false;
    for (std::size_t i = 0; i < drive.variants.size(); ++i) {
        const PlayedVariant& played = *drive.variants[i];
        const DriveError& error = played.error;
        if (!error.measured() && error.not_measured.empty())
            continue; // the run ended before, or was told to leave it out
        data set, rows{List::list};
        set.set("lamp", short_text(played.variant, 40));
        set.set("colour", variant_colour(i));
        if (error.measured()) {
            set.set("sentence",
                    fmt::format("{} against {} moment{} at {} × {} pixels, which took {} s; {}", clean_text(played.technique),
                                error.ticks.size(), error.ticks.size() == 1 ? "" : "s", error.width_px, error.height_px,
                                figure(error.seconds, 1),
                                played.throughput.view_s ? fmt::format("a frame of the run takes {}", time_text(*played.throughput.view_s))
                                                         : "too few moments were played to time a frame"));
            for (const auto& [where, errors] : {std::pair("road", &error.road), std::pair("whole view", &error.whole)})
                if (*errors && (*errors)->pixels > 0)
                    rows.push_back(error_row(where, **errors));
            measured = true;
        } else {
            set.set("sentence", "not measured: " + clean_text(error.not_measured));
        }
        set.set("rows", rows);
        sets.push_back(set);
        said = true;
    }
    part.set("said", said);
    part.set("measured", measured);
    part.set("sets", sets);
    return part;
}

} // namespace fernlicht
