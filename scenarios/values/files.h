// Reading the user's files: whole, bounded, and with a record of what was read.
// What is UTF-8, what is UTF-16, and what is neither.
#pragma once

#include "scenarios/values/errors.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// A file that a reader opened; the report lists them so that a run can be repeated on the same bytes.
struct FileRead {
    std::filesystem::path path;
    std::size_t bytes = 0;
    std::string xxh128; ///< 32 hexadecimal digits of the content
};

using FilesRead = std::vector<FileRead>;

/// The whole content of `path`. Appends to `opened`.
/// Throws InputError: missing, unreadable, not a regular file, larger than `max_bytes`, empty (unless `may_be_empty`).
std::string read_file(const std::filesystem::path& path, FilesRead& opened, std::size_t max_bytes = std::size_t{256} << 20,
                      bool may_be_empty = false);

/// Throws InputError at `where` for a path that is not there and has a drive letter ("C:\lamps\low.ies"), also as part of one that was
/// taken for relative; says under which name WSL2 has it.
void refuse_windows_path(const std::filesystem::path& path, const InputError::Where& where);

/// 32 hexadecimal digits of xxHash's 128-bit hash.
std::string content_hash(const void* data, std::size_t bytes);

/// Writes `content` beside `path` and renames it into place: readers see the old file or the new one, never half of one.
/// Throws DeviceError with the path and the system's reason (full disk, read-only folder ...).
void write_file(const std::filesystem::path& path, const std::string& content);
/// The same of a content that comes in pieces, so that it need not be in memory as a whole. What `content` throws leaves nothing behind.
using TakePiece = std::function<void(std::string_view)>;
void write_file(const std::filesystem::path& path, const std::function<void(const TakePiece&)>& content);

/// UTF-8 as it is (without byte order mark); anything else is taken as Windows-1252 and converted.
std::string to_utf8(const std::string& bytes);

/// Length of the UTF-8 sequence at `p`, of which `left` bytes may be read, at least 1; 0 when the bytes are none (overlong forms and
/// surrogates included).
std::size_t utf8_length(const unsigned char* p, std::size_t left);

/// By its byte order mark, or because every second byte of plain text is 0.
bool is_utf16(const std::string& bytes);

} // namespace fernlicht
