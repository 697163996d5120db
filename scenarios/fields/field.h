// Describes the struct of a file, one line a key:
//
//   const Fields<Windscreen>& windscreen_fields() {
//       static const Fields<Windscreen> fields{
//           field("transmittance", 1, &Windscreen::transmittance, range(0.01, 1.0), "of light; UN R43 asks for 0.7 at least"),
//           field("haze", 2, &Windscreen::haze, range(0.0, 0.3), "share turned by more than 2.5 degrees"),
//       };
//       return fields;
//   }
//
// What a member's type does not say (a default word, a key that only some methods use) is chained to the field. The templates here
// become plain values at once (group.h), and only files that describe structs include them.
#pragma once

#include "scenarios/fields/group.h"

#include <bit>
#include <concepts>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace fernlicht {

template <class Struct> struct Fields;

/// A description is pointed to where it has a name, and else kept.
template <class F> std::shared_ptr<const Group> shared_group(F&& fields) {
    if constexpr (std::is_lvalue_reference_v<F>)
        return {std::shared_ptr<void>(), &fields};
    else
        return std::make_shared<const Group>(std::forward<F>(fields));
}
template <class F>
concept Description = std::derived_from<std::remove_cvref_t<F>, Group>;

template <class Struct> struct FieldOf : Field {
    using Field::Field;
    FieldOf required() && { return is_required = true, std::move(*this); }
    FieldOf written_off_default() && { return is_written_off_default = true, std::move(*this); }
    FieldOf or_flag() && { return may_be_flag = true, std::move(*this); }
    FieldOf or_word(std::string_view word) && { return default_word = {word}, std::move(*this); }
    FieldOf or_absent(std::string_view word) && { return absent_word = word, std::move(*this); }
    FieldOf short_for(std::string_view key_of_group) && { return short_key = key_of_group, std::move(*this); }
    FieldOf short_list_for(std::string_view key_of_group) && { return short_key = key_of_group, short_is_list = true, std::move(*this); }
    template <class Inner> FieldOf of(Inner&& fields) && { return group = shared_group(std::forward<Inner>(fields)), std::move(*this); }
    FieldOf heard_if(bool (*asks)(const void*)) && { return heard = asks, std::move(*this); }
    FieldOf read_by(void (*reads)(const YamlEntry&, Struct&)) && {
        read = [reads](const YamlEntry& entry, void* whole) { reads(entry, *static_cast<Struct*>(whole)); };
        return std::move(*this);
    }
    FieldOf text_by(std::string (*writes)(const Struct&)) && {
        text = [writes](const void* whole) { return writes(*static_cast<const Struct*>(whole)); };
        return std::move(*this);
    }
    FieldOf bits_by(std::string (*tells)(const Struct&)) && {
        bits = [tells](const void* whole) { return tells(*static_cast<const Struct*>(whole)); };
        return std::move(*this);
    }
    FieldOf schema_by(std::string_view json) && { return schema = json, std::move(*this); }
};

/// The description of a struct.
template <class Struct> struct Fields : Group {
    using Described = Struct;
    Fields(std::initializer_list<FieldOf<Struct>> list) {
        fields.assign(list.begin(), list.end());
        usual = std::make_shared<const Struct>();
    }
    Fields block() && { return is_block = true, std::move(*this); }
    /// Where they are not those of a new struct.
    Fields at_defaults(const Struct& of) && { return usual = std::make_shared<const Struct>(of), std::move(*this); }
    Fields bare() && { return is_bare = true, std::move(*this); }
    /// Refuses what no single key shows, after all of them were read.
    Fields checked(void (*look_at)(const YamlMap&, const Struct&)) && {
        check = [look_at](const YamlMap& keys, const void* whole) { look_at(keys, *static_cast<const Struct*>(whole)); };
        return std::move(*this);
    }
    Fields in_schema(std::string_view json) && { return schema_beside = json, std::move(*this); }
    Fields defined_as(std::string_view name) && { return definition = name, std::move(*this); }
};

