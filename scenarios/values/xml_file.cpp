#include "scenarios/values/xml_file.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>

namespace fernlicht {
namespace {

constexpr double largest_number = 1e9;
constexpr std::size_t max_warnings = 1000;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// The element's name without its namespace prefix.
const char* local_name(const char* name) {
    const char* colon = std::find(name, name + std::char_traits<char>::length(name), ':');
    return *colon == ':' ? colon + 1 : name;
}

std::string in_lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// "is missing", and what of the node's attributes may be it, misspelt.
std::string missing(pugi::xml_node node, std::string_view attribute) {
    const std::size_t farthest = std::min<std::size_t>(2, attribute.size() / 3);
    for (const pugi::xml_attribute found : node.attributes())
        if (edit_distance(in_lower_case(found.name()), in_lower_case(std::string(attribute))) <= farthest)
            return fmt::format("is missing (found '{}')", printable(found.name()));
    return "is missing";
}

} // namespace

std::optional<double> to_number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+'))
        text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty())
        return {};
    if (error == std::errc::result_out_of_range) // too small is zero, too large is none
        return text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos ? std::optional(0.0) : std::nullopt;
    return error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

XmlFile::XmlFile(const std::filesystem::path& path, FilesRead& opened, std::string_view root, std::string_view format)
    : XmlFile(path, read_file(path, opened), root, format) {}

XmlFile::XmlFile(const std::filesystem::path& path, const std::string& bytes, std::string_view root, std::string_view format)
    : path_(path) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
        throw InputError({path, 0, 0, {}}, "is encoded in UTF-16", "UTF-8 or Latin-1");
    text_ = to_utf8(bytes);
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n')
            line_starts_.push_back(i + 1);
    parse(root, format);
    simplify();
}

void XmlFile::parse(std::string_view root, std::string_view format) {
    // The text was made UTF-8 above, whatever its XML declaration says.
    const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
        throw InputError({path_, line_at(std::max<std::ptrdiff_t>(result.offset, 0)), 0, {}},
                         fmt::format("is not well-formed XML: {}", result.description()), std::string(format));
    root_ = document_.document_element();
    if (!root_)
        throw InputError({path_, 1, 0, {}}, "holds no XML element", std::string(format));
    if (std::string_view(local_name(root_.name())) != root)
        throw InputError({path_, line(root_), 0, {}}, fmt::format("found root element '{}'", printable(root_.name())),
                         fmt::format("'{}'", root));
}

/// Walks the whole tree without recursion: bounds its depth and drops namespace prefixes.
void XmlFile::simplify() {
    int depth = 0;
    for (pugi::xml_node node = root_; node;) {
        if (const char* name = local_name(node.name()); name != node.name())
            node.set_name(std::string(name).c_str());
        if (node.first_child()) {
            if (++depth > max_depth)
                refuse(node, {}, "elements are nested too deeply", fmt::format("at most {} levels", max_depth));
            node = node.first_child();
            continue;
        }
        while (node && node != root_ && !node.next_sibling()) {
            node = node.parent();
            --depth;
        }
        node = node == root_ ? pugi::xml_node() : node.next_sibling();
    }
}

std::size_t XmlFile::line(pugi::xml_node node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return offset < 0 ? 0 : line_at(offset);
}

std::size_t XmlFile::line_at(std::ptrdiff_t offset) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(line_starts_, static_cast<std::size_t>(offset)) - line_starts_.begin());
}

void XmlFile::refuse(pugi::xml_node node, std::string_view attribute, const std::string& found, const std::string& expected) const {
    throw InputError({path_, line(node), 0, fmt::format("{}{}{}", node.name(), attribute.empty() ? "" : "@", attribute)}, found, expected);
}

void XmlFile::warn(pugi::xml_node node, const std::string& what) {
    if (warnings_.size() < max_warnings)
        warnings_.push_back(fmt::format("{}:{}: {}", path_.string(), line(node), what));
    else
        ++warnings_left_out_;
}

void XmlFile::warn_once(pugi::xml_node node, const std::string& kind, const std::string& what) {
    if (const auto known = kinds_.find(kind); known != kinds_.end()) {
        ++known->second.more;
        return;
    }
    if (warnings_.size() < max_warnings)
        kinds_[kind] = {warnings_.size(), 0};
    warn(node, what);
}

std::vector<std::string> XmlFile::take_warnings() {
    for (const auto& [kind, first] : kinds_)
        if (first.more > 0)
            warnings_[first.warning] += fmt::format(" (and {} more of this kind)", first.more);
    if (warnings_left_out_ > 0)
        warnings_.push_back(fmt::format("{}: {} further warnings are left out", path_.string(), warnings_left_out_));
    return std::move(warnings_);
}

double XmlFile::number(pugi::xml_node node, const char* attribute, std::optional<double> fallback) const {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) {
        if (fallback)
            return *fallback;
        refuse(node, attribute, missing(node, attribute), "a number");
    }
    const std::optional<double> value = to_number(found.value());
    if (!value || std::abs(*value) > largest_number)
        refuse(node, attribute, fmt::format("found '{}'", printable(found.value())),
               value ? fmt::format("a number between -{0} and {0}", largest_number) : "a number, without unit");
    return *value;
}

double XmlFile::length(pugi::xml_node node, const char* attribute, std::optional<double> fallback) const {
    const double value = number(node, attribute, fallback);
    if (value < 0.0)
        refuse(node, attribute, fmt::format("found {}", value), "a length, not below 0");
    return value;
}

int XmlFile::integer(pugi::xml_node node, const char* attribute, std::optional<int> fallback) const {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found && fallback)
        return *fallback;
    const double value = number(node, attribute);
    if (value != std::floor(value))
        refuse(node, attribute, fmt::format("found '{}'", printable(found.value())), "a whole number");
    return static_cast<int>(value);
}

std::string XmlFile::text(pugi::xml_node node, const char* attribute, const std::string& fallback) const {
    return node.attribute(attribute).as_string(fallback.c_str());
}

} // namespace fernlicht
