#include "scenarios/values/glob.h"

#include <cstddef>

namespace fernlicht {

bool matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0, t = 0, star = std::string_view::npos, taken = 0;
    while (t < text.size())
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            taken = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1; // the star takes one character more
            t = ++taken;
        } else
            return false;
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

} // namespace fernlicht
