// The reference of a file's keys as plain values: a list for each described struct. Its layout is up to
// runner/findings/key_reference.h.
#pragma once

#include "scenarios/fields/group.h"

#include <map>

namespace fernlicht {

struct KeyLine {
    std::vector<std::string> names; ///< "yaw_deg", "yaw_rad"; none where `meaning` stands for the keys of `below`
    std::string allowed;            ///< "0..5 m", "file"; "" of words and of what says it in its meaning
    std::vector<std::string> words; ///< one of these
    std::string below;              ///< path of the list with the keys of its value; "" for none
    std::string usual;              ///< its default; "" for none
    bool is_required = false;
    std::string meaning;

    bool operator==(const KeyLine&) const = default;
};

struct KeyList {
    std::string path;                ///< of these keys: "measure.glare", "traffic.NAME.speed[]"; "" at a drive's top
    bool stands_for_several = false; ///< of a group that has a name of its own
    std::vector<KeyLine> lines;
};

/// Keys of a struct, then of the structs within. `usual` is where defaults come from.
std::vector<KeyList> key_lists(const std::string& path, const Group& group, const void* usual);

/// Groups within that stand in several places, by name.
std::map<std::string_view, const Group*> definitions(const Group& group);

} // namespace fernlicht
