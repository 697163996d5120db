#include "scenarios/values/files.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <regex>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <xxhash.h>

namespace fernlicht {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason(int error) { return std::generic_category().message(error); }

/// Windows-1252's printable bytes 0x80..0x9f as code points; 0 where it defines none.
constexpr std::uint16_t windows_1252[32] = {0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
                                            0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
                                            0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

void append_code_point(std::string& out, unsigned code) {
    if (code < 0x80) {
        out += static_cast<char>(code);
    } else if (code < 0x800) {
        out += static_cast<char>(0xc0 | code >> 6);
        out += static_cast<char>(0x80 | (code & 0x3f));
    } else {
        out += static_cast<char>(0xe0 | code >> 12);
        out += static_cast<char>(0x80 | (code >> 6 & 0x3f));
        out += static_cast<char>(0x80 | (code & 0x3f));
    }
}

/// All of it, read once: several readers may look at it.
const std::string& standard_input(std::size_t max_bytes) {
    static const std::string content = [&] {
        std::string all, piece(std::size_t{1} << 16, '\0');
        while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), stdin)) {
            all.append(piece, 0, got);
            if (all.size() > max_bytes)
                throw InputError({"-", 0, 0, {}}, fmt::format("has more than {} bytes", max_bytes), "at most so many");
        }
        if (std::ferror(stdin))
            throw InputError({"-", 0, 0, {}}, "cannot be read: " + reason(errno), "a readable file");
        return all;
    }();
    return content;
}

/// Bytes that are no text leave a terminal in disorder.
void print_all(const std::function<void(const TakePiece&)>& content) {
    content([](std::string_view piece) {
        if (::isatty(STDOUT_FILENO) == 1 && piece.find('\0') != std::string_view::npos)
            throw InputError({{}, 0, 0, "-"}, "found a terminal, and what is written is no text", "a file or a pipe");
        if (std::fwrite(piece.data(), 1, piece.size(), stdout) != piece.size())
            throw DeviceError("standard output: cannot be written: " + reason(errno));
    });
    if (std::fflush(stdout) != 0)
        throw DeviceError("standard output: cannot be written: " + reason(errno));
}

} // namespace

std::size_t utf8_length(const unsigned char* p, std::size_t left) {
    const auto continues = [&](std::size_t i) { return i < left && (p[i] & 0xc0) == 0x80; };
    if (p[0] < 0x80)
        return 1;
    if (p[0] >= 0xc2 && p[0] <= 0xdf && continues(1))
        return 2;
    if ((p[0] & 0xf0) == 0xe0 && continues(1) && continues(2)) {
        const unsigned code = (p[0] & 0x0fU) << 12 | (p[1] & 0x3fU) << 6;
        return code >= 0x800 && !(code >= 0xd800 && code <= 0xdfff) ? 3 : 0;
    }
    if (p[0] >= 0xf0 && p[0] <= 0xf4 && continues(1) && continues(2) && continues(3)) {
        const unsigned code = (p[0] & 0x07U) << 18 | (p[1] & 0x3fU) << 12;
        return code >= 0x10000 && code <= 0x10ffff ? 4 : 0;
    }
    return 0;
}

void refuse_windows_path(const std::filesystem::path& path, const InputError::Where& where) {
    static const std::regex drive_letter(R"((?:^|/)(([A-Za-z]):[\\/](.*)))");
    const std::string text = path.string();
    std::smatch part;
    std::error_code ignored;
    if (!std::regex_search(text, part, drive_letter) || std::filesystem::exists(path, ignored))
        return;
    std::string below = part[3];
    std::ranges::replace(below, '\\', '/');
    const auto letter = static_cast<char>(part[2].str()[0] | 0x20); // a small one
    throw InputError(where, "found '" + printable(part[1], 400) + "', a path of Windows",
                     fmt::format("one of Linux; WSL2 has this as /mnt/{}/{}", letter, printable(below, 400)));
}

