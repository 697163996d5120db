#include "metrics/statistics/statistics.h"
#include "runner/experiments/fit/fit_result.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr double certainly = 0.999; // of chi squared, below

/// How values are told: of what unit, times what.
struct Telling {
    const char* unit;
    double times;
};
Telling telling_of(FitQuantity quantity) {
    return quantity == FitQuantity::flux     ? Telling{"%", 100.0}
           : quantity == FitQuantity::height ? Telling{"mm", 1000.0}
                                             : Telling{"°", 1.0};
}

/// Change from the drive; of flux in per cent.
double told_change(const FitValue& value) {
    return telling_of(value.quantity).times * (value.quantity == FitQuantity::flux ? value.change - 1.0 : value.change);
}

/// Decimals that show two digits of an error.
int decimals_for(double error) { return error > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9) : 3; }

Cell change_cell(const FitValue& value) {
    if (!value.standard_error)
        return "held";
    const double error = telling_of(value.quantity).times * *value.standard_error;
    const int decimals = decimals_for(error);
    return {fmt::format("{} ± {}", signed_figure(told_change(value), decimals), figure(error, decimals)), told_change(value)};
}

std::string value_text(double value, FitQuantity quantity, int decimals) {
    return quantity == FitQuantity::flux     ? fmt::format("{:.{}f}", value, decimals)
           : quantity == FitQuantity::height ? fmt::format("{} m", figure(value, decimals))
                                             : figure(value, decimals) + "°";
}

Table change_table(const FitResult& result) {
    Table table{
        "lamps",
        "What the points make of each lamp, as a change from the drive: pitch upwards, yaw to the left, flux, height. ± one standard "
        "error",
        columns_of("lamp<|pitch [°]|yaw [°]|flux [%]|height [mm]"),
        {}};
    for (std::size_t i = 0; i < result.values.size(); i += fit_quantities) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{result.values[i].lamp});
        for (std::size_t k = 0; k < fit_quantities; ++k)
            cells.push_back(change_cell(result.values[i + k]));
    }
    return table;
}

Table value_table(const FitResult& result) {
    Table table{"values",
                "The same as values: in the drive, and fitted",
                columns_of("value<|drive|fitted|standard error|held, or changes alike<"),
                {}};
    for (const FitValue& value : result.values) {
        const int decimals = value.standard_error ? decimals_for(*value.standard_error) : 4;
        table.rows.push_back({name_of(value),
                              {value_text(value.of_drive, value.quantity, decimals), value.of_drive},
                              {value_text(value.fitted(), value.quantity, decimals), value.fitted()},
                              value.standard_error ? Cell(two_digits(*value.standard_error), *value.standard_error) : Cell("held"),
                              !value.held.empty()   ? Cell(value.held)
                              : !value.with.empty() ? Cell("alike with " + value.with)
                                                    : Cell("")});
    }
    table.off_terminal = true;
    return table;
}

std::optional<Table> correlation_table(const FitResult& result) {
    std::vector<std::size_t> fitted;
    std::string heads = "value<";
    for (std::size_t i = 0; i < result.values.size(); ++i)
        if (result.values[i].standard_error) {
            fitted.push_back(i);
            heads += "|" + result.values[i].lamp + ": " + name_of(result.values[i].quantity);
        }
    if (fitted.size() < 2)
        return std::nullopt;
    Table table{"correlation", "Correlations of the fitted values; fit.json has their covariance", columns_of(heads), {}};
    for (const std::size_t row : fitted) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{name_of(result.values[row])});
        for (const std::size_t column : fitted) {
            const double correlation =
                result.covariance[row][column] / std::sqrt(result.covariance[row][row] * result.covariance[column][column]);
            cells.push_back({figure(correlation, 2), correlation});
        }
    }
    table.off_terminal = true;
    return table;
}

std::string place_text(const FitPoint& point) {
    return fmt::format("line {}{}", point.read.line, point.read.name.empty() ? "" : ", " + point.read.name);
}

Table point_table(const FitResult& result) {
    Table table{"points",
                "All points. Residual: read less calculated, in standard uncertainties; outliers are in grey",
                columns_of("point<|ahead [m]|left [m]|above [m]|lamps<|read [lx]|calculated [lx]|residual"),
                {}};
    for (const FitPoint& point : result.points) {
        if (point.found.outlier)
            table.quiet.push_back(table.rows.size());
        table.rows.push_back({place_text(point),
                              {figure(point.read.ahead_m, 2), point.read.ahead_m},
                              {figure(point.read.left_m, 2), point.read.left_m},
                              {figure(point.read.above_m, 3), point.read.above_m},
                              point.read.lamps.empty() ? "all" : point.read.lamps,
                              {four_digits(point.read.lux), point.read.lux},
                              {four_digits(point.found.calculated_lx), point.found.calculated_lx},
                              {signed_figure(point.found.residual, 1), point.found.residual}});
    }
    table.folded = table.off_terminal = table.sortable = true;
    return table;
}