namespace field_parts {

template <class T> inline constexpr bool is_optional = false;
template <class T> inline constexpr bool is_optional<std::optional<T>> = true;
template <class T> inline constexpr bool is_shared = false;
template <class T> inline constexpr bool is_shared<std::shared_ptr<T>> = true;
template <class T> inline constexpr bool is_vector = false;
template <class T> inline constexpr bool is_vector<std::vector<T>> = true;
template <class T> T& of(void* value) { return *static_cast<T*>(value); }

template <class M> constexpr MemberType type_of_member() {
    MemberType type;
    if constexpr (is_optional<M>) {
        type.look = [](void* member) -> void* { return of<M>(member) ? &*of<M>(member) : nullptr; };
        type.make = [](void* member) -> void* { return &of<M>(member).emplace(); };
        type.clear = [](void* member) { of<M>(member).reset(); };
    } else if constexpr (is_shared<M>) {
        using Pointed = std::remove_const_t<typename M::element_type>;
        type.look = [](void* member) -> void* { return const_cast<Pointed*>(of<M>(member).get()); };
        type.make = [](void* member) -> void* {
            const auto made = std::make_shared<Pointed>();
            return of<M>(member) = made, made.get();
        };
    } else if constexpr (is_vector<M>) {
        type.clear = [](void* member) { of<M>(member).clear(); };
        type.size = [](void* member) { return of<M>(member).size(); };
        type.element = [](void* member, std::size_t i) -> void* { return &of<M>(member)[i]; };
        type.append = [](void* member) -> void* { return &of<M>(member).emplace_back(); };
        if constexpr (requires(typename M::value_type & e) {
                          { e.name } -> std::same_as<std::string&>;
                      })
            type.name_of = [](void* element) { return &of<typename M::value_type>(element).name; };
    }
    return type;
}
template <class M> inline constexpr MemberType member_type = type_of_member<M>();
inline constexpr MemberType plain_type;

template <class M> Member member_at(std::ptrdiff_t offset) {
    if constexpr (is_optional<M> || is_shared<M> || is_vector<M>)
        return {offset, &member_type<M>};
    else
        return {offset, &plain_type};
}
/// A pointer to a member is the member's offset: Itanium C++ ABI, 2.3.
template <class Struct, class M> Member member_of(M Struct::*member) { return member_at<M>(std::bit_cast<std::ptrdiff_t>(member)); }

template <class T> struct Plain { using type = T; };
template <class T> struct Plain<std::optional<T>> { using type = T; };
template <class T> struct Plain<std::shared_ptr<T>> { using type = std::remove_const_t<T>; };

template <class T> constexpr FieldKind kind_of() {
    if constexpr (std::is_same_v<T, double>)
        return FieldKind::number;
    else if constexpr (std::is_same_v<T, int>)
        return FieldKind::whole;
    else if constexpr (std::is_same_v<T, bool>)
        return FieldKind::flag;
    else if constexpr (std::is_same_v<T, std::string>)
        return FieldKind::text;
    else if constexpr (std::is_same_v<T, std::filesystem::path>)
        return FieldKind::path;
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
        return FieldKind::names;
    else if constexpr (std::is_same_v<T, std::vector<double>>)
        return FieldKind::numbers;
    else if constexpr (std::is_same_v<T, glm::dvec3>)
        return FieldKind::position;
    else {
        static_assert(std::is_enum_v<T> && sizeof(T) == sizeof(int),
                      "a struct needs a description: field(key, id, member, fields, meaning)");
        return FieldKind::choice;
    }
}

template <class M, class F> inline constexpr bool is_of =
    std::is_same_v<typename Plain<M>::type, typename std::remove_cvref_t<F>::Described>;

} // namespace field_parts

/// Both ends included.
inline FieldRule range(double least, double greatest) { return {least, greatest}; }
inline FieldRule words(std::vector<std::string_view> in_order) { return {0.0, 0.0, 0, 0, std::move(in_order)}; }
/// From `least` to below `bound`; else `expected` is said.
inline FieldRule below(double least, double bound, std::string_view expected) {
    FieldRule rule = range(least, bound);
    rule.refused_as = expected;
    return rule;
}
inline FieldRule numbers(std::size_t fewest, std::size_t most, double least, double greatest) { return {least, greatest, fewest, most}; }
inline FieldRule words(std::span<const std::string_view> in_order) { return words(std::vector(in_order.begin(), in_order.end())); }
/// A list of names.
inline FieldRule names(std::size_t fewest, std::size_t most) { return {0.0, 0.0, fewest, most}; }
inline FieldRule any() { return {}; } ///< flags, text and paths
inline FieldRule a_name() {
    FieldRule rule;
    rule.kind = FieldKind::name;
    return rule;
}
/// A list of texts.
inline FieldRule texts(std::size_t fewest, std::size_t most) {
    FieldRule rule = names(fewest, most);
    rule.kind = FieldKind::texts;
    return rule;
}
/// The bound itself is not allowed.
inline FieldRule above(double bound, double greatest) {
    FieldRule rule = range(bound, greatest);
    rule.is_above = true;
    return rule;
}
/// `key`_deg or `key`_rad, so far to both sides.
FieldRule degrees_within(std::string_view key, double limit_deg);
FieldRule in_radians(std::string_view key, double limit_deg); ///< the same, written in radians
/// `key`_deg_s or `key`_rad_s.
FieldRule angular_speed(std::string_view key, double min_deg_s, double max_deg_s, double min_rad_s, double max_rad_s);
/// `key`_kmh up to 540, or `key`_mps.
FieldRule speed(std::string_view key);
FieldRule units(FieldUnit first, FieldUnit own);

