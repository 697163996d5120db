#include "scenarios/values/program_module.h"

#include "scenarios/values/errors.h"

#include <dlfcn.h>

namespace fernlicht {

std::filesystem::path program_folder() {
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::filesystem::path program_part(const std::string& name) {
    std::error_code ignored;
    const std::filesystem::path folder = program_folder();
    return std::filesystem::exists(folder / name, ignored) ? folder / name : folder.parent_path() / "lib/fernlicht/modules" / name;
}

void* module_function(const std::string& module, const char* function) {
    const std::filesystem::path path = program_part(module + ".so");
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw DeviceError(path.string() + " is not installed: packages have it under the name " + module + ", or as a part of fernlicht");
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); // again and again: it counts, and is never closed
    void* const found = library ? ::dlsym(library, function) : nullptr;
    if (!found)
        throw DeviceError(path.string() + ": cannot be opened: " + ::dlerror());
    return found;
}

} // namespace fernlicht
