#include "runner/experiments/compare/lamps/compare_lamps.h"

#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/files/output_folder.h"
#include "runner/write/plots/png.h"

#include <fmt/format.h>
#include <system_error>

namespace fernlicht {

int compare_two_lamps(const CompareLampsRequest& request) {
    const std::unique_ptr<LampPairComparison> lamps =
        compare_lamp_files(request.before, request.now, {request.noise_relative, request.regulation});
    if (!request.out.empty()) {
        OutputFolder folder(request.out);
        lamps->figures = lamp_figures(*lamps);
        std::error_code ignored; // a folder that cannot be made shows in the first file below it
        std::filesystem::create_directories(folder.path() / "figures", ignored);
        for (const ComparedFigure& figure : lamps->figures) {
            write_file(folder.path() / "figures" / (figure.name + ".svg"), figure.svg);
            write_file(folder.path() / "figures" / (figure.name + ".png"), plots::png_of_svg(figure.svg, 2.0));
        }
        write_file(folder.path() / "compare.json", lamps_json(*lamps));
        write_file(folder.path() / "compare.csv", lamps_csv(*lamps));
        write_file(folder.path() / "report.html", lamps_html(*lamps));
        folder.finish();
    }
    fmt::print("{}", request.json ? lamps_json(*lamps) : lamps_text(*lamps));
    if (!request.out.empty() && !request.json)
        fmt::print("\n{}\n", (request.out / "report.html").string());
    return lamps->passed() ? 0 : 1;
}

} // namespace fernlicht
