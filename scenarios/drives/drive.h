// A drive: everything that decides what a run shows, resolved to plain values. Read from YAML; written back beside the results.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/limit.h"
#include "scenarios/drives/seeing_parameters.h"
#include "scenarios/drives/shadow_settings.h"
#include "scenarios/lamps/beam_texels.h"
#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/models/model.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/roads/road_surface.h"
#include "scenarios/roads/route.h"
#include "scenarios/sky/daylight.h"
#include "scenarios/sky/street_lamps.h"
#include "scenarios/sky/weather.h"
#include "scenarios/traffic/traffic_row.h"
#include "scenarios/vehicle/vehicle_parameters.h"

#include <map>

namespace fernlicht {

enum class Projection { perspective, map };

/// A camera. Perspective: on the car, looking along `axes`' x. Map: a bird's eye, orthographic, north = direction of travel.
/// Pixels of a picture, from its top left corner.
struct PixelBox {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const PixelBox&) const = default;
};

/// How what stands beside the road looks (docs/scenery.md): left out, as plain shapes, or dressed.
enum class Dressing { none, plain, dressed };

struct View {
    std::string name;
    Projection projection = Projection::perspective;
    glm::dvec3 position_m{0.0};                            ///< in the car's frame
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0; ///< perspective only
    double vertical_fov_rad = 0.7;                         ///< perspective only; 0 < fov < pi
    bool mirrored = false;                                 ///< left and right exchanged, as a mirror shows it; perspective only
    int width_px = 1024, height_px = 768;
    double map_ahead_m = 0.0, map_behind_m = 0.0, map_left_m = 0.0, map_right_m = 0.0; ///< map only; from the car's origin
    /// Where anybody looks: beside these boxes nothing need be drawn. None: everywhere. Not part of the file.
    std::vector<PixelBox> looked_at = {};

    bool operator==(const View&) const = default;
};

struct ControlParameters;
struct Motion;

/// One lamp set under comparison: the whole drive is played once with each.
struct LampSet {
    std::string name; ///< "halogen", "xenon"
    std::vector<MountedLamp> lamps;
    std::vector<LampChange> changes;
    std::optional<LevellingParameters> levelling = std::nullopt; ///< only in a drive with a vehicle, as the next
    std::optional<SwivelParameters> swivel = std::nullopt;
    std::shared_ptr<const ControlParameters> control = nullptr; ///< laws that move and dim the lamps (control_parameters.h); nullptr: none
    std::vector<LampChange> storyboard_changes = {};            ///< of the storyboard, behind `changes`; not part of the file
    std::shared_ptr<const Motion> motion = nullptr;             ///< what simulate() made of them (motion.h); not part of the file
};

struct Probe {
    std::string name;
    double ahead_m = 0.0, left_m = 0.0, above_m = 0.0; ///< from the car's origin along the route; above the surface

    bool operator==(const Probe&) const = default;
};

struct ExtentParameters {
    std::vector<double> thresholds_lx{1.0, 3.0, 5.0, 10.0};
    double target_height_m = 0.25; ///< of the target that faces the car
    double ahead_m = 200.0;        ///< how far is looked
    double beside_m = 20.0;        ///< how far to each side
    double cell_m = 0.5;           ///< grid along the road; across: a quarter of it
    std::vector<double> width_at_m{20.0, 50.0};

    bool operator==(const ExtentParameters&) const = default;
};

struct Capture {
    double per_second = 2.0;
    bool all = false;
    bool exr = true, png = true;

    bool operator==(const Capture&) const = default;
};

/// A lamp file as the drive asked for it; each file is read once for each way of reading it.
struct LampSource {
    std::filesystem::path path;
    LampReadOptions options;
    std::shared_ptr<const LampFile> file;
};

struct BusMapping;
struct BusMotion;
struct BusPlay;
struct DriveLog;
struct StoryboardTimeline;

