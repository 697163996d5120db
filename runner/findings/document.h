// What an experiment reports: sentences, tables, plots and pictures under headings. How they are printed is up to write/.
#pragma once

#include "metrics/statistics/work_precision.h"
#include "runner/findings/plots/figure.h"
#include "runner/findings/plots/sheets.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fernlicht {

/// Words, or a figure as it is read: rounded, without its unit.
struct Cell {
    std::string text;
    std::optional<double> value = {}; ///< what the figure was rounded from
    std::string link = {};            ///< where it leads: a file below the document's folder, "#c3" for a row of that name; "" nowhere
    std::string hint = {};            ///< seen on a page where one points at it
    std::optional<std::size_t> series = {}; ///< names what the series of this number shows in plots: stands beside its colour

    Cell(std::string words) : text(std::move(words)) {}
    Cell(const char* words) : text(words) {}
    Cell(std::string_view words) : text(words) {}
    Cell(std::string rounded, double of) : text(std::move(rounded)), value(of) {}

    static Cell of_series(std::string words, std::size_t number) {
        Cell cell(std::move(words));
        cell.series = number;
        return cell;
    }
    Cell linked(std::string to) && {
        link = std::move(to);
        return std::move(*this);
    }
    Cell hinted(std::string what) && {
        hint = std::move(what);
        return std::move(*this);
    }
};

struct Column {
    std::string head, unit = {};            ///< "%", "cm, r.m.s. / worst"
    std::string group = {};                 ///< a heading over this column and its neighbours of the same group
    bool words = false;                     ///< read from the left; figures stand to the right
    bool code = false;                      ///< words as they are typed: names of readings, commands
    std::optional<std::size_t> series = {}; ///< as a cell's
};

/// Of a line: "lamp<|all drawing: share [%]|command`". After what is read from the left stands a <, after what is typed a backtick, before
/// a colon the group, in brackets the unit.
std::vector<Column> columns_of(const std::string& line);

struct Table {
    std::string name, caption; ///< `name` tells tables of one document apart: "errors"
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< the first cell names the row; where cells are missing, the last one takes their place
    bool folded = false;                 ///< few look at it: opened on a page by who wants to
    bool off_terminal = false;           ///< a terminal does without: it is long, or what was printed before says the same
    bool sortable = false;               ///< its columns sort on a page; none has a group
    bool led_to = false;                 ///< links lead to its rows by their first cell
    std::vector<std::size_t> quiet = {}; ///< rows in grey
    bool prose = false; ///< cells are sentences as paragraphs are, and nothing where there is none: too wide for columns of a terminal
};

/// One figure of one thing in one place, and how it stands to what it is compared with.
struct MatrixEntry {
    Cell value;                ///< as a table's; where it leads is where the comparison stands
    std::string change = {};   ///< "+9.1", in its unit
    std::string share = {};    ///< "+21", in per cent
    std::string standing = {}; ///< "better", "worse", "changed", or in other words that it is none of these; "" where nothing is compared
    std::string open = {};     ///< "6.3": what the change is open to, in its unit, either way
    double shade = 0.0;        ///< from -1, much worse, to 1, much better
};

/// Things beside each other, a row for each place.
struct PlaceMatrix {
    std::string name, caption;      ///< as a table's
    std::string corner, unit;       ///< what the rows are; of all values
    std::string open_by = {};       ///< "aim": what opens changes
    std::vector<Cell> columns = {}; ///< names of the things
    std::vector<std::pair<Cell, std::vector<MatrixEntry>>> rows = {};
};
/// With a column for each thing's values, and one for its changes where there are any: for whatever draws no matrix.
Table table_of(const PlaceMatrix& matrix);

/// Sentences one below the other, without full stops.
struct Listing {
    std::vector<Cell> items;
    std::string caption = {}; ///< "" for none

    Listing() = default;
    Listing(std::vector<Cell> cells, std::string above = {}) : items(std::move(cells)), caption(std::move(above)) {}
    explicit Listing(const std::vector<std::string>& sentences) : items(sentences.begin(), sentences.end()) {}
};

/// One of the few figures that matter most, to be seen from afar.
struct Card {
    std::string what, figure, unit, beside, detail;
    Cell place;
};
using Cards = std::vector<Card>;

/// Two pictures of one thing, one over the other with a slider between them.
struct PictureOverlay {
    std::string title;
    std::array<std::string, 2> names, paths; ///< the one that lies over the other first; PNGs below the document's folder
};

/// Two in one plot, the second to the right.
using FiguresBeside = std::pair<plots::Figure, plots::Figure>;

struct Plot {
    std::string name; ///< of its files, without extension: "methods-kerb"; with a folder before it, "figures/reach", taken as it is
    std::variant<WorkPrecision, plots::Drawing, plots::Figure, FiguresBeside, Sheet, TileSheet> figure;
    std::vector<std::string> captions = {}; ///< one sentence each, without full stop
    double scale = 1.0;                     ///< pixels of its PNG for one of the SVG
    bool beside = false;                    ///< small enough that others stand beside it
    bool png_alone = false;                 ///< made of pixels: no SVG is kept
    std::vector<std::string> places = {};   ///< by which a page filters and sorts it among others of its section; none: it stays
    std::optional<double> rank = {};        ///< by which a page sorts it, largest first
};

/// Takes a plot that stands in no document, or that a document names by its files, to be written at once as NAME.png and .svg.
using TakePlot = std::function<void(const Plot&)>;

struct Picture {
    std::string file; ///< PNG, below the document's folder or absolute
    std::string caption;
};
/// Pictures on disk that belong beside each other.
struct PictureStrip {
    std::string title;
    std::vector<Picture> pictures;
};

/// A string is a paragraph; in it and in a listing, what stands between backticks is meant as it is typed.
using DocumentPart = std::variant<std::string, Table, PlaceMatrix, Plot, Listing, Cards, PictureOverlay, PictureStrip>;

struct Section {
    std::string title; ///< "" for what stands before the first heading
    std::vector<DocumentPart> blocks;
    int level = 2;              ///< of its heading; 3 and more: a part of the section before
    bool on_page_alone = false; ///< too long for a terminal
    std::string verdict = {};   ///< of what says how it went: "pass", "fail", "flaky", "not_measured", "none" where nothing was judged
    bool is_answer = false;     ///< what all was done for: large, and first on a page
    bool folded = false;        ///< opened on a page by who wants to
};

struct Document {
    std::string title;
    std::vector<Section> sections;
};

/// A diagram of error over run time as a section: the plot with what its marks mean, who is not in it, and the same as a table.
Section work_precision_section(const WorkPrecision& diagram);

} // namespace fernlicht
