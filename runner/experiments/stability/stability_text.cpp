#include "runner/experiments/stability/stability_text.h"

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

} // namespace

std::string stability_text(const StabilityRow& row) {
    const StabilityCase& of = *row.of;
    return fmt::format("{:<12} {:<32} {} {} (bound {:g}), {:.1f} s\n    breaks:  {}\n    bound:   {}\n    worst:   {}\n",
                       judgement_name(row.verdict), of.full_name(), measured(row), of.unit, of.bound, row.seconds, of.could_break,
                       of.reason, where(row));
}

std::string stability_summary(const std::vector<StabilityRow>& rows) {
    std::size_t passed = 0, failed = 0, unmeasured = 0;
    std::string names;
    for (const StabilityRow& row : rows) {
        passed += row.verdict == Judgement::pass ? 1U : 0U;
        failed += row.verdict == Judgement::fail ? 1U : 0U;
        unmeasured += row.verdict == Judgement::not_measured ? 1U : 0U;
        if (row.verdict != Judgement::pass)
            names += fmt::format("{}{} ({})", names.empty() ? ": " : ", ", row.of->full_name(), judgement_name(row.verdict));
    }
    return fmt::format("{}: {} pass, {} fail, {} not_measured{}\n", counted(rows.size(), "case"), passed, failed, unmeasured, names);
}

Table stability_table(const std::vector<StabilityRow>& rows) {
    Table table{"stability", "", {}, {}};
    for (const char* head : {"case", "what could break", "worst error", "bound", "reason of the bound", "verdict"})
        table.columns.push_back({.head = head, .words = true});
    for (const StabilityRow& row : rows)
        table.rows.push_back({row.of->full_name(), row.of->could_break, fmt::format("{} ({})", measured(row), where(row)),
                              fmt::format("{:g} {}", row.of->bound, row.of->unit), row.of->reason, judgement_name(row.verdict)});
    return table;
}

std::string stability_json(const std::vector<StabilityRow>& rows, const std::string& device) {
    Json list = Json::array();
    for (const StabilityRow& row : rows) {
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
                          {"device", device.empty() ? Json(nullptr) : Json(device)},
                          {"rows", list}});
}

} // namespace fernlicht
