// `fernlicht model FILE`: what a model holds, and how it looks at night in the light of our lamps.
#pragma once

#include "scenarios/models/model.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace fernlicht {

struct ModelRequest {
    std::filesystem::path file;
    std::string body;              ///< one of our own bodies in place of a file: "car", "van" ...
    std::filesystem::path picture; ///< PNG; empty: none
    std::filesystem::path write;   ///< GLB; empty: none
    double distance_m = 25.0;      ///< from the lamps to the model's nearest point, >= 1
    double yaw_deg = 0.0;          ///< of the model: 0 drives away from us, 180 comes towards us
    double scale = 1.0;
    std::string lamp = "halogen-low"; ///< two_lamps.h
    std::string technique = "photometric", backend = "auto";
    int width_px = 960, height_px = 540;
    bool json = false, force = false;
};

/// The model of the file or the body. Throws InputError.
Model model_of(const ModelRequest& request);
/// What a model is, for people or for programs.
std::string model_text(const Model& model, double scale);
std::string model_json(const Model& model, double scale);

/// All that the request asks for; text or JSON goes to standard output. Returns 0. Throws InputError, DeviceError.
int model_command(const ModelRequest& request);

/// Adds `fernlicht town`, as add_model_command() does for `fernlicht model`, which calls it.
void add_town_command(CLI::App& app, std::function<int()>& chosen);

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
