#include "runner/files/clean_text.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr char32_t replacement = 0xfffd;

/// The code point at the front of `text` and its length, or nullopt for bytes that are none (overlong forms and surrogates included).
struct Decoded {
    char32_t code;
    std::size_t length;
};

std::optional<Decoded> decode(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t first = byte(0);
    if (first < 0x80)
        return Decoded{first, 1};
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length)
        return std::nullopt;
    std::uint32_t code = first & (0x7fU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80)
            return std::nullopt;
        code = code << 6 | (byte(i) & 0x3f);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    if (code < least[length] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff))
        return std::nullopt;
    return Decoded{code, length};
}

bool turns_direction(char32_t code) {
    return code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

char32_t visible(char32_t code) {
    if (code < 0x20)
        return 0x2400 + code;
    if (code == 0x7f)
        return 0x2421;
    if ((code >= 0x80 && code < 0xa0) || code == 0xfffe || code == 0xffff || turns_direction(code))
        return replacement;
    return code;
}

void append(std::string& out, char32_t code) {
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xc0 | code >> 6);
        put(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        put(0xe0 | code >> 12);
        put(0x80 | (code >> 6 & 0x3f));
        put(0x80 | (code & 0x3f));
    } else {
        put(0xf0 | code >> 18);
        put(0x80 | (code >> 12 & 0x3f));
        put(0x80 | (code >> 6 & 0x3f));
        put(0x80 | (code & 0x3f));
    }
}

std::vector<char32_t> clean_code_points(std::string_view bytes) {
    std::vector<char32_t> codes;
    codes.reserve(bytes.size());
    while (!bytes.empty()) {
        const std::optional<Decoded> next = decode(bytes);
        codes.push_back(next ? visible(next->code) : replacement);
        bytes.remove_prefix(next ? next->length : 1);
    }
    return codes;
}

std::string encoded(const std::vector<char32_t>& codes) {
    std::string out;
    out.reserve(codes.size());
    for (const char32_t code : codes)
        append(out, code);
    return out;
}

} // namespace

std::string clean_text(std::string_view bytes) { return encoded(clean_code_points(bytes)); }

std::string capitalised(std::string text) {
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text;
}

std::string short_text(std::string_view bytes, std::size_t max_characters) {
    std::vector<char32_t> codes = clean_code_points(bytes);
    if (codes.size() > max_characters) {
        // The end of a path tells more than its beginning.
        const std::size_t head = (max_characters - 1) / 3, tail = max_characters - 1 - head;
        codes.erase(codes.begin() + static_cast<std::ptrdiff_t>(head), codes.end() - static_cast<std::ptrdiff_t>(tail));
        codes.insert(codes.begin() + static_cast<std::ptrdiff_t>(head), U'\u2026');
    }
    return encoded(codes);
}

std::string xml_text(std::string_view bytes) {
    std::string out;
    for (const char c : clean_text(bytes)) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        case '\'':
            out += "&#39;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

std::string csv_text(std::string_view bytes) {
    std::string text = clean_text(bytes);
    // Tab and carriage return, which also start formulas, are pictures by now.
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc{} && end == text.data() + text.size();
    if (!is_number && !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos)
        text.insert(0, 1, '\'');
    if (text.find_first_of(",\"") == std::string::npos)
        return text;
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
}

std::string csv_number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string relative_link(std::string_view path) {
    static constexpr char hex[] = "0123456789ABCDEF";
    constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    std::string out = "./";
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (plain.find(c) != std::string_view::npos)
            out += c;
        else
            out += {'%', hex[byte >> 4], hex[byte & 15]};
    }
    return out;
}

} // namespace fernlicht
