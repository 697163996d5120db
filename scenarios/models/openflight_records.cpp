#include "scenarios/models/openflight_records.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

// Codes and places in the header as the OpenFlight Scene Description Database Specification has them; numbers are big-endian.
constexpr std::size_t header = 1, push = 10, pop = 11, push_subface = 19, pop_subface = 20, push_extension = 21, pop_extension = 22,
                      push_attribute = 122, pop_attribute = 123;
constexpr std::size_t revision_at = 12, min_header = 128;
constexpr int deepest = 1000;

std::size_t number(const std::string& bytes, std::size_t at, std::size_t size) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

} // namespace

void check_openflight(const std::filesystem::path& path, const std::string& bytes) {
    const auto fail = [&](const std::string& found, const std::string& expected) { throw InputError({path, 0, 0, {}}, found, expected); };
    if (bytes.size() < min_header || number(bytes, 0, 2) != header || number(bytes, 2, 2) < min_header)
        fail("no OpenFlight header", "an OpenFlight file");
    if (const std::size_t revision = number(bytes, revision_at, 4); revision < 1400 || revision > 1700)
        fail(fmt::format("OpenFlight of revision {}", revision), "1400 to 1700");
    int depth = 0;
    for (std::size_t at = 0; at < bytes.size();) {
        if (bytes.size() - at < 4)
            fail(fmt::format("{} bytes after the last record", bytes.size() - at), "whole records");
        const std::size_t code = number(bytes, at, 2), length = number(bytes, at + 2, 2);
        if (length < 4 || length > bytes.size() - at)
            fail(fmt::format("a record (code {}) of {} bytes at byte {} of {}", code, length, at, bytes.size()),
                 "a record of 4 bytes or more that ends within the file");
        if (code == push || code == push_subface || code == push_extension || code == push_attribute)
            ++depth;
        if (code == pop || code == pop_subface || code == pop_extension || code == pop_attribute)
            --depth;
        if (depth < 0 || depth > deepest)
            fail(fmt::format("{} at byte {}",
                             depth < 0 ? "a level closed that was not opened" : fmt::format("more than {} levels", deepest), at),
                 "levels that are opened and closed");
        at += length;
    }
    if (depth != 0)
        fail(fmt::format("{} levels still open at the file's end", depth), "a whole file");
}

} // namespace fernlicht
