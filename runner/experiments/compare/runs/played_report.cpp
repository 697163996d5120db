#include "runner/experiments/compare/runs/played_report.h"

#include "metrics/statistics/statistics.h"
#include "runner/files/value_json.h"
#include "runner/judge/verdict_json.h"

#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

void read_rows(const CheckedJson& report, PlayedResult& result) {
    for (const CheckedJson& row : report.at("rows").items()) {
        if (!row.at("frame").is_null() || row.at("drive").text() != result.drive || row.at("variant").text() != result.variant)
            continue;
        Reading reading{key_with_unit(row), value_in(row.at("value")), row.at("where").text()};
        if (!reading.value.measured())
            reading.value = Value::not_measured(row.at("not_measured").text());
        result.readings.emplace(reading.key, std::move(reading));
    }
}

/// Of one play: its standard deviation times Student's t, two-sided, 5 %.
void read_repeats(const CheckedJson& played, PlayedResult& result) {
    if (!played.has("repeats"))
        return;
    for (const CheckedJson& spread : played.at("repeats").at("spread").items())
        if (const int count = spread.at("count").whole(); count > 1 && spread.at("frame").is_null())
            result.by_repeats[key_in(spread.at("name"))] = student_bound(count - 1, 0.05, 1) * std::sqrt(spread.at("variance").number());
}

void read_reaches(const CheckedJson& played, PlayedResult& result) {
    const CheckedJson extents = played.at("extents");
    std::vector<double> distance_m;
    for (const CheckedJson& distance : extents.at("distance_m").items())
        distance_m.push_back(distance.number());
    for (const CheckedJson& series : extents.at("rendered").items()) {
        if (series.at("lane").text() != "own")
            continue;
        ReachOverDrive reach{
            series.at("plane").text() == "road" ? ExtentPlane::road : ExtentPlane::target, series.at("limit_lx").number(), distance_m, {}};
        for (const CheckedJson& value : series.at("reach_centre_m").items())
            reach.reach_m.push_back(value.number_or_null().value_or(std::numeric_limits<double>::quiet_NaN()));
        if (reach.reach_m.size() == distance_m.size())
            result.reaches.push_back(std::move(reach));
    }
}

/// Only drives with eyes to glare have `seeing`.
void read_glares(const CheckedJson& played, PlayedResult& result) {
    if (!played.has("seeing"))
        return;
    for (const CheckedJson& series : played.at("seeing").items()) {
        const auto eye = eye_of(series.at("subject").text());
        if (!eye)
            continue;
        GlareOverDrive glare{*eye, series.at("over").text(), {}, {}};
        for (const CheckedJson& at : series.at("at_m").items())
            glare.at_m.push_back(at.number());
        for (const CheckedJson& column : series.at("columns").items())
            if (column.at("name").text() == "facing_lx")
                for (const CheckedJson& value : column.at("values").items())
                    glare.facing_lx.push_back(value_in(value).number().value_or(std::numeric_limits<double>::quiet_NaN()));
        if (!glare.at_m.empty() && glare.facing_lx.size() == glare.at_m.size())
            result.glares.push_back(std::move(glare));
    }
}

std::string file_below(const std::string& folder, const CheckedJson& file) {
    return file.is_null() ? "" : folder.empty() ? file.text() : folder + "/" + file.text();
}

void read_accuracy(const CheckedJson& report, const CheckedJson& played, PlayedResult& result) {
    const CheckedJson accuracy = played.at("accuracy");
    if (accuracy.is_null() || !accuracy.has("road") || !accuracy.at("road").has("relative"))
        return;
    result.error_share = accuracy.at("road").at("relative").at("p95").number();
    result.error_floor_share = accuracy.at("road").at("relative_floor").at("p95").number();
    for (const CheckedJson& time : report.at("accuracy_times").items())
        if (time.at("drive").text() == result.drive && time.at("variant").text() == result.variant)
            result.frame_s = time.at("frame_s").number_or_null();
}

} // namespace

ReadingKey ReachOverDrive::key() const {
    return {.quantity = Quantity::reach,
            .surface = plane == ExtentPlane::road ? ReadingSurface::road : ReadingSurface::target,
            .lane = "own",
            .threshold = {limit_lx, ThresholdUnit::lx},
            .statistic = Statistic::median};
}

PlayedResult read_played(const CheckedJson& report, const CheckedJson& played, const std::string& folder) {
    PlayedResult result;
    result.drive = played.at("drive").text();
    result.variant = played.at("variant").text();
    for (const CheckedJson& verdict : played.at("verdicts").items())
        result.verdicts.push_back(read_verdict(verdict));
    for (const CheckedJson& frame : played.at("frames").items())
        result.frames.push_back({frame.at("frame").whole(), frame.at("time_s").number(), frame.at("view").text(),
                                 file_below(folder, frame.at("png")), file_below(folder, frame.at("exr"))});
    read_rows(report, result);
    read_repeats(played, result);
    read_reaches(played, result);
    read_glares(played, result);
    read_accuracy(report, played, result);
    return result;
}

} // namespace fernlicht
