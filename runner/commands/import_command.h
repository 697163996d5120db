// `fernlicht import FILE.flt OUT.glb`: old databases once into a format that is read everywhere.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

struct ImportRequest {
    std::filesystem::path file, out;
    char forward = 'y';            ///< the file's axis that looks forward: y for vehicles, x where x is east
    bool force = false;            ///< `out` may be replaced
    std::filesystem::path program; ///< fernlicht-import; empty: beside this program
};

/// Starts fernlicht-import, which OpenSceneGraph is linked with, in a process of its own with at most 4 GiB and 5 minutes, so that its
/// start costs nothing else and a crash on a broken file is a sentence. Reads the result back and prints what it holds. Returns 0. Throws
/// InputError for what cannot be read, DeviceError where fernlicht-import is not there.
int import_command(const ImportRequest& request);

} // namespace fernlicht
