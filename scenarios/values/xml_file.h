// A file as an XML tree whose every node knows its line: typed attributes, refusals, warnings.
#pragma once

#include "scenarios/values/files.h"

#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// One finite number, blanks round it allowed; nullopt for anything else.
std::optional<double> to_number(std::string_view text);

class XmlFile {
  public:
    /// Reads and parses. Namespace prefixes of elements are dropped. `format` for messages: "an OpenDRIVE file". Throws InputError:
    /// unreadable, not XML, nested deeper than `max_depth`, root element not `root`.
    XmlFile(const std::filesystem::path& path, FilesRead& opened, std::string_view root, std::string_view format);
    /// Of a content that has been read; `path` names it in messages.
    XmlFile(const std::filesystem::path& path, const std::string& bytes, std::string_view root, std::string_view format);

    const std::filesystem::path& path() const { return path_; }
    pugi::xml_node root() const { return root_; }
    std::size_t line(pugi::xml_node node) const;

    /// Ends the reading: what stands at `node` cannot be meant.
    [[noreturn]] void refuse(pugi::xml_node node, std::string_view attribute, const std::string& found,
                             const std::string& expected = {}) const;
    /// Notes what is odd at `node` and how it was taken. Only the first 1000 are kept.
    void warn(pugi::xml_node node, const std::string& what);
    /// As warn(), but of one `kind` only the first is kept, with the number of the others behind it.
    void warn_once(pugi::xml_node node, const std::string& kind, const std::string& what);
    std::vector<std::string> take_warnings();

    /// Finite and at most 1e9 in size; refuses anything else. Without a fallback the attribute must be there.
    double number(pugi::xml_node node, const char* attribute, std::optional<double> fallback = {}) const;
    /// As number(), and not below zero.
    double length(pugi::xml_node node, const char* attribute, std::optional<double> fallback = {}) const;
    int integer(pugi::xml_node node, const char* attribute, std::optional<int> fallback = {}) const;
    std::string text(pugi::xml_node node, const char* attribute, const std::string& fallback = {}) const;

    static constexpr int max_depth = 64;

  private:
    void parse(std::string_view root, std::string_view format);
    void simplify();
    std::size_t line_at(std::ptrdiff_t offset) const;

    std::filesystem::path path_;
    std::string text_;
    std::vector<std::size_t> line_starts_;
    pugi::xml_document document_;
    pugi::xml_node root_;
    std::vector<std::string> warnings_;
    std::size_t warnings_left_out_ = 0;
    struct Kind {
        std::size_t warning, more;
    };
    std::map<std::string, Kind> kinds_;
};

} // namespace fernlicht
