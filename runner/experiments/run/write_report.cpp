#include "runner/experiments/run/report_writers.h"
#include "runner/write/report_texts.h"

namespace fernlicht {

void write_report(const Report& report, const std::filesystem::path& folder, TableFormat tables) {
    // The figures first, the large page last: a disk that fills up takes the page before it takes the numbers.
    write_file(folder / "readings.csv", report_csv(report));
    write_file(folder / "times.csv", times_csv(report));
    write_file(folder / "junit.xml", report_junit(report));
    write_file(folder / "report.json", report_json(report));
    write_tables(document(report), folder, tables);
    write_file(folder / "report.html", report_html(report, folder));
}

} // namespace fernlicht
