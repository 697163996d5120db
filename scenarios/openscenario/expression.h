// Expressions of OpenSCENARIO: arithmetic and logic over numbers, texts and parameters, as they stand in ${...}.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace fernlicht::osc {

/// Text of a parameter by its name without `$`; nullopt: there is none.
using Lookup = std::function<std::optional<std::string>(const std::string& name)>;

/// A value of the text with its parameters put in: `$name` and `${expression}`, alone or inside other text. Numbers that an expression
/// gives are written with the digits that bring them back. OpenSCENARIO XML 1.3, 6.12: + - * / %, brackets, comparisons, and, or, not, pow,
/// sqrt, abs, sign, round, floor, ceil, min, max, sin, cos, tan, asin, acos, atan. A result is at most 64 KiB long. Throws
/// std::invalid_argument with a fragment of what is wrong: "unknown parameter 'a'", "found '/', expected a number".
std::string resolve(std::string_view text, const Lookup& lookup);

} // namespace fernlicht::osc
