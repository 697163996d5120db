#include "runner/experiments/stability/stability_case.h"

#include "runner/files/json_text.h"
#include "runner/findings/figures.h"
#include "scenarios/values/version.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

std::string measured(const StabilityRow& row) {
    return std::isfinite(row.found.error) ? fmt::format("{:.3g}", row.found.error) : "not finite";
}

std::string where(const StabilityRow& row) {
    // Of trials that are all right none is the worst.
    return row.found.error == 0.0 && row.found.trials > 1 ? fmt::format("none in {} trials", row.found.trials) : row.found.where;
}

const char* verdict(const StabilityRow& row) { return row.passed ? "pass" : "fail"; }

/// "51 cases: 50 pass, 1 fail: road/x"
std::string summary_of(const std::vector<StabilityRow>& rows) {
    std::string failed;
    for (const StabilityRow& row : rows)
        if (!row.passed)
            failed += (failed.empty() ? ": " : ", ") + row.of->full_name();
    const auto passed = static_cast<std::size_t>(std::ranges::count(rows, true, &StabilityRow::passed));
    return fmt::format("{}: {} pass, {} fail{}", counted(rows.size(), "case"), passed, rows.size() - passed, failed);
}

} // namespace

Document document(const StabilityRow& row) {
    const StabilityCase& of = *row.of;
    return {of.full_name(),
            {{fmt::format("{:<12} {:<32} {} {} (bound {:g}), {:.1f} s", verdict(row), of.full_name(), measured(row), of.unit, of.bound,
                          row.seconds),
              {Listing{std::vector<Cell>{"breaks:  " + of.could_break, "bound:   " + of.reason, "worst:   " + where(row),
                                         fmt::format("judged:  {} pixels or other values", row.found.judged)}}}}}};
}

Document document(const StabilityResult& result) {
    Table table{"stability", "", columns_of("case<|what could break<|worst error<|bound<|reason of the bound<|verdict<"), {}, false, true};
    for (const StabilityRow& row : result.rows)
        table.rows.push_back({row.of->full_name(), row.of->could_break, fmt::format("{} ({})", measured(row), where(row)),
                              fmt::format("{:g} {}", row.of->bound, row.of->unit), row.of->reason, verdict(row)});
    return {"Extreme and degenerate inputs", {{"", {table, summary_of(result.rows)}}}};
}

std::string stability_json(const StabilityResult& result) {
    Json list = Json::array();
    for (const StabilityRow& row : result.rows) {
        list.push_back({{"case", row.of->full_name()},
                        {"could_break", row.of->could_break},
                        {"error", std::isfinite(row.found.error) ? Json(row.found.error) : Json(nullptr)},
                        {"unit", row.of->unit},
                        {"bound", row.of->bound},
                        {"reason", row.of->reason},
                        {"where", where(row)},
                        {"trials", row.found.trials},
                        {"judged", row.found.judged},
                        {"verdict", verdict(row)}});
    }
    return json_text(Json{{"schema", "fernlicht stability"},
                          {"schema_version", 2},
                          {"fernlicht", program_version},
                          {"device", result.device.empty() ? Json(nullptr) : Json(result.device)},
                          {"rows", list}});
}

} // namespace fernlicht
