#include "runner/experiments/compare/runs/played_report.h"

#include "metrics/statistics/statistics.h"
#include "scenarios/lamps/lamp_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

/// NaN where a cell is no number.
std::vector<double> figures_in(const CsvFile& moments, std::size_t column) {
    std::vector<double> figures;
    for (const std::vector<std::string>& row : moments.rows)
        figures.push_back(number_in(row[column]).value_or(std::numeric_limits<double>::quiet_NaN()));
    return figures;
}

void read_reaches(const CsvFile& moments, const std::vector<std::string>& decide, PlayedResult& result) {
    for (std::size_t column = 0; column < moments.heads.size(); ++column)
        if (const auto key = key_of(moments.heads[column]); key && key->quantity == Quantity::reach && key->aspect == Aspect::value &&
                                                            key->statistic == Statistic::median && place_among(*key, decide))
            result.reaches.push_back({*key, figures_in(moments, moments.column("car.distance_m")), figures_in(moments, column)});
}

/// Over the moments in which there is a distance; only drives with eyes to glare have any.
void read_glares(const PlayedCell& played, const CsvFile& moments, PlayedResult& result) {
    for (const SeeingSeries& series : played.seeing) {
        const auto eye = eye_of(series.subject);
        const std::string facing = series.subject + ".facing_lx";
        if (!eye || std::ranges::find(moments.heads, facing) == moments.heads.end())
            continue;
        const std::vector<double> at_m = figures_in(moments, moments.column(series.subject + ".at_m")),
                                  facing_lx = figures_in(moments, moments.column(facing));
        GlareOverDrive glare{*eye, series.over, {}, {}};
        for (std::size_t i = 0; i < at_m.size(); ++i)
            if (!std::isnan(at_m[i])) {
                glare.at_m.push_back(at_m[i]);
                glare.facing_lx.push_back(facing_lx[i]);
            }
        for (std::size_t column = 0; column < moments.heads.size(); ++column)
            if (moments.heads[column].starts_with(series.subject + ".theta_"))
                add_gaze(result.gazes, played.drive, series, at_m, figures_in(moments, column));
        if (!glare.at_m.empty())
            result.glares.push_back(std::move(glare));
    }
}

std::string file_below(const std::string& folder, const std::string& file) {
    return file.empty() || folder.empty() ? file : folder + "/" + file;
}

} // namespace

ReadingsOfCell whole_drive_readings(const PlayedCell& played) {
    ReadingsOfCell result;
    for (const Reading& reading : played.readings)
        if (reading.tick < 0)
            result.readings.emplace(reading.key, reading);
    for (const ReadingSpread& spread : played.repeats.spread) // of one play: its standard deviation times Student's t, two-sided, 5 %
        if (spread.count > 1 && spread.tick < 0)
            result.by_repeats[spread.key] = student_bound(spread.count - 1, 0.05, 1) * std::sqrt(spread.variance);
    return result;
}

PlayedResult played_result(const PlayedCell& played, const CsvFile& moments, const std::string& folder,
                           const std::vector<std::string>& decide) {
    PlayedResult result;
    static_cast<ReadingsOfCell&>(result) = whole_drive_readings(played);
    result.drive = played.drive;
    result.lamp_set = played.lamp_set;
    result.aims = played.aims;
    result.series = played.series;
    result.verdicts = played.verdicts;
    for (const StoredFrame& frame : played.frames)
        result.frames.push_back({frame.tick, frame.time_s, frame.view, file_below(folder, frame.png), file_below(folder, frame.exr)});
    read_reaches(moments, decide, result);
    read_glares(played, moments, result);
    if (const std::optional<PixelErrors>& road = played.error.road; road && road->pixels > 0) {
        result.error_share = road->error.p95;
        result.error_floor_share = road->floor.p95;
    }
    result.frame_s = played.throughput.view_s;
    return result;
}

} // namespace fernlicht
