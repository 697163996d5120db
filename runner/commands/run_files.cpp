#include "runner/commands/run_files.h"

#include "runner/findings/moment_columns.h"
#include "runner/write/document.h"
#include "runner/write/report_texts.h"

namespace fernlicht {

std::string report_html(const Report& report, const std::filesystem::path& folder) {
    return run_page_html(report, run_page(report), folder);
}

void write_report(const Report& report, const std::filesystem::path& folder, const OutputFormat* tables) {
    // The figures first, the large page last: a disk that fills up takes the page before it takes the numbers.
    write_file(folder / "readings.csv", report_csv(report));
    write_file(folder / "times.csv", times_csv(report));
    write_file(folder / "junit.xml", report_junit(report));
    write_file(folder / "report.json", report_json(report));
    const std::vector<std::string> files = moments_files(report.played);
    for (std::size_t i = 0; i < files.size(); ++i)
        if (const std::string moments = moments_csv(report.played[i]); !moments.empty())
            write_file(folder / files[i], moments);
    if (tables)
        write_tables(document(report), folder, *tables);
    write_file(folder / "report.html", report_html(report, folder));
}

void write_judgement(const Report& report, const std::filesystem::path& folder) {
    const std::filesystem::path page = folder / "report.html", json = folder / "report.json";
    FilesRead kept;
    write_file(folder / "junit.xml", report_junit(report));
    write_file(page, rejudged_page_html(report, verdict_page(report), read_file(page, kept), page));
    write_file(json, rejudged_json(read_file(json, kept), report));
}

} // namespace fernlicht
