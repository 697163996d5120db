// What the text readers of lamp files share: lines, words and cells, and numbers with their checks.
#pragma once

#include "scenarios/values/errors.h"
#include "scenarios/values/refusals.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

inline constexpr std::size_t max_lamp_text_bytes = std::size_t{128} << 20;
inline constexpr std::size_t max_lamp_samples = std::size_t{4096} * 4096; ///< in a file
inline constexpr std::size_t max_made_samples = 4'000'000;                ///< of what is sampled anew, and of pictures
inline constexpr std::size_t max_lamp_labels = 10'000;
/// Brighter than any lamp by far; keeps products of header factors finite.
inline constexpr double max_intensity_cd = 1e12;

/// Walks through text line by line; a line ends with LF, CR LF or CR alone. Holds views only.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : rest_(text) {}
    bool next(std::string_view& line);
    std::size_t number() const { return number_; } ///< 1-based number of the line that next() gave last
    std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// A file's bytes as UTF-8. Throws InputError for UTF-16, with a byte order mark or without.
std::string lamp_text(const std::string& bytes, const std::filesystem::path& path);

std::string_view trimmed(std::string_view text);
/// What blanks, or other `separators`, part; none is empty.
std::vector<std::string_view> words_of(std::string_view line, std::string_view separators = {" \t\v\f\0", 5});
/// What `separator` parts, a blank any run of blanks and tabs, without blanks and quotation marks round it. A separator that ends the line
/// begins no cell.
std::vector<std::string_view> cells_of(std::string_view line, char separator);
std::string uppercase(std::string_view text);
/// Control characters, which would end the line, as blanks.
std::string on_one_line(std::string text);

/// The whole of `text`, blanks around it apart, as a decimal number: no hexadecimal, a leading plus is fine; "nan" and "inf" are numbers
/// here.
std::optional<double> number_in(std::string_view text);

/// Throws InputError unless `text` is a finite number; one with a decimal comma is called that.
double finite_number(std::string_view text, const InputError::Where& where);
double number_above_zero(std::string_view text, const InputError::Where& where);
/// Throws InputError unless `text` is a whole number within the bounds.
long whole_number(std::string_view text, long least, long most, const InputError::Where& where);

/// Reads one intensity of a table. Where somebody listens (refusals.h), a refusal is noted and 0 returned, so that all of a table are
/// reported, a hundred at most; who listens asks refusals_met() before using the table.
template <class Read> double intensity_of(Read read) {
    try {
        return read();
    } catch (const InputError& error) {
        if (refusals_met() >= 100)
            throw;
        refuse_and_go_on(error);
        return 0.0;
    }
}

/// Throws InputError naming the first of them when the numbers in `text`, separated by blanks, have decimal commas. `lines_before`: where
/// in the file it begins.
void refuse_decimal_commas(std::string_view text, std::size_t lines_before, const std::filesystem::path& path);
/// The same of a table with a number too many: one decimal comma among points makes one.
void refuse_lone_commas(std::string_view text, std::size_t lines_before, const std::filesystem::path& path);

} // namespace fernlicht
