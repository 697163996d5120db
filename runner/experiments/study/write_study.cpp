#include "runner/experiments/study/study_run.h"
#include "runner/experiments/study/study_writers.h"
#include "runner/write/plots/png.h"

#include <system_error>

namespace fernlicht {

void write_study(StudyResult& result, const std::filesystem::path& folder) {
    result.figures = study_figures(result, folder);
    // The figures first, the large page last: a disk that fills up takes the page before it takes the numbers.
    write_file(folder / "study.json", study_json(result));
    write_file(folder / "study.csv", study_csv(result));
    write_file(folder / "study.md", study_markdown(result));
    write_file(folder / "study.tex", study_latex(result));
    write_file(folder / "junit.xml", study_junit(result));
    write_file(folder / "study.yaml", result.study.text);
    std::error_code ignored; // a folder that cannot be made shows in the first file below it
    std::filesystem::create_directories(folder / "figures", ignored);
    for (const StudyFigure& figure : result.figures) {
        write_file(folder / "figures" / (figure.name + ".svg"), figure.svg);
        write_file(folder / "figures" / (figure.name + ".png"), plots::png_of_svg(figure.svg, 2.0));
    }
    write_file(folder / "report.html", study_html(result, folder));
}

} // namespace fernlicht