std::string content_hash(const void* data, std::size_t bytes) {
    const XXH128_hash_t hash = XXH3_128bits(data, bytes);
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string read_file(const std::filesystem::path& path, FilesRead& opened, std::size_t max_bytes, bool may_be_empty) {
    if (path == "-") {
        const std::string& content = standard_input(max_bytes);
        if (content.empty() && !may_be_empty)
            throw InputError({path, 0, 0, {}}, "is empty", "content");
        opened.push_back({path, content.size(), content_hash(content.data(), content.size())});
        return content;
    }
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        const int error = errno;
        refuse_windows_path(path, {});
        throw InputError({path, 0, 0, {}}, "cannot be read: " + reason(error), "a file");
    }
    if (!S_ISREG(status.st_mode))
        throw InputError({path, 0, 0, {}}, S_ISDIR(status.st_mode) ? "is a folder" : "is not a regular file", "a file");
    if (static_cast<std::size_t>(status.st_size) > max_bytes)
        throw InputError({path, 0, 0, {}}, fmt::format("has {} bytes", status.st_size), fmt::format("at most {} bytes", max_bytes));
    const File file(std::fopen(path.c_str(), "rbe"));
    if (!file)
        throw InputError({path, 0, 0, {}}, "cannot be read: " + reason(errno), "a readable file");
    std::string content(static_cast<std::size_t>(status.st_size), '\0');
    content.resize(std::fread(content.data(), 1, content.size(), file.get()));
    if (std::ferror(file.get()))
        throw InputError({path, 0, 0, {}}, "cannot be read: " + reason(errno), "a readable file");
    if (content.empty() && !may_be_empty)
        throw InputError({path, 0, 0, {}}, "is empty", "content");
    opened.push_back({path, content.size(), content_hash(content.data(), content.size())});
    return content;
}

void write_file(const std::filesystem::path& path, const std::string& content) {
    write_file(path, [&](const TakePiece& take) { take(content); });
}

void write_file(const std::filesystem::path& path, const std::function<void(const TakePiece&)>& content) {
    if (path == "-")
        return print_all(content);
    const std::string part = path.string() + fmt::format(".part-{}", ::getpid());
    try {
        const auto fail = [&](int error) { throw DeviceError(path.string() + ": cannot be written: " + reason(error)); };
        File file(std::fopen(part.c_str(), "wbe"));
        if (!file)
            fail(errno);
        content([&](std::string_view piece) {
            if (std::fwrite(piece.data(), 1, piece.size(), file.get()) != piece.size())
                fail(errno);
        });
        if (std::fclose(file.release()) != 0 || ::rename(part.c_str(), path.c_str()) != 0)
            fail(errno);
    } catch (...) {
        ::unlink(part.c_str());
        throw;
    }
}

bool is_utf16(const std::string& bytes) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
        return true;
    const std::size_t looked_at = std::min<std::size_t>(bytes.size(), 64) / 2 * 2;
    std::size_t zeros[2] = {0, 0};
    for (std::size_t i = 0; i < looked_at; ++i)
        zeros[i % 2] += bytes[i] == '\0';
    return looked_at >= 8 && std::min(zeros[0], zeros[1]) == 0 && std::max(zeros[0], zeros[1]) * 4 > looked_at;
}

std::string to_utf8(const std::string& bytes) {
    std::string_view text = bytes;
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    const auto* p = reinterpret_cast<const unsigned char*>(text.data());
    bool valid = true;
    for (std::size_t i = 0; i < text.size() && valid;) {
        const std::size_t length = utf8_length(p + i, text.size() - i);
        valid = length > 0;
        i += length;
    }
    if (valid)
        return std::string(text);
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const unsigned code = byte >= 0x80 && byte < 0xa0 ? windows_1252[byte - 0x80] : byte;
        append_code_point(out, code == 0 ? 0xfffd : code);
    }
    return out;
}

} // namespace fernlicht