template <class Struct, class M>
FieldOf<Struct> field(std::string_view key, int id, M Struct::*member, const FieldRule& rule, std::string_view meaning) {
    constexpr FieldKind kind = field_parts::kind_of<typename field_parts::Plain<M>::type>();
    FieldOf<Struct> made{key, id, rule.kind.value_or(kind), field_parts::member_of(member), meaning};
    made.rule = rule;
    return made;
}

/// A struct within the struct.
template <class Struct, class M, Description F>
FieldOf<Struct> field(std::string_view key, int id, M Struct::*member, F&& fields, std::string_view meaning) {
    static_assert(field_parts::is_of<M, F>);
    return FieldOf<Struct>{key, id, FieldKind::group, field_parts::member_of(member), meaning}.of(std::forward<F>(fields));
}

/// The same where no pointer to a member leads: in an array.
template <class Struct, class Inner>
FieldOf<Struct> field(std::string_view key, int id, Inner& (*at)(Struct&), const Fields<Inner>& fields, std::string_view meaning) {
    Struct usual;
    const std::ptrdiff_t offset = reinterpret_cast<char*>(&at(usual)) - reinterpret_cast<char*>(&usual);
    return FieldOf<Struct>{key, id, FieldKind::group, field_parts::member_at<Inner>(offset), meaning}.of(fields);
}

/// Some members of the struct, below a key of their own.
template <Description F> auto section(std::string_view key, int id, F&& fields, std::string_view meaning) {
    using Struct = typename std::remove_cvref_t<F>::Described;
    return FieldOf<Struct>{key, id, FieldKind::group, field_parts::member_at<Struct>(0), meaning}.of(std::forward<F>(fields));
}

/// A struct within, whose keys stand among those of the struct that has it.
template <class Struct, class M, Description F> FieldOf<Struct> inlined(int id, M Struct::*member, F&& fields) {
    static_assert(field_parts::is_of<M, F>);
    return FieldOf<Struct>{"", id, FieldKind::inlined, field_parts::member_of(member), ""}.of(std::forward<F>(fields));
}

/// Some members of the struct that are described for several structs.
template <class Struct> FieldOf<Struct> inlined(int id, const Fields<Struct>& fields) {
    FieldOf<Struct> made = section("", id, fields, "");
    made.kind = FieldKind::inlined;
    return made;
}

/// Structs by names that the user chooses; `name` is their member for it.
template <class Struct, class Inner, Description F> FieldOf<Struct> named(std::string_view key, int id, std::vector<Inner> Struct::*member,
                                                                          std::size_t most, F&& fields, std::string_view meaning) {
    static_assert(field_parts::is_of<Inner, F>);
    FieldOf<Struct> made{key, id, FieldKind::named, field_parts::member_of(member), meaning};
    made.rule = names(1, most);
    return std::move(made).of(std::forward<F>(fields));
}

template <class Struct, class Inner, Description F> FieldOf<Struct> list(std::string_view key, int id, std::vector<Inner> Struct::*member,
                                                                         std::size_t fewest, std::size_t most, F&& fields,
                                                                         std::string_view meaning) {
    static_assert(field_parts::is_of<Inner, F>);
    FieldOf<Struct> made{key, id, FieldKind::list, field_parts::member_of(member), meaning};
    made.rule = names(fewest, most);
    return std::move(made).of(std::forward<F>(fields));
}

/// What no kind above fits: read (unless whoever calls does) and written by functions, described to editors by JSON.
template <class Struct> FieldOf<Struct> own(std::string_view key, int id, void (*read)(const YamlEntry&, Struct&),
                                            std::string (*text)(const Struct&), std::string_view schema, std::string_view meaning) {
    FieldOf<Struct> made{key, id, FieldKind::own, {}, meaning};
    if (read)
        made = std::move(made).read_by(read);
    return std::move(made).text_by(text).schema_by(schema);
}

/// Another way to give what other keys say: never written. It is read by `read`, or by whoever calls.
template <class Struct> FieldOf<Struct> form(std::string_view key, FieldKind kind, const FieldRule& rule, std::string_view meaning,
                                             void (*read)(const YamlEntry&, Struct&) = nullptr) {
    FieldOf<Struct> made{key, 0, kind, {}, meaning};
    made.rule = rule;
    made.is_form = true;
    return read ? std::move(made).read_by(read) : made;
}

/// Keys of another struct that stand in its place.
template <class Struct> FieldOf<Struct> forms_of(const Group& group, std::string_view meaning) {
    return form<Struct>("", FieldKind::inlined, {}, meaning).of(group);
}

} // namespace fernlicht
