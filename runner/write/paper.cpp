#include "runner/write/paper.h"

#include "runner/files/durable_files.h"
#include "runner/files/output_folder.h"
#include "runner/write/document.h"
#include "runner/write/plots/svg.h"
#include "runner/write/plots/svg_module.h"
#include "scenarios/values/files.h"
#include "scenarios/values/program_module.h"

#include <fmt/format.h>

namespace fernlicht {

void write_paper(const std::vector<PaperFigure>& figures, const Document& tables, const std::filesystem::path& folder) {
    static const auto print = reinterpret_cast<plots::PrintSvg*>(module_function("fernlicht-svg", "fernlicht_print_svg"));
    constexpr double points_per_mm = 72.0 / 25.4;
    make_folder(folder);
    std::string tex = "% \\usepackage{graphicx}\n";
    FileNames names;
    for (const PaperFigure& figure : figures) {
        const std::string name = names.of(figure.name);
        const std::string svg = std::visit([](const auto& one) { return plots::svg_of(one); }, figure.figure);
        for (const bool as_pdf : {true, false}) {
            std::string printed;
            print(svg, points_per_mm * figure.width_mm, as_pdf, printed);
            write_file(folder / (name + (as_pdf ? ".pdf" : ".svg")), printed);
        }
        write_file(folder / (name + ".csv"), table_csv(figure.data));
        const char* const kind = figure.width_mm > one_column_mm ? "figure*" : "figure";
        tex +=
            fmt::format("\\begin{{{0}}}\n\\centering\n\\includegraphics[width={1:g}mm]{{{2}.pdf}}\n\\caption{{{3}}}\n\\label{{fig:{2}}}\n"
                        "\\end{{{0}}}\n",
                        kind, figure.width_mm, name, latex_text(figure.caption));
    }
    write_file(folder / "figures.tex", tex);
    write_file(folder / "tables.tex", document_latex(tables));
}

} // namespace fernlicht