std::string misfit_text(const FitResult& result) {
    if (!result.consistent)
        return fmt::format("{} for {}: nothing is left over to tell how well they fit", counted(result.used, "point"),
                           counted(result.unknowns, "value"));
    const std::string figures = fmt::format("chi squared {:.1f} with {} degrees of freedom, of which chance exceeds {:.1f} once in 1000",
                                            result.chi_squared, result.freedom, result.chi_squared_limit);
    if (result.error_scale > 1.0)
        return fmt::format("The residuals are larger than the uncertainties say: {}. Standard errors are multiplied by {:.2f}", figures,
                           result.error_scale);
    if (!*result.consistent)
        return fmt::format("{} of {} points are outliers, more than {:g} %; of the others, {}", result.points.size() - result.used,
                           result.points.size(), 100.0 * most_outliers, figures);
    if (result.chi_squared < chi_squared_bound(result.freedom, certainly))
        return "The residuals are smaller than the uncertainties say, so that standard errors are too large: " + figures;
    return "The residuals are as large as the uncertainties say: " + figures;
}

/// What fits and yet can hardly be meant: light far from the drive's, and few points for what is fitted.
std::vector<std::string> doubts_of(const FitResult& result) {
    constexpr double far_off = 2.0; // as a factor: lamps of one type differ by tenths
    constexpr std::size_t points_a_value = 10;
    std::vector<std::string> doubts;
    for (const FitValue& value : result.values)
        if (value.quantity == FitQuantity::flux && value.standard_error && (value.change > far_off || value.change < 1.0 / far_off))
            doubts.push_back(
                fmt::format("Warning: by the points {} has about {:.3g} times the light of the drive's: are the points in lux (a "
                            "foot-candle is 10.8 lx), and is the drive's file that of this lamp?",
                            value.lamp, value.change));
    if (result.used < points_a_value * result.unknowns)
        doubts.push_back(fmt::format("Warning: {} for {} are few: one wrong reading bends them, and nothing shows it; at least 200 points "
                                     "at three distances are asked for",
                                     counted(result.used, "point"), counted(result.unknowns, "value")));
    return doubts;
}

std::vector<Cell> outliers_of(const FitResult& result) {
    std::vector<Cell> items;
    for (const FitPoint& point : result.points)
        if (point.found.outlier)
            items.emplace_back(fmt::format("{}: read {} lx, calculated {} lx ({} standard uncertainties)", place_text(point),
                                           four_digits(point.read.lux), four_digits(point.found.calculated_lx),
                                           signed_figure(point.found.studentised.value_or(point.found.residual), 1)));
    return items;
}

} // namespace

std::string name_of(const FitValue& value) { return fmt::format("{} of {}", name_of(value.quantity), value.lamp); }

std::vector<std::string> fit_verdicts(const FitResult& result) {
    std::vector<std::string> verdicts;
    if (!result.failed.empty())
        verdicts.push_back("Not to be used: " + result.failed);
    verdicts.push_back(misfit_text(result));
    for (std::string& doubt : doubts_of(result))
        verdicts.push_back(std::move(doubt));
    for (const FitValue& value : result.values) {
        if (!value.held.empty() && value.held != result.failed)
            verdicts.push_back(
                fmt::format("{} is held at {}: {}", name_of(value), value_text(value.of_drive, value.quantity, 3), value.held));
        if (!value.with.empty() && value.lamp < value.with)
            verdicts.push_back(
                fmt::format("{} changes alike with that of {}: the points cannot tell the two apart", name_of(value), value.with));
    }
    for (const std::string& lamp : result.not_lit)
        verdicts.push_back(lamp + " shone on no point: nothing of it is fitted");
    verdicts.insert(verdicts.end(), result.notes.begin(), result.notes.end());
    return verdicts;
}

Document document(const FitResult& result) {
    Document document{"Lamps fitted to measured points", {}};
    Section& top = document.sections.emplace_back(Section{result.title + ", " + result.lamp_set, {}});
    top.verdict = good(result) ? "pass" : "fail";
    top.blocks.emplace_back(fmt::format("{} of `{}`, {} of them used.", counted(result.points.size(), "point"),
                                        result.points_file.filename().string(), result.used));
    top.blocks.emplace_back(change_table(result));
    top.blocks.emplace_back(Listing(fit_verdicts(result)));
    if (std::vector<Cell> outliers = outliers_of(result); !outliers.empty())
        top.blocks.emplace_back(
            Listing(std::move(outliers), fmt::format("Outliers, left out: beyond {:.2f} standard uncertainties, which one "
                                                     "of {} good points exceeds once in 100 fits",
                                                     result.outlier_from, result.points.size())));
    Section& more = document.sections.emplace_back();
    more.blocks.emplace_back(Plot{"residuals", residual_plot(result)});
    more.blocks.emplace_back(Plot{"agreement", agreement_plot(result)});
    more.blocks.emplace_back(value_table(result));
    if (std::optional<Table> correlations = correlation_table(result))
        more.blocks.emplace_back(std::move(*correlations));
    more.blocks.emplace_back(point_table(result));
    return document;
}

} // namespace fernlicht
