#include "runner/experiments/compare/name_beside.h"

namespace fernlicht {

std::string name_beside(const LampFile& lamp, const LampFile& other) {
    if (lamp.opened.empty())
        return lamp.name;
    const std::filesystem::path file = lamp.opened.front().path;
    const bool is_alike = !other.opened.empty() && other.opened.front().path.filename() == file.filename();
    const std::string name = is_alike ? file.string() : file.filename().string();
    const bool says_more = !lamp.name.empty() && lamp.name != file.filename().string() && lamp.name != file.stem().string();
    return says_more ? name + " (" + lamp.name + ")" : name;
}

} // namespace fernlicht
