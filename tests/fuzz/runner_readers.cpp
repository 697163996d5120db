#include "tests/fuzz/readers.h"

#include "runner/experiments/compare/runs/run_folder.h"
#include "runner/experiments/fit/lux_points.h"
#include "runner/experiments/history/night_of_study.h"
#include "runner/files/csv_file.h"
#include "runner/files/packed_folder.h"
#include "runner/files/picture_file.h"
#include "runner/history/history.h"
#include "runner/judge/baseline.h"
#include "runner/judge/baseline_store.h"
#include "runner/judge/known_failures.h"
#include "runner/judge/reference_results.h"
#include "runner/store/cell_store.h"

namespace fernlicht::fuzz {
namespace {

namespace fs = std::filesystem;

/// Index and object each by itself: an object that an index names must have its hash for a name.
void read_store(const fs::path& folder) {
    tried([&] { list_baselines(folder); });
    read_baseline_object(folder / "object.json");
}

constexpr std::string_view cell_entry = "cells/c0/ffffffffffffffffffffffffffffff.json";

/// A cell's entry, and its packed folder by itself: an object that an entry names must have its hash for a name.
void read_cell(const fs::path& folder) {
    const CellStore store(folder);
    tried([&] { store.find("c0" + std::string(30, 'f')); });
    tried([&] { store.list(); });
    FilesRead opened;
    fernlicht::unpacked(read_file(folder / "object", opened), folder / "object");
}

void read_history(const fs::path& folder) {
    const fs::path file = folder / "history.db";
    for (const char* const beside : {"-wal", "-shm", "-journal"}) // of the input before
        fs::remove(file.string() + beside);
    tried([&] { History(file, History::For::reading).nights(); });
    History(file, History::For::collecting).prune(1, "", false); // as `history add` opens it: a new version, if it is an old one
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
        {"study-results",
         {"study.json"},
         [](const fs::path& folder) { read_night(folder); },
         "runner/experiments/study/study_document.cpp runner/findings",
         ""},
        {"cell", {cell_entry, "object"}, read_cell, "runner/store/cell_store.cpp runner/files/packed_folder.cpp", ""},
        {"history", {"history.db"}, read_history, "runner/history/history.cpp", ""},
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
