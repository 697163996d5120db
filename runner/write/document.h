// A document in the forms that people read.
#pragma once

#include "runner/findings/document.h"
#include "runner/findings/findings.h"
#include "runner/write/plots/png.h"
#include "scenarios/values/files.h"

#include <filesystem>

namespace fernlicht {

/// "of all share, %"
std::string head_of(const Column& column);
std::string plot_svg(const Plot& plot, int zlib = plots::drawing_zlib); ///< plots/svg.h
/// Where its files lie below the document's folder, without extension.
std::string place_of(const Plot& plot);
/// One self-contained page; plots stand in it as SVG, pictures are read below `folder`. It has a script only where something sorts or
/// slides.
void document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder, const TakePiece& take);
std::string document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder = {});
/// Columns as wide as their widest cell, two spaces apart; `alignment` has a character for each: '<' or '>'. Nothing trails. Lines end
/// with a newline.
std::string aligned_table(const std::string& alignment, const std::vector<std::vector<std::string>>& lines);
/// For a terminal: paragraphs, tables in columns (of prose: an entry for each row), captions of plots. Lines end with a newline.
std::string table_text(const Table& table);
std::string document_text(const Document& document);
/// A table in Markdown's pipes.
std::string table_markdown(const Table& table);
/// Title, tables, paragraphs and listings.
std::string document_markdown(const Document& document);
/// Its tables for LaTeX, as wide as the text; paragraphs and listings are comments.
std::string document_latex(const Document& document);
/// Words for LaTeX in UTF-8.
std::string latex_text(const std::string& words);
/// As LaTeX's `tabular` with the rules of booktabs, for \input; the caption is a comment above it.
std::string table_latex(const Table& table);
/// RFC 4180 with one line of heads. Figures are those that are shown, with a plain minus sign.
std::string table_csv(const Table& table);

struct OutputFormat; // formats.h
/// Each table as tables/NAME with the format's extension, those that a page folds away too. The format has to be one of tables.
void write_tables(const Document& document, const std::filesystem::path& folder, const OutputFormat& format);

/// As SVG, unless it is kept as PNG alone, and PNG. `place`: without extension.
void write_plot(const Plot& plot, const std::filesystem::path& place);

/// STEM.html, tables as asked for, and each plot as SVG and PNG, each as a whole or not at all. Figures for programs are the caller's, and
/// come first.
void write_document(const Document& document, const Findings& findings, const std::filesystem::path& folder, const std::string& stem,
                    const OutputFormat* tables = nullptr);

} // namespace fernlicht
