#include "scenarios/values/program_module.h"

#include "scenarios/values/errors.h"

#include <dlfcn.h>
#include <filesystem>

namespace fernlicht {

void* module_function(const std::string& module, const char* function) {
    std::error_code ignored;
    const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / (module + ".so");
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); // again and again: it counts, and is never closed
    void* const found = library ? ::dlsym(library, function) : nullptr;
    if (!found)
        throw DeviceError(path.string() + ": cannot be opened: " + ::dlerror());
    return found;
}

} // namespace fernlicht
