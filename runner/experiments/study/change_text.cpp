#include "runner/experiments/study/change_text.h"

#include "metrics/readings/reading_labels.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// The larger of both values.
double larger_value(const Change& change) {
    return std::max(std::abs(change.old_value.figure().value_or(0.0)), std::abs(change.new_value.figure().value_or(0.0)));
}

} // namespace

Cell cell_of(const Value& value, const std::string& rounded) {
    return value.measured() ? Cell(with_bound(value, rounded), *value.figure()) : Cell("not measured");
}

int decimals_of(const Change& change) {
    const double changed = std::abs(change.change().figure().value_or(0.0));
    const Value& known = change.old_value.measured() ? change.old_value : change.new_value;
    const double size = std::max(changed > 1e-6 ? changed : std::abs(known.figure().value_or(0.0)), change.uncertainty.value_or(0.0));
    return size < 0.1 && size > 1e-6 ? std::min(1 - static_cast<int>(std::floor(std::log10(size))), 7) : 2;
}
Cell value_cell(const Value& value, int decimals) { return cell_of(value, figure(value.figure().value_or(0.0), decimals)); }
Cell change_cell(const Change& change) {
    const Value found = change.change();
    return found.measured() ? cell_of(found, signed_figure(*found.figure(), decimals_of(change))) : Cell("");
}
Cell open_cell(const Change& change, const std::optional<double>& value) {
    return value ? Cell(open_figure(*value, larger_value(change)), *value) : Cell("");
}
std::string open_words(const Change& change, double value, const std::string& behind) {
    return open_words(value, larger_value(change), behind);
}

std::string change_words(const Change& change) {
    const std::string changed = change_cell(change).text;
    const auto share = change.relative();
    return changed.empty() ? change.reason_unknown
                           : changed + unit_suffix(change.unit()) +
                                 (share ? fmt::format(" ({} %)", signed_figure(100.0 * *share, std::abs(*share) < 0.1 ? 1 : 0)) : "");
}

} // namespace fernlicht
