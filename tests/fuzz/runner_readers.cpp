#include "tests/fuzz/readers.h"

#include "runner/experiments/compare/runs/run_folder.h"
#include "runner/experiments/fit/lux_points.h"
#include "runner/files/csv_file.h"
#include "runner/files/picture_file.h"
#include "runner/judge/baseline.h"
#include "runner/judge/baseline_store.h"
#include "runner/judge/known_failures.h"
#include "runner/judge/reference_results.h"

namespace fernlicht::fuzz {
namespace {

namespace fs = std::filesystem;

/// Index and object each by itself: an object that an index names must have its hash for a name.
void read_store(const fs::path& folder) {
    tried([&] { list_baselines(folder); });
    read_baseline_object(folder / "object.json");
}

void read_written_picture(const fs::path& folder) {
    const fs::path file = folder / "frame.exr";
    tried([&] { read_png_tags(file); });
    tried([&] { read_png(file); });
    read_exr(file);
}

void read_points(const fs::path& folder) {
    FilesRead opened;
    tried([&] { read_csv(folder / "points.csv"); });
    read_lux_points(folder / "points.csv", opened);
}

} // namespace

std::span<const Reader> runner_readers() {
    static const std::vector<Reader> all{
        {"store", {"index.json", "object.json"}, read_store, "runner/judge/baseline.cpp runner/judge/baseline_store.cpp", ""},
        {"results",
         {"report.json", "readings.csv", "moments-straight-halogen.csv", "straight.yaml"},
         [](const fs::path& folder) { read_run_folder(folder); },
         "runner/experiments/run/report_json.cpp runner/findings",
         ""},
        {"rays", {"reference.json"}, [](const fs::path& folder) { read_ray_folder(folder); }, "runner/judge/reference_results.cpp", ""},
        {"frame", {"frame.exr"}, read_written_picture, "", ""},
        {"known",
         {"known.yaml"},
         [](const fs::path& folder) { read_known_failures(folder / "known.yaml"); },
         "runner/judge/known_failures.cpp",
         "ci/known-failures.yaml"},
        {"points", {"points.csv"}, read_points, "runner/experiments/fit/lux_points.cpp", ""},
    };
    return all;
}

} // namespace fernlicht::fuzz
