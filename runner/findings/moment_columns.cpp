#include "runner/findings/moment_columns.h"

#include "runner/files/output_folder.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

class Columns {
  public:
    explicit Columns(std::size_t moments) : moments_(moments) {}

    void text(const std::string& name, std::size_t moment, std::string text) {
        const auto [place, is_new] = places_.try_emplace(name, columns_.size());
        if (is_new)
            columns_.push_back({name, std::vector<std::string>(moments_)});
        if (moment < moments_)
            columns_[place->second].cells[moment] = std::move(text);
    }
    void number(const std::string& name, std::size_t moment, double value) { text(name, moment, fmt::format("{}", checked(name, value))); }
    void metres(const std::string& name, std::size_t moment, double value) {
        number(name, moment, std::round(checked(name, value) * 1e4) / 1e4 + 0.0);
    }
    void seven_digits(const std::string& name, std::size_t moment, const Value& value) {
        text(name, moment, value.measured() ? with_bound(value, fmt::format("{:.7g}", *value.figure())) : value.reason());
    }
    std::vector<MomentColumn> take() { return std::move(columns_); }

  private:
    static double checked(const std::string& name, double value) {
        if (!std::isfinite(value))
            throw std::logic_error(fmt::format("report: {} is {}; a measurement that cannot be made is not_measured", name, value));
        return value;
    }

    std::size_t moments_;
    std::vector<MomentColumn> columns_;
    std::map<std::string, std::size_t> places_;
};

std::string column_name(ReadingKey reading) {
    reading.statistic = Statistic::median; // which goes without saying in its name
    return name_of(reading);
}

std::string figure_name(const ExtentKey& key, const ExtentFigure& figure) {
    return column_name(extent_reading(key, figure.quantity, figure.place, figure.aspect));
}

/// Of the rendered image under the reading's own name, of the twin with another end.
void add_lane(Columns& columns, const PlayedCell& played, const ExtentKey& key) {
    std::vector<std::pair<std::string, double LaneExtent::*>> figures;
    for (const ExtentFigure& figure : extent_figures())
        if (figure.member && figure.aspect == Aspect::value)
            figures.emplace_back(figure_name(key, figure), figure.member);
    for (const auto& [source, end] : {std::pair(&ExtentRow::rendered, ""), std::pair(&ExtentRow::twin, ".twin")})
        for (std::size_t i = 0; i < played.extents.size(); ++i) {
            const LaneExtent* const extent = find_extent(played.extents[i].*source, key);
            if (!extent)
                continue;
            for (const auto& [name, member] : figures) {
                columns.metres(name + end, i, extent->*member);
                if (member == &LaneExtent::reach_centre_m)
                    columns.text(name + end + ".cut_off", i, extent->reach_is_cut_off ? "1" : "0");
            }
            for (const LaneExtent::Width& width : extent->widths) {
                const std::string name =
                    column_name(extent_reading(key, Quantity::width, ReadingPlace::none, Aspect::value, width.at_m)) + end;
                columns.metres(name, i, width.width_m);
                columns.metres(name + ".left", i, width.left_m);
                columns.metres(name + ".right", i, width.right_m);
            }
        }
}

/// The grid's error in the own lane's reach and in the area.
void add_uncertainty(Columns& columns, const ExtentRow& row, std::size_t moment) {
    const auto add = [&](const auto& entry, const ExtentFigure& figure, double value) {
        columns.metres(figure_name({entry.surface, entry.lane, entry.threshold_lx}, figure), moment, value);
    };
    for (const GridError& error : row.grid_errors)
        for (const ExtentFigure& figure : extent_figures())
            if (figure.grid_error && error.lane == figure.error_column_of && (error.*figure.grid_error).measured())
                add(error, figure, *(error.*figure.grid_error).number());
}

void add_car(Columns& columns, const CarRow& row, std::size_t moment) {
    columns.number("car.pitch_deg", moment, row.pitch_deg);
    columns.number("car.rear_lift_mm", moment, row.rear_lift_mm);
    if (row.roll_deg)
        columns.number("car.roll_deg", moment, *row.roll_deg);
    if (row.levelling_deg)
        columns.number("car.levelling_deg", moment, *row.levelling_deg);
    if (row.swivel_deg)
        columns.number("car.swivel_deg", moment, *row.swivel_deg);
}

void add_bus_input(Columns& columns, const BusSignalReport& signal, const std::vector<int>& ticks, int first_tick) {
    const std::string name = fmt::format("{} [{}]", signal.name, signal.unit);
    for (const auto& [values, end] : {std::pair(&signal.value, ""), std::pair(&signal.received, ".received")})
        for (std::size_t i = 0; i < std::min(values->size(), ticks.size()); ++i)
            columns.seven_digits(name + end, static_cast<std::size_t>(ticks[i] - first_tick), Value::of((*values)[i], ""));
}

} // namespace

std::size_t moment_count(const PlayedCell& played) { return std::max({played.extents.size(), played.speed_mps.size(), played.car.size()}); }

std::vector<MomentColumn> moment_columns(const PlayedCell& played) {
    const std::size_t moments = moment_count(played);
    Columns columns(moments);
    for (std::size_t i = 0; i < moments; ++i)
        columns.text("frame", i, fmt::format("{}", played.first_tick + static_cast<int>(i)));
    for (std::size_t i = 0; i < played.speed_mps.size(); ++i) {
        columns.number("time_s", i, std::round(1.0e9 * played.speed_mps[i].first) / 1.0e9); // 3 x 0.2 s as 0.6
        columns.number("car.speed_mps", i, played.speed_mps[i].second);
    }
    for (std::size_t i = 0; i < played.extents.size(); ++i)
        columns.metres("car.distance_m", i, played.extents[i].distance_m);
    for (std::size_t i = 0; i < played.car.size(); ++i)
        add_car(columns, played.car[i], i);
    for (const ExtentKey& key : extent_keys(played))
        add_lane(columns, played, key);
    for (std::size_t i = 0; i < played.extents.size(); ++i)
        add_uncertainty(columns, played.extents[i], i);
    for (const SeeingSeries& series : played.seeing)
        for (std::size_t i = 0; i < series.ticks.size(); ++i) {
            const auto moment = static_cast<std::size_t>(series.ticks[i] - played.first_tick);
            columns.metres(series.subject + ".at_m", moment, series.at_m[i]);
            for (const SeeingSeries::Column& column : series.columns)
                columns.seven_digits(series.subject + "." + column.name, moment, column.values[i]);
        }
    for (const BusSignalReport& signal : played.bus.signals)
        add_bus_input(columns, signal, played.bus.frame, played.first_tick);
    return columns.take();
}

std::vector<std::string> moments_files(const std::vector<PlayedCell>& played) {
    std::vector<std::string> files;
    for (const PlayedCell& cell : played) {
        const std::string stem = "moments-" + file_name_of(cell.drive + "-" + cell.lamp_set);
        std::string file = stem + ".csv";
        for (int n = 2; std::ranges::find(files, file) != files.end(); ++n)
            file = fmt::format("{}-{}.csv", stem, n);
        files.push_back(std::move(file));
    }
    return files;
}

} // namespace fernlicht