struct Drive {
    std::string name, title;
    std::filesystem::path file; ///< the YAML it came from
    std::filesystem::path road_file;
    bool mirrored_road = false; ///< the road of the file in a mirror, for the other side's traffic; lanes in `start` are the file's
    Route::Start start;
    std::vector<std::string> via;
    std::vector<SpeedPoint> speed;
    double duration_s = 0.0, step_s = 0.0;
    Daylight daylight;
    Weather weather;
    std::vector<StreetLampRow> street_lamps;    ///< beside the route
    std::optional<PlacedModel> own_car;         ///< the own car's body, in its frame; nullopt: none is drawn
    double bumper_m = 0.0;                      ///< x of the front bumper in the car's frame; reach is measured from it
    double wheelbase_m = 2.7;                   ///< from the rear axle to the front axle
    std::optional<VehicleParameters> vehicle;   ///< none: the car follows its lane as on rails
    std::vector<LampSet> lamp_sets;             ///< at least one
    std::vector<TrafficRow> traffic_rows;       ///< road users as the file asks for them
    double min_traffic_lx = 0.05;               ///< light of others below this is left out, from any one lamp (docs/traffic.md); > 0
    std::optional<StoryboardSource> storyboard; ///< where the own car and others go, instead of route and speed
    std::shared_ptr<const DriveLog> replay;     ///< poses, lamps and levels of a drive played before; not part of the file
    std::vector<RoadUser> traffic;              ///< what place_traffic() made of them; not part of the file
    std::shared_ptr<const Track> ego_track;     ///< the own car's way where a log or a storyboard says it; nullptr: the route's
    std::shared_ptr<const StoryboardTimeline>
        timeline; ///< what a storyboard changes besides (storyboard_timeline.h); nullptr: nothing. Not part of the file
    std::shared_ptr<const BusMapping> can;       ///< signals from and to a bus (can/bus_mapping.h); nullptr: none
    bool live = false;                           ///< the bus is listened to while the drive happens (bus_drive.h). Not part of the file
    std::shared_ptr<const BusPlay> bus;          ///< what simulate_bus() made of a recording (bus_play.h). Not part of the file
    std::shared_ptr<const BusMotion> bus_motion; ///< how the own car moves by the bus; nullptr: as `speed` says. Not part of the file
    std::vector<View> views;                     ///< first is the driver's
    Capture capture;
    ToneMapper tone_mapper;
    DisplaySettings display;
    std::string technique = "photometric";
    std::optional<ExtentParameters> extent;
    std::vector<Probe> probes;
    SeeingParameters seeing;                         ///< sensors and glare
    std::shared_ptr<const LampFile> adaptation_lamp; ///< of seeing.glare, as read_drive() read it; nullptr: none. Not part of the file
    std::vector<PlacedModel> scenery;
    std::vector<Limit> limits;
    ShadowSettings shadows;          ///< of the technique photometric; none: nothing casts a shadow, in rays neither
    std::optional<BeamTexels> beams; ///< how fine beam textures are; nullopt: as fine as the technique takes them, in float
    bool textured = true;            ///< surfaces have pictures
    Dressing dressing = Dressing::plain;
    RoadSurface road_surface;
    std::uint64_t seed = 1;
    std::vector<LampSource> lamp_sources; ///< where the lamps' files came from
    std::vector<std::string> notes;       ///< what was decided for the user ("the route ends after 8.2 s"), one sentence each
    FilesRead opened;
};

/// What main's flags may change; applied before resolving, so that the resolved drive carries them.
struct DriveEdits {
    /// Side and file: every lamp whose name contains the side ("" = all). High-beam lamps (name contains "high") are meant only
    /// when the side says so: "high", "high-left".
    std::vector<std::pair<std::string, std::filesystem::path>> lamps;
    std::filesystem::path lamp_recipe; ///< of those that are text grids; "": none
    std::optional<BeamAim> aim;        ///< in place of what the drive says of the aim of the own car's low and high beams, angles included
    std::optional<std::filesystem::path> road;
    /// A file with `lamp_sets`, or a whole drive: its car, vehicle, lamp sets, actuators, control and changes in place of the drive's.
    std::optional<std::filesystem::path> lamp_sets;
    std::optional<std::string> technique;
    std::optional<std::string> shadows; ///< method by name
    std::optional<std::pair<int, int>> resolution;
    std::optional<bool> capture_all;
    /// Key path (fields/key_path.h) and YAML in place of what the file has there, before it is read; relative paths start at the file.
    std::vector<std::pair<std::string, std::string>> values;
    std::vector<std::filesystem::path> road_folders; ///< where a storyboard's road is looked for, too
    bool lenient = false;                            ///< what a storyboard has that is not supported is left out
    std::string ego;                                 ///< the storyboard's entity that is the own car; "": as the drive says
    std::optional<std::filesystem::path> replay;     ///< drive-log.csv of a run
    std::optional<std::filesystem::path> can_log;    ///< recording of a bus; empty: none, although the drive names one
    std::optional<std::int64_t> can_start_ns;        ///< stamp in it that is the drive's 0 s
    std::optional<std::string> can_channel;          ///< frames of others are left out; "": none are
};

/// Reads and checks a drive file, schema version 1 (scenarios/drive.example.yaml explains every key). Throws InputError with file,
/// line, column and key path. A storyboard (.xosc) is read as a drive of defaults (story_drive.h). Lamp files are read; the road file must
/// exist but is left to read_opendrive. `edits` that fit nothing (a side that no lamp has) throw InputError too.
Drive read_drive(const std::filesystem::path& path, const DriveEdits& edits = {});
/// YAML that read_drive reads back to the same drive: nothing left to defaults, numbers exact, paths absolute. `file`, `notes` and
/// `opened` are not part of it.
std::string write_drive(const Drive& drive);

/// The driver's view: the first that is no map. nullptr where there are only maps.
inline const View* driver_view(const Drive& drive) {
    for (const View& view : drive.views)
        if (view.projection == Projection::perspective)
            return &view;
    return nullptr;
}

} // namespace fernlicht
