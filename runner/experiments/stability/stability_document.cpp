#include "runner/experiments/stability/stability_case.h"

#include "runner/files/json_text.h"
#include "runner/findings/figures.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

std::string measured(const StabilityRow& row) {
    if (row.verdict == Judgement::not_measured)
        return "-";
    return std::isfinite(row.found.error) ? fmt::format("{:.3g}", row.found.error) : "not finite";
}

std::string where(const StabilityRow& row) {
    if (!row.found.not_measured.empty())
        return row.found.not_measured;
    // Of trials that are all right none is the worst.
    return row.found.error == 0.0 && row.found.trials > 1 ? fmt::format("none in {} trials", row.found.trials) : row.found.where;
}

/// "51 cases: 50 pass, 1 not_measured (road/x: reason)"
std::string summary_of(const std::vector<StabilityRow>& rows) {
    std::size_t passed = 0, failed = 0, unmeasured = 0;
    std::string names;
    for (const StabilityRow& row : rows) {
        passed += row.verdict == Judgement::pass ? 1U : 0U;
        failed += row.verdict == Judgement::fail ? 1U : 0U;
        unmeasured += row.verdict == Judgement::not_measured ? 1U : 0U;
        if (row.verdict != Judgement::pass)
            names += fmt::format("{}{} ({})", names.empty() ? ": " : ", ", row.of->full_name(), judgement_name(row.verdict));
    }
    return fmt::format("{}: {} pass, {} fail, {} not_measured{}", counted(rows.size(), "case"), passed, failed, unmeasured, names);
}

} // namespace

Document document(const StabilityRow& row) {
    const StabilityCase& of = *row.of;
    return {of.full_name(),
            {{fmt::format("{:<12} {:<32} {} {} (bound {:g}), {:.1f} s", judgement_name(row.verdict), of.full_name(), measured(row), of.unit,
                          of.bound, row.seconds),
              {Listing{std::vector<Cell>{"breaks:  " + of.could_break, "bound:   " + of.reason, "worst:   " + where(row)}}}}}};
}

Document document(const StabilityResult& result) {
    Table table{"stability", "", {}, {}, true};
    for (const char* head : {"case", "what could break", "worst error", "bound", "reason of the bound", "verdict"})
        table.columns.push_back({.head = head, .words = true});
    for (const StabilityRow& row : result.rows)
        table.rows.push_back({row.of->full_name(), row.of->could_break, fmt::format("{} ({})", measured(row), where(row)),
                              fmt::format("{:g} {}", row.of->bound, row.of->unit), row.of->reason, judgement_name(row.verdict)});
    return {"Extreme and degenerate inputs", {{"", {table, summary_of(result.rows)}}}};
}

std::string stability_json(const StabilityResult& result) {
    Json list = Json::array();
    for (const StabilityRow& row : result.rows) {
        const bool has = row.verdict != Judgement::not_measured && std::isfinite(row.found.error);
        list.push_back({{"case", row.of->full_name()},
                        {"could_break", row.of->could_break},
                        {"error", has ? Json(row.found.error) : Json(nullptr)},
                        {"unit", row.of->unit},
                        {"bound", row.of->bound},
                        {"reason", row.of->reason},
                        {"where", where(row)},
                        {"trials", row.found.trials},
                        {"not_measured", row.found.not_measured.empty() ? Json(nullptr) : Json(row.found.not_measured)},
                        {"verdict", judgement_name(row.verdict)}});
    }
    return json_text(Json{{"schema", "fernlicht stability"},
                          {"schema_version", 1},
                          {"fernlicht", FERNLICHT_VERSION},
                          {"device", result.device.empty() ? Json(nullptr) : Json(result.device)},
                          {"rows", list}});
}

} // namespace fernlicht
