// An element of an OpenSCENARIO file with the parameters that hold there: typed attributes, refusals, and what is not supported.
#pragma once

#include "scenarios/openscenario/storyboard.h"
#include "scenarios/values/xml_file.h"

namespace fernlicht::osc {

/// Names and values, inner ones before outer ones.
struct Scope {
    std::map<std::string, std::string> values;
    std::shared_ptr<const Scope> outer;

    std::optional<std::string> find(const std::string& name) const;
};

/// A value of the text with its parameters put in: `$name` and `${expression}`, alone or inside other text. Numbers that an expression
/// gives are written with the digits that bring them back. OpenSCENARIO XML 1.3, 6.12: + - * / %, brackets, comparisons, and, or, not, pow,
/// sqrt, abs, sign, round, floor, ceil, min, max, sin, cos, tan, asin, acos, atan. A result is at most 64 KiB long. Throws
/// std::invalid_argument with a fragment of what is wrong: "unknown parameter 'a'", "found '/', expected a number".
std::string resolve(std::string_view text, const Scope& scope);

/// What all nodes of one reading share.
struct Reading {
    struct Unsupported {
        std::filesystem::path file;
        std::size_t line;
        std::string element, what;
    };
    std::vector<Unsupported> unsupported;
    std::vector<std::string> notes;
    FilesRead opened;
    std::vector<std::shared_ptr<XmlFile>> files; ///< nodes point into them
    /// Catalogs: folders not read yet, and the entries known by the names of catalog and entry.
    struct Entry {
        XmlFile* file;
        pugi::xml_node node;
    };
    std::vector<std::filesystem::path> catalog_folders;
    std::map<std::pair<std::string, std::string>, Entry> entries;
    std::vector<std::string> catalog_notes; ///< files that could not be read
    /// Entries that are being read, the outer ones first: one that asks for itself would never end.
    std::vector<Entry> open_entries;
    std::size_t inner_entries = 0;     ///< read so far within others
    std::size_t parameter_bytes = 0;   ///< of parameters' values, and of texts that they were put in
    std::vector<std::string> entities; ///< names that may be referred to
    std::shared_ptr<const Scope> global = std::make_shared<Scope>();
};

class OscNode {
  public:
    OscNode(XmlFile& file, pugi::xml_node node, std::shared_ptr<const Scope> scope, Reading& reading)
        : file_(&file), node_(node), scope_(std::move(scope)), reading_(&reading) {}

    std::string element() const { return node_.name(); }
    std::size_t line() const { return file_->line(node_); }
    const std::filesystem::path& file() const { return file_->path(); }
    Reading& reading() const { return *reading_; }
    const std::shared_ptr<const Scope>& scope() const { return scope_; }
    OscNode with(std::shared_ptr<const Scope> scope) const { return {*file_, node_, std::move(scope), *reading_}; }
    /// The same element with its own ParameterDeclarations in scope.
    OscNode with_declared() const;

    [[noreturn]] void refuse(const std::string& attribute, const std::string& found, const std::string& expected = {}) const;
    /// To be refused before the run, or left out with --lenient.
    void unsupported(const std::string& what) const;
    void note(const std::string& what) const;

    bool has(const char* attribute) const { return static_cast<bool>(node_.attribute(attribute)); }
    /// Parameters put in.
    std::string text(const char* attribute) const;
    std::string text_or(const char* attribute, const std::string& otherwise) const;
    /// Of an element: text that no reference hangs on; what cannot be resolved stays as it is.
    std::string name() const;
    /// Name of an entity of the scenario; refuses others, naming the nearest.
    std::string entity(const char* attribute) const;
    double number(const char* attribute) const;
    double number_or(const char* attribute, double otherwise) const;
    std::optional<double> number_if(const char* attribute) const;
    /// Lengths within 1e9 m and angles within 1e6 rad, as no scenario needs greater ones; 0 where missing, but for length(). Refuse others.
    double length(const char* attribute) const;
    double length_or_0(const char* attribute) const;
    double angle_or_0(const char* attribute) const;
    /// Refuses what is below 0; `expected` "a distance not below 0".
    std::optional<double> not_below_0_if(const char* attribute, const char* expected) const;
    int whole(const char* attribute) const;
    bool flag_or(const char* attribute, bool otherwise) const;
    /// Index among `choices`; refuses others.
    std::size_t choice(const char* attribute, std::initializer_list<std::string_view> choices) const;
    /// Text between the tags, parameters put in.
    std::string content() const;

    std::optional<OscNode> find(const char* element) const;
    OscNode require(const char* element) const;
    std::vector<OscNode> children(const char* element) const;
    std::vector<OscNode> children() const;
    /// The one child element; refuses none. `what` is expected.
    OscNode only(const std::string& what) const;

    std::map<std::string, std::string> declared() const; ///< of its ParameterDeclarations
    /// Of a parameter's value, or of a text that parameters were put in. Refuses at `attribute` what is too much in all.
    void count_bytes(const char* attribute, std::size_t bytes) const;
    pugi::xml_node node() const { return node_; }
    XmlFile& xml() const { return *file_; }

  private:
    std::string resolved(const char* attribute, const char* written) const;
    std::optional<std::string> if_given(const char* attribute) const;

    XmlFile* file_;
    pugi::xml_node node_;
    std::shared_ptr<const Scope> scope_;
    Reading* reading_;
};

/// Takes the folders that the scenario's CatalogLocations names. They are read when an entry is first asked for.
void note_catalog_folders(const OscNode& scenario);

/// The entry that a CatalogReference names, with its parameters as assigned there. Throws InputError at the reference: no such catalog, no
/// such entry (naming the nearest), a parameter that the entry does not declare.
OscNode catalog_entry(const OscNode& reference);

/// `element` as a child of `node`, or what the CatalogReference there names.
std::optional<OscNode> own_or_catalog(const OscNode& node, const char* element);

/// While it lives, the Route or Trajectory `node` is being read. The constructor refuses one that is being read already, with the names
/// that lead back to it.
class OpenEntry {
  public:
    explicit OpenEntry(const OscNode& node);
    ~OpenEntry() { reading_.open_entries.pop_back(); }
    OpenEntry(const OpenEntry&) = delete;
    OpenEntry& operator=(const OpenEntry&) = delete;

  private:
    Reading& reading_;
};

} // namespace fernlicht::osc
