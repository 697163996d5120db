// Lines of standard input or a file as they come, however long they are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fernlicht {

class TextLines {
  public:
    static constexpr std::size_t longest_line = std::size_t{1} << 24;

    TextLines() = default; ///< of standard input
    /// False at the end, and after Ctrl-C. Throws InputError for what cannot be read or a line beyond `longest_line`.
    bool next();
    std::string_view text() const { return text_; } ///< without its end
    std::size_t number() const { return number_; }
    bool may_wait() const { return !at_end_ && buffer_.find('\n', begin_) == std::string::npos; } ///< next() may wait for more

  private:
    bool fill();

    std::string buffer_;
    std::string_view text_;
    std::size_t begin_ = 0, number_ = 0;
    bool at_end_ = false;
};

} // namespace fernlicht
