// What is UTF-8, what is UTF-16, and what is neither.
#pragma once

#include <cstddef>
#include <string>

namespace fernlicht {

/// Length of the UTF-8 sequence at `p`, of which `left` bytes may be read, at least 1; 0 when the bytes are none (overlong forms and
/// surrogates included).
std::size_t utf8_length(const unsigned char* p, std::size_t left);

/// By its byte order mark, or because every second byte of plain text is 0.
bool is_utf16(const std::string& bytes);

} // namespace fernlicht
