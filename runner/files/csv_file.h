// CSV (RFC 4180) of our own writers, read back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Fields below the heads of the first line, without the apostrophe that csv_text() puts before formulas.
struct CsvFile {
    std::filesystem::path file;
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows; ///< a field for each head

    /// Each throws InputError with file, line and head: there is no such column; or the field is no text of that kind.
    std::size_t column(std::string_view head) const;
    double number(std::size_t row, std::size_t column) const;
    int count(std::size_t row, std::size_t column) const; ///< from 0
    [[noreturn]] void refuse(std::size_t row, std::size_t column, const std::string& expected) const;
};
/// Reads a file of at most 1 GiB. Throws InputError where a line has more or fewer fields than the first, or a quote does not end.
CsvFile read_csv(const std::filesystem::path& file);
/// The same of text that was read.
CsvFile csv_in(std::string_view text, const std::filesystem::path& file);

} // namespace fernlicht
