// What an experiment tells of its findings: sentences, tables, plots and pictures under headings. How they are printed is write's affair.
#pragma once

#include "metrics/statistics/work_precision.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fernlicht {

/// Words, or a figure as it is read: rounded, without its unit.
struct Cell {
    std::string text;
    std::optional<double> value = {}; ///< what the figure was rounded from

    Cell(std::string words) : text(std::move(words)) {}
    Cell(const char* words) : text(words) {}
    Cell(std::string rounded, double of) : text(std::move(rounded)), value(of) {}
};

struct Column {
    std::string head, unit = {}; ///< "%", "cm, r.m.s. / worst"
    std::string group = {};      ///< a heading over this column and its neighbours of the same group
    bool words = false;          ///< read from the left; figures stand to the right
};

struct Table {
    std::string name, caption; ///< `name` tells tables of one document apart: "errors"
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< the first cell names the row; where cells are missing, the last one takes their place
    bool aside = false;                  ///< says in figures what a plot shows: folded away on a page, left out on a terminal
};

/// A picture in SVG that the experiment drew itself.
struct Drawing {
    std::string svg;
};

struct Plot {
    std::string name; ///< of its files, without extension: "methods-kerb"; with a folder before it, "figures/reach", taken as it is
    std::variant<WorkPrecision, Drawing> figure;
    std::vector<std::string> captions; ///< one sentence each, without full stop
    double scale = 1.0;                ///< pixels of its PNG for one of the SVG
};

struct Picture {
    std::string file; ///< PNG, below the document's folder or absolute
    std::string caption;
};

/// Pictures on disk that belong beside each other.
struct PictureStrip {
    std::string title;
    std::vector<Picture> pictures;
};

using DocumentPart = std::variant<std::string, Table, Plot, PictureStrip>; ///< a string is a paragraph

struct Section {
    std::string title; ///< "" for what stands before the first heading
    std::vector<DocumentPart> blocks;
    bool on_page_alone = false; ///< too long for a terminal
};

struct Document {
    std::string title;
    std::vector<Section> sections;
};

/// A diagram of error over run time as a section: the plot with what its marks mean, who is not in it, and the same as a table.
Section work_precision_section(const WorkPrecision& diagram);

} // namespace fernlicht
