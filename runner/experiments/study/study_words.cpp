#include "runner/experiments/study/study_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

/// "9", or "9 to 30" where cells differ.
std::string range_over(const std::vector<CellResult>& cells, int CellResult::*count) {
    int least = std::numeric_limits<int>::max(), most = 0;
    for (const CellResult& cell : cells) {
        least = std::min(least, cell.*count);
        most = std::max(most, cell.*count);
    }
    return least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most);
}

bool is_cut(const CellResult& cell) { return cell.moments < cell.moments_of_drive; }

std::size_t count_deciding(const StudyResult& result, std::optional<ChangeKind> kind = {}) {
    return static_cast<std::size_t>(
        std::ranges::count_if(result.changes, [&](const Change& change) { return change.decides && (!kind || change.kind == *kind); }));
}

} // namespace

const std::string& lamp_of(const StudyResult& result, std::size_t cell) { return result.study.lamps[result.cells[cell].cell.lamp].name; }

bool was_judged(const StudyResult& result) {
    return !result.complete() || !result.verdicts.empty() ||
           std::ranges::any_of(result.cells, [](const CellResult& cell) { return !cell.verdicts.empty(); });
}

std::string nothing_compared(const StudyResult& result) {
    const std::size_t deciding = count_deciding(result);
    if (result.study.comparisons.empty() || deciding > count_deciding(result, ChangeKind::unknown))
        return "";
    if (deciding > 0)
        return fmt::format("Nothing could be compared: of none of {} changes of deciding readings is it known how exact they are.",
                           deciding);
    return result.changes.empty() ? "Nothing could be compared: of no two lamps was the same cell played."
                                  : "Nothing could be compared: no deciding reading is in two cells that are compared.";
}

std::string study_sentence(const StudyResult& result) {
    if (result.study.comparisons.empty())
        return "Nothing was to be compared.";
    if (const std::string nothing = nothing_compared(result); !nothing.empty())
        return nothing;
    const std::size_t unknown = count_deciding(result, ChangeKind::unknown);
    return fmt::format("Of {} deciding readings {} changed for real, {} by less than 0.1° of aim would do{}.", count_deciding(result),
                       count_deciding(result, ChangeKind::real), count_deciding(result, ChangeKind::within_aim),
                       unknown > 0 ? fmt::format("; of {} it is not known", unknown) : "");
}

std::string played_in_part(const StudyResult& result) {
    if (!std::ranges::any_of(result.cells, is_cut))
        return "";
    return fmt::format("{} of {} moments of each drive were played (--frames {})", range_over(result.cells, &CellResult::moments),
                       range_over(result.cells, &CellResult::moments_of_drive), result.frames);
}

std::string moments_text(const StudyResult& result, const CellResult& cell) {
    return is_cut(cell) ? fmt::format("{} of {} moments (--frames {})", cell.moments, cell.moments_of_drive, result.frames) : "all moments";
}

} // namespace fernlicht
