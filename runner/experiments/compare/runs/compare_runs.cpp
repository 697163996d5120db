#include "runner/experiments/compare/runs/compare_runs.h"

#include "metrics/strictness/strictness_classes.h"
#include "runner/experiments/compare/runs/run_writers.h"
#include "runner/files/output_folder.h"

#include <fmt/format.h>

namespace fernlicht {

int compare_two_runs(const CompareRunsRequest& request) {
    std::optional<StrictnessClass> strictness;
    if (!request.strictness.empty())
        strictness = read_strictness(request.strictness);
    RunCompareOptions options;
    options.pixels_per_degree = request.pixels_per_degree;
    options.strictness = strictness ? &*strictness : nullptr;
    RunFolder before = read_run_folder(request.before), now = read_run_folder(request.now);
    std::optional<OutputFolder> folder;
    if (!request.out.empty())
        folder.emplace(request.out);
    const std::unique_ptr<RunComparison> runs = compare_runs(std::move(before), std::move(now), options);
    if (folder) {
        draw_runs(*runs, options, request.pictured, folder->path());
        write_file(folder->path() / "compare.json", runs_json(*runs));
        write_file(folder->path() / "compare.csv", runs_csv(*runs));
        write_file(folder->path() / "frames.csv", frames_csv(*runs));
        write_file(folder->path() / "report.html", runs_html(*runs, folder->path()));
        folder->finish();
    }
    fmt::print("{}", request.json ? runs_json(*runs) : runs_text(*runs));
    if (folder && !request.json)
        fmt::print("\n{}\n", (folder->path() / "report.html").string());
    return runs->passed() ? 0 : 1;
}

} // namespace fernlicht
