// The lines of a text grid, by its recipe: header, then lines of cells, and what a cell or a word of the header says.
#pragma once

#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/lamps/lamp_text.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Walks through the grid; the header is checked and skipped at once. Keeps views of `text`. Throws InputError.
class GridLines {
  public:
    GridLines(const std::filesystem::path& path, std::string_view text, const GridRecipe& recipe);

    /// The cells of the next line that is neither blank nor a comment; false at the grid's end.
    bool next(std::vector<std::string_view>& cells);
    std::size_t number() const { return lines_.number(); } ///< of the line that next() gave last
    InputError::Where where(std::string key = {}) const { return {path_, lines_.number(), 0, std::move(key)}; }

    /// A finite number with the recipe's decimal sign. `what` it is, for the refusal.
    double number_of(const std::vector<std::string_view>& cells, std::size_t at, std::string_view what) const;
    double number_of(std::string_view cell, const InputError::Where& where) const;
    /// A number of the recipe, or of the header. `name` is its key.
    double number_of(const HeaderNumber& number, const char* name) const;
    /// "; ..." where the numbers may have decimal commas that were taken for delimiters; else "".
    std::string doubt() const;
    std::string_view delimiter_name() const; ///< "semicolons"

  private:
    std::string_view header_word(int line, int word, const std::string& asked_by) const;
    void skip_header();
    void check_required() const;
    std::optional<double> number_in_cell(std::string_view cell) const;

    const std::filesystem::path& path_;
    const GridRecipe& recipe_;
    LineReader lines_;
    std::vector<std::string_view> head_; ///< the file's first lines
    bool saw_point_ = false;
};

} // namespace fernlicht
