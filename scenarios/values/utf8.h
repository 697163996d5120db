// What is UTF-8 and what is not.
#pragma once

#include <cstddef>

namespace fernlicht {

/// Length of the UTF-8 sequence at `p`, of which `left` bytes may be read, at least 1; 0 when the bytes are none (overlong forms and
/// surrogates included).
std::size_t utf8_length(const unsigned char* p, std::size_t left);

} // namespace fernlicht
