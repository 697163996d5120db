// A place in the text of a DBC file, and the words, numbers and texts that stand there.
#pragma once

#include "scenarios/values/errors.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fernlicht {

/// Blanks, line ends and // comments between two words are skipped. What is not there as asked for throws InputError with the line.
class DbcCursor {
  public:
    /// `text` in UTF-8 with '\n' as line end; it must outlive the cursor.
    DbcCursor(const std::string& text, std::filesystem::path file) : text_(text), file_(std::move(file)) {}

    bool at_end();
    std::size_t line() const { return line_; } ///< of what was taken last, or of what comes next after a call that looks ahead
    bool line_goes_on();                       ///< something other than a comment stands before the end of this line
    bool has(char c);                          ///< the next character
    bool take(char c);                         ///< takes it if it is next
    void expect(char c, const char* where);
    std::string_view peek();            ///< the next word, not taken; "" where none is
    std::string word(const char* what); ///< up to a blank or one of : ; , | @ ( ) [ ] "
    bool has_text();                    ///< a quoted text is next
    std::string text(const char* what); ///< between quotes, over line ends; \" is a quote within
    bool has_number();                  ///< a digit, sign or point is next
    double number(const char* what);    ///< "1.#IND" and its like are not a number
    std::string number_as_written(const char* what);
    std::uint64_t whole(const char* what, std::uint64_t greatest); ///< without sign
    void skip_past(char c);                                        ///< texts on the way are taken whole
    [[noreturn]] void refuse(const std::string& expected);         ///< says what stands there instead
    [[noreturn]] void refuse_at(std::size_t line, const std::string& found, const std::string& expected) const;

  private:
    void skip();
    void advance_to(std::size_t end);
    std::string_view number_text();

    const std::string& text_;
    std::filesystem::path file_;
    std::size_t at_ = 0, line_ = 1, taken_line_ = 0;
};

} // namespace fernlicht
