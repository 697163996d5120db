// FMUs of the example's bend light (scenarios/control/bend_light_fmu.c), as archives with descriptions of the test's own.
#pragma once

#include "tests/trial.h"

#include <fmt/format.h>

namespace fernlicht::tests {

struct FmuText {
    int version = 2;
    std::string variables; ///< elements of ModelVariables beside the law's own two inputs
    std::string token = "bend-light";
    std::string swivel = "lamp.left.swivel_command_rad", swivel_type = "Real"; ///< Float64 in 3.0
    std::string root_more = "<UnitDefinitions><Unit name=\"deg\"><BaseUnit rad=\"1\" factor=\"0.017453292519943295\"/></Unit>"
                            "<Unit name=\"km/h\"><BaseUnit m=\"1\" s=\"-1\" factor=\"0.2777777777777778\"/></Unit></UnitDefinitions>";
    std::string co_simulation = "<CoSimulation modelIdentifier=\"bend\"/>";
};

/// "<ScalarVariable ...><Real/></ScalarVariable>", or "<Float64 .../>" where the type is of FMI 3.0.
inline std::string fmu_variable(int version, const std::string& name, const std::string& causality, const std::string& type, int reference,
                                const std::string& more = "", const std::string& inside = "") {
    const std::string common = fmt::format("name=\"{}\" causality=\"{}\" valueReference=\"{}\"", name, causality, reference);
    return version == 2 ? fmt::format("<ScalarVariable {}><{} {}/></ScalarVariable>\n", common, type, more)
                        : fmt::format("<{0} {1} {2}>{3}</{0}>\n",
                                      type == "Real"      ? "Float64"
                                      : type == "Integer" ? "Int64"
                                                          : type,
                                      common, more, inside);
}

inline std::string fmu_description(const FmuText& of) {
    const auto variable = [&](const char* name, const char* causality, const std::string& type, int reference, const char* start) {
        return fmu_variable(of.version, name, causality, type, reference, start);
    };
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{}.0\" {}=\"{}\" modelName=\"bend light\">\n{}{}"
        "<ModelVariables>\n{}{}{}{}{}{}</ModelVariables></fmiModelDescription>\n",
        of.version, of.version == 2 ? "guid" : "instantiationToken", of.token, of.co_simulation, of.root_more,
        variable("ego.yaw_rate_rad_s", "input", "Real", 0, "start=\"0\""), variable("ego.speed_mps", "input", "Real", 1, "start=\"0\""),
        variable(of.swivel.c_str(), "output", of.swivel_type, 2, ""), variable("fault", "parameter", "Integer", 3, "start=\"0\""),
        variable("preview_s", "parameter", "Real", 127, "start=\"1.5\""), of.variables);
}

/// These files (name in the archive, content) as NAME; an empty content makes a folder.
inline std::filesystem::path zipped(const std::string& name, const std::vector<std::pair<std::string, std::string>>& files) {
    const std::filesystem::path folder = new_folder(), out = new_folder() / name;
    for (const auto& [inside, content] : files) {
        std::filesystem::create_directories((folder / inside).parent_path());
        written(inside, content, folder);
    }
    if (std::system(fmt::format("cd '{}' && cmake -E tar cf '{}' --format=zip *", folder.string(), out.string()).c_str()) != 0)
        throw std::runtime_error("cmake cannot make a zip");
    return out;
}

inline std::string fmu_binary() {
    std::ifstream in(std::filesystem::path(FERNLICHT_BINARY).parent_path() / "tests/bend_light_fmu.so", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline std::filesystem::path fmu_archive(const FmuText& of) {
    return zipped("law.fmu", {{"modelDescription.xml", fmu_description(of)},
                              {of.version == 2 ? "binaries/linux64/bend.so" : "binaries/x86_64-linux/bend.so", fmu_binary()}});
}

} // namespace fernlicht::tests
