// What a struct of a file is: one description of its keys, from which it is read, written, checked by editors and documented.
// Descriptions are made with field.h; this header has no templates and is all that the visitors need.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

class YamlEntry;
class YamlMap;
struct Group;

/// What a member's type can do; nullptr: what most do, which is nothing.
struct MemberType {
    void* (*look)(void* member) = nullptr; ///< nullptr: absent
    void* (*make)(void* member) = nullptr;
    void (*clear)(void* member) = nullptr;
    std::size_t (*size)(void* member) = nullptr;
    void* (*element)(void* member, std::size_t i) = nullptr;
    void* (*append)(void* member) = nullptr;
    std::string* (*name_of)(void* element) = nullptr;
};

/// Where in its struct a field's value lies. Optional values may be absent, lists have elements.
struct Member {
    std::ptrdiff_t offset = 0;
    const MemberType* type = nullptr;

    void* look(void* whole) const { return type->look ? type->look(at(whole)) : at(whole); } ///< nullptr: absent
    /// The value; a new one, at its defaults, where it is optional.
    void* make(void* whole) const { return type->make ? type->make(at(whole)) : at(whole); }
    /// Absent, or a list without elements.
    void clear(void* whole) const {
        if (type->clear)
            type->clear(at(whole));
    }
    std::size_t size(void* whole) const { return type->size(at(whole)); }
    void* element(void* whole, std::size_t i) const { return type->element(at(whole), i); }
    void* append(void* whole) const { return type->append(at(whole)); }
    /// Of an element, in lists that are written as a map of names.
    std::string* name_of(void* element) const { return type->name_of(element); }

  private:
    void* at(void* whole) const { return static_cast<char*>(whole) + offset; }
};

enum class FieldKind {
    number,   ///< double
    whole,    ///< int
    flag,     ///< bool
    text,     ///< std::string, not empty
    name,     ///< std::string that may be part of a file's name
    path,     ///< std::filesystem::path; whether it exists is not asked
    names,    ///< std::vector<std::string>, of lamps
    texts,    ///< std::vector<std::string>, each not empty
    choice,   ///< an enum, by words in the order of its enumerators
    numbers,  ///< std::vector<double>
    position, ///< [x, y, z]
    group,    ///< a struct with a description of its own
    inlined,  ///< the same, its keys among those of the struct that has it
    named,    ///< structs by names that the user chooses
    list,     ///< structs one after the other
    own       ///< read and written by functions of its own
};

/// One of the units that a number may be given in, and how that becomes the struct's.
struct FieldUnit {
    std::string key;
    double (*stored)(double);
    double least, greatest;
};

/// What a value may be.
struct FieldRule {
    FieldRule(double least_value = 0.0, double greatest_value = 0.0, std::size_t fewest_elements = 0, std::size_t most_elements = 0,
              std::vector<std::string_view> in_order = {});
    FieldRule(const FieldRule&);
    FieldRule(FieldRule&&) noexcept;
    FieldRule& operator=(const FieldRule&);
    ~FieldRule();

    double least, greatest;
    std::size_t fewest, most; ///< elements of lists and maps
    std::vector<std::string_view> words;
    std::string_view refused_as = {};   ///< what is said to be expected where `greatest` itself is not allowed
    std::vector<FieldUnit> units = {};  ///< two keys for one number; the second is the struct's own unit
    bool degrees_where_exact = false;   ///< written in the first unit where that brings the number back
    bool is_above = false;              ///< `least` itself is not allowed
    std::optional<FieldKind> kind = {}; ///< where the member's type leaves it open
};

struct Field {
    // Out of line: hundreds of fields are made where structs are described.
    Field(std::string_view its_key, int its_id, FieldKind its_kind, Member its_member, std::string_view its_meaning);
    Field(const Field&);
    Field(Field&&) noexcept;
    Field& operator=(const Field&);
    ~Field();

    std::string key; ///< of numbers with units: without one
    int id;          ///< names the field for good, among those of its struct: keys may be renamed, ids are never used twice
    FieldKind kind;
    Member member;
    FieldRule rule;
    std::string_view meaning;
    std::shared_ptr<const Group> group; ///< of its own, or one that stands for several

    bool is_form = false; ///< never written: another way to give what other fields hold; without an id
    bool is_required = false;
    bool is_written_off_default = false;        ///< only where the value is not the default
    bool may_be_flag = false;                   ///< true: there, with defaults; false: absent
    std::vector<std::string_view> default_word; ///< a word that stands for the defaults
    std::string_view absent_word = {};          ///< what is written where it is absent; "": nothing
    std::string_view short_key = {};            ///< the field of the group that a scalar in its place gives,
    bool short_is_list = false;                 ///< or that a list in its place gives
    bool (*heard)(const void* whole) = nullptr; ///< nullptr: always; else a key that is given unheard is refused

    // kind own has no more than these; of other kinds each takes the place of what follows from the rest
    std::function<void(const YamlEntry&, void* whole)> read = {};
    std::function<std::string(const void* whole)> text = {}; ///< on one line, or lines that each begin with their end; "": not written
    std::string schema = {};                                 ///< JSON
    std::function<std::string(const void* whole)> bits = {}; ///< what hashes are taken over in place of `text` (field_bits.h)
};

/// A struct's fields, in the order in which they are written.
struct Group {
    std::vector<Field> fields;
    std::shared_ptr<const void> usual; ///< a struct at its defaults
    bool is_block = false;             ///< written one key a line
    bool is_bare = false;              ///< of one field, whose value stands for the whole
    std::function<void(const YamlMap&, const void* whole)> check = {};
    std::string schema_beside = {};   ///< JSON: what is required of the keys together
    std::string_view definition = {}; ///< of groups that stand in several places: schema and reference have them once, by this name
};

const Field& field_named(const Group& group, std::string_view key); ///< may be of an inlined group; throws std::logic_error for none
/// Keys by which a field may be given, with those of inlined groups.
std::vector<std::string_view> keys_of(const Field& field);
std::vector<std::string_view> keys_of(const Group& group);
/// The unit that ends a key's name, as one writes it: "m", "cd/m\u00b2"; "" for numbers without.
std::string_view unit_of(std::string_view key);

} // namespace fernlicht
