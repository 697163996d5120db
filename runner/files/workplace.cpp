#include "runner/files/workplace.h"

#include "scenarios/values/errors.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace fernlicht {
namespace {

std::filesystem::path new_folder_below(const std::filesystem::path& below, const std::string& begins_with) {
    make_folder(below);
    std::string name = (below / (begins_with + "-XXXXXX")).string();
    if (!::mkdtemp(name.data()))
        throw DeviceError(below.string() + ": cannot be written: " + std::generic_category().message(errno));
    return name;
}

} // namespace

Workplace::Workplace(const std::filesystem::path& below, const std::string& begins_with)
    : folder_(new_folder_below(below, begins_with)), lock_(folder_, FolderLock::For::reading) {}

Workplace::~Workplace() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

} // namespace fernlicht
