#include "runner/write/document.h"

#include "runner/files/durable_files.h"
#include "runner/files/output_folder.h"
#include "runner/write/formats.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"
#include "scenarios/values/files.h"

#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {

std::string head_of(const Column& column) {
    const std::string head = column.group.empty() ? column.head : column.group + " " + column.head;
    return column.unit.empty() ? head : head + ", " + column.unit;
}

std::string plot_svg(const Plot& plot, int zlib) {
    return std::visit([zlib](const auto& figure) { return plots::svg_of(figure, zlib); }, plot.figure);
}

std::string place_of(const Plot& plot) { return plot.name.find('/') == std::string::npos ? file_name_of(plot.name) : plot.name; }

void write_tables(const Document& document, const std::filesystem::path& folder, const OutputFormat& format) {
    make_folder(folder / "tables");
    FileNames names;
    const auto write = [&](const Table& table) {
        write_file(folder / "tables" / (names.of(table.name) + format.extension), format.of_table(table));
    };
    for (const Section& section : document.sections)
        for (const DocumentPart& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block))
                write(*table);
            else if (const auto* matrix = std::get_if<PlaceMatrix>(&block))
                write(table_of(*matrix));
}

void write_plot(const Plot& plot, const std::filesystem::path& place) {
    std::error_code ignored; // a folder that cannot be made shows in the first file below it
    std::filesystem::create_directories(place.parent_path(), ignored);
    const std::string svg = plot_svg(plot, plot.png_alone ? 0 : plots::drawing_zlib);
    if (!plot.png_alone)
        write_file(place.string() + ".svg", svg);
    write_file(place.string() + ".png", plots::png_of_svg(svg, plot.scale));
}

void write_document(const Document& document, const Findings& findings, const std::filesystem::path& folder, const std::string& stem,
                    const OutputFormat* tables) {
    std::vector<const Plot*> plots;
    for (const Section& section : document.sections)
        for (const DocumentPart& block : section.blocks)
            if (const auto* plot = std::get_if<Plot>(&block))
                plots.push_back(plot);
    oneapi::tbb::parallel_for(std::size_t{0}, plots.size(), [&](std::size_t i) { write_plot(*plots[i], folder / place_of(*plots[i])); });
    if (tables)
        write_tables(document, folder, *tables);
    write_file(folder / (stem + ".html"), [&](const TakePiece& take) { document_html(document, findings, folder, take); });
}

} // namespace fernlicht
