// A drive: everything that decides what a run shows, resolved to plain values. Read from YAML; written back beside the results.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/roads/route.h"

#include <map>

namespace fernlicht {

enum class Projection { perspective, map };

/// A camera. Perspective: on the car, looking along `axes`' x. Map: a bird's eye, orthographic, north = direction of travel.
struct View {
    std::string name;
    Projection projection = Projection::perspective;
    glm::dvec3 position_m{0.0};                            ///< in the car's frame
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0; ///< perspective only
    double vertical_fov_rad = 0.7;                         ///< perspective only; 0 < fov < pi
    int width_px = 1024, height_px = 768;
    double map_ahead_m = 0.0, map_behind_m = 0.0, map_left_m = 0.0, map_right_m = 0.0; ///< map only; from the car's origin
};

struct Daylight {
    std::string name = "night";
    double horizontal_illuminance_lx = 0.0; ///< diffuse, from a uniform sky
};

enum class ToneMapperKind { linear, rational, logarithmic };
struct ToneMapper {
    ToneMapperKind kind = ToneMapperKind::rational;
    double s = 30.0;          ///< rational only; >= 1, 1 is linear
    double l_max_cdm2 = 50.0; ///< luminance that becomes white
};

struct SpeedPoint {
    double time_s = 0.0, speed_mps = 0.0; ///< linear between points, constant after the last
};

/// At `time_s` the named lamps change; what is not given stays.
struct LampChange {
    double time_s = 0.0;
    std::string lamp; ///< name of a mounted lamp
    std::optional<double> level;
    std::optional<double> pitch_rad, yaw_rad, roll_rad;
    std::shared_ptr<const LampFile> file;
    std::optional<LampColour> colour;
    std::optional<SourceKind> source;
};

/// One lamp set under comparison: the whole drive is played once with each.
struct Variant {
    std::string name; ///< "halogen", "xenon"
    std::vector<MountedLamp> lamps;
    std::vector<LampChange> changes;
};

struct Probe {
    std::string name;
    double ahead_m = 0.0, left_m = 0.0, above_m = 0.0; ///< from the car's origin along the route; above the surface
};

struct ExtentParameters {
    std::vector<double> limits_lx{1.0, 3.0, 5.0, 10.0};
    double target_height_m = 0.25;   ///< of the target that faces the car
    double ahead_m = 200.0;          ///< how far is looked
    double beside_m = 20.0;          ///< how far to each side
    double cell_m = 0.5;             ///< grid along the road; across: a quarter of it
    std::vector<double> width_at_m{20.0, 50.0};
};

struct Limit {
    std::string reading; ///< name of a row, e.g. "reach_5lx_road_own_m"
    std::optional<double> at_least, at_most;
};

struct Capture {
    double per_second = 2.0;
    bool all = false;
    bool exr = true, png = true;
};

struct Drive {
    std::string name, title;
    std::filesystem::path file; ///< the YAML it came from
    std::filesystem::path road_file;
    Route::Start start;
    std::vector<std::string> via;
    std::vector<SpeedPoint> speed;
    double duration_s = 0.0, step_s = 0.0;
    Daylight daylight;
    double bumper_m = 0.0; ///< x of the front bumper in the car's frame; reach is measured from it
    std::vector<Variant> variants; ///< at least one
    std::vector<View> views;       ///< first is the driver's
    Capture capture;
    ToneMapper tone_mapper;
    std::string technique = "photometric";
    std::optional<ExtentParameters> extent;
    std::vector<Probe> probes;
    std::vector<Limit> limits;
    bool shadows = true;
    std::uint64_t seed = 1;
    FilesRead opened;
};

/// What main's flags may change; applied before resolving, so that the resolved drive carries them.
struct DriveEdits {
    std::vector<std::pair<std::string, std::filesystem::path>> lamps; ///< side ("" = all) and file
    std::optional<std::filesystem::path> road;
    std::optional<std::string> technique;
    std::optional<std::pair<int, int>> resolution;
    std::optional<bool> capture_all;
};

Drive read_drive(const std::filesystem::path& path, const DriveEdits& edits = {});
/// YAML that read_drive reads back to the same drive; paths become absolute.
std::string write_drive(const Drive& drive);

} // namespace fernlicht
