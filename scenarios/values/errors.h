// The two errors that cross module borders. Everything else is a bug (exit code 4).
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fernlicht {

/// What the user gave cannot be used. Exit code 2.
/// what() is one sentence: `file:line:column: key: found ..., expected ...`; the parts that are unknown are left out.
class InputError : public std::runtime_error {
  public:
    struct Where {
        std::filesystem::path file;
        std::size_t line = 0;   ///< 1-based; 0 = unknown
        std::size_t column = 0; ///< 1-based; 0 = unknown
        std::string key;        ///< YAML key path, XML element, IES keyword ...
    };
    /// `found` and `expected` are fragments without a full stop: "found 'abc', expected a number above 0".
    InputError(Where where, const std::string& found, const std::string& expected = {});
    const Where& where() const { return where_; }

  private:
    Where where_;
};

/// The machine cannot do what was asked: no GL context, a failed sanity check, a full disk. Exit code 3.
class DeviceError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Text of others on its way to a terminal or a message: control characters escaped, cut to `max_chars`.
std::string printable(const std::string& text, std::size_t max_chars = 60);

/// The candidate nearest to `word` by edit distance, or "" when none is near enough to be meant.
template <class Names> std::string nearest_name(const std::string& word, const Names& candidates);
std::size_t edit_distance(std::string_view a, std::string_view b);

template <class Names> std::string nearest_name(const std::string& word, const Names& candidates) {
    std::string best;
    std::size_t best_distance = word.size() / 2 + 1;
    for (const auto& candidate : candidates) {
        const std::string_view name = candidate;
        if (word.size() >= 4 && name.starts_with(word) && name.size() <= word.size() + 3) // cut off: `reach_..._own` for `reach_..._own_m`
            return std::string(name);
        if (const std::size_t d = edit_distance(word, name); d < best_distance) {
            best_distance = d;
            best = name;
        }
    }
    return best;
}

} // namespace fernlicht
