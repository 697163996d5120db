#include "runner/findings/library_versions.h"

#include "scenarios/values/version.h"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <lcms2.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/version.h>
#include <opencv2/core/version.hpp>
#include <xxhash.h>

extern "C" const char* sqlite3_libversion(void); // its header is runner/history's

namespace fernlicht {
namespace {

std::string dotted(unsigned long number, unsigned long major_unit, unsigned long minor_unit) {
    return fmt::format("{}.{}.{}", number / major_unit, number % major_unit / minor_unit, number % minor_unit);
}

} // namespace

std::vector<std::pair<std::string, std::string>> library_versions() {
    return {
        {"fernlicht", program_version},
        {"compiler", "g++ " __VERSION__},
        {"CLI11", CLI11_VERSION},
        {"fmt", dotted(FMT_VERSION, 10000, 100)},
        {"GLM", fmt::format("{}.{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, GLM_VERSION_REVISION)},
        {"librsvg", FERNLICHT_LIBRSVG},
        {"Little CMS", fmt::format("{}.{}", cmsGetEncodedCMMversion() / 1000, cmsGetEncodedCMMversion() % 1000 / 10)},
        {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
        {"oneTBB", TBB_runtime_version()},
        {"OpenCV", CV_VERSION},
        {"OpenEXR", FERNLICHT_OPENEXR},
        {"OpenImageIO", FERNLICHT_OPENIMAGEIO},
        {"SQLite", sqlite3_libversion()},
        {"xxHash", dotted(XXH_versionNumber(), 10000, 100)},
    };
}

} // namespace fernlicht
