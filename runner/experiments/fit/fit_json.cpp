#include "runner/experiments/fit/fit_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

std::vector<std::string> quantity_names() {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < fit_quantities; ++k)
        names.emplace_back(name_of(static_cast<FitQuantity>(k)));
    return names;
}

std::string unit_of(FitQuantity quantity) { return quantity == FitQuantity::flux ? "1" : quantity == FitQuantity::height ? "m" : "deg"; }

JsonMembers value_members(FitValue& value) {
    return {{"lamp", value.lamp},
            {"quantity", one_of(value.quantity, quantity_names)},
            {"unit", unit_of(value.quantity)},
            {"drive", value.of_drive},
            {"change", value.change},
            {"fitted", value.fitted()},
            {"standard_error", value.standard_error},
            {"held", or_null(value.held)},
            {"alike_with", or_null(value.with)}};
}

JsonMembers point_members(FitPoint& point) {
    return {{"line", point.read.line},
            {"name", or_null(point.read.name)},
            {"time_s", point.read.time_s},
            {"ahead_m", point.read.ahead_m},
            {"left_m", point.read.left_m},
            {"above_m", point.read.above_m},
            {"facing", point.read.facing},
            {"lamps", or_null(point.read.lamps)},
            {"lux", point.read.lux},
            {"uncertainty_percent", point.read.uncertainty_percent},
            {"uncertainty_lx", point.read.uncertainty_lx},
            {"place_uncertainty_m", point.read.place_uncertainty_m},
            {"calculated_lx", point.found.calculated_lx},
            {"sigma_lx", point.found.sigma_lx},
            {"residual_sigmas", point.found.residual},
            {"studentised", point.found.studentised},
            {"outlier", point.found.outlier},
            {"brightest_lamp", point.lamp},
            {"h_deg", point.found.h_deg},
            {"v_deg", point.found.v_deg}};
}

} // namespace

JsonMembers fit_members(FitResult& result) {
    return {{"schema", json_constant("fernlicht fit")},
            {"schema_version", json_constant(1)},
            {"context", context_members(result.context)},
            {"drive", result.drive},
            {"title", result.title},
            {"lamp_set", result.lamp_set},
            {"points_file", result.points_file},
            {"failed", or_null(result.failed)},
            {"consistent", result.consistent},
            {"chi_squared", or_null(result.chi_squared)},
            {"chi_squared_limit", or_null(result.chi_squared_limit)},
            {"degrees_of_freedom", result.freedom},
            {"unknowns", result.unknowns},
            {"points_used", result.used},
            {"outlier_from", result.outlier_from},
            {"error_scale", result.error_scale},
            {"condition_index", result.condition},
            {"iterations", result.iterations},
            {"values", result.values, value_members},
            {"covariance", result.covariance},
            {"not_lit", result.not_lit},
            {"notes", result.notes},
            {"points", result.points, point_members}};
}

std::string fit_csv(const FitResult& result) {
    std::string out =
        csv_line(std::string("line"), std::string("name"), std::string("time_s"), std::string("ahead_m"), std::string("left_m"),
                 std::string("above_m"), std::string("facing"), std::string("lamps"), std::string("lux"), std::string("calculated_lx"),
                 std::string("sigma_lx"), std::string("residual_sigmas"), std::string("studentised"), std::string("outlier"),
                 std::string("brightest_lamp"), std::string("h_deg"), std::string("v_deg"));
    for (const FitPoint& point : result.points) {
        const LuxReading& read = point.read;
        const FittedPoint& found = point.found;
        out +=
            csv_line(fmt::format("{}", read.line), csv_text(read.name), csv_number(read.time_s), csv_number(read.ahead_m),
                     csv_number(read.left_m), csv_number(read.above_m), csv_text(read.facing), csv_text(read.lamps), csv_number(read.lux),
                     csv_number(found.calculated_lx), csv_number(found.sigma_lx), csv_number(found.residual), csv_number(found.studentised),
                     std::string(found.outlier ? "1" : "0"), csv_text(point.lamp), csv_number(found.h_deg), csv_number(found.v_deg));
    }
    return out;
}

} // namespace fernlicht
