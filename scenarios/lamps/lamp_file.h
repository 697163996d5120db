// A lamp as it stands in a file: candela table, what the file says of it, and what was read.
#pragma once

#include "scenarios/lamps/candela_table.h"
#include "scenarios/values/files.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace fernlicht {

class PixelLamp;

/// Where a Type C file (and EULUMDAT) points its beam: at the horizon as headlamps are measured, or to the nadir as luminaires are.
enum class TypeCAxis { automatic, horizontal, nadir };

/// What a lamp's beam is for. other: neither of a headlamp's two, as fog lamps and street lamps.
enum class BeamFunction { low, high, other };

struct LampReadOptions {
    BetweenSamples rule = BetweenSamples::linear_cd;
    TypeCAxis type_c_axis = TypeCAxis::automatic;
    /// Beam texture images only (method: E[lx] = pixel * scale at the distance, over the angular extent).
    double texture_scale_lx = 0.0; ///< lux of a pixel of value 1.0 (8-bit: 255); 0: take it from the image's metadata
    double texture_distance_m = 25.0;
    double texture_h_extent_deg[2] = {0.0, 0.0}; ///< left and right edge; equal: from the image's metadata
    double texture_v_extent_deg[2] = {0.0, 0.0}; ///< bottom and top edge
    bool mirrored = false;                       ///< H and -H exchanged after reading: a lamp for the other side of the road
    /// Of text grids that no format tells: the file that says how they are laid out (grid_recipe.h). "": none.
    std::filesystem::path recipe = {};

    bool operator==(const LampReadOptions&) const = default;
};

struct LampFile {
    std::string name;        ///< short: catalogue or luminaire name, else the file's stem
    std::string format = {}; ///< "IES LM-63-2002, type A", "EULUMDAT, Isym 0", "beam matrix", "beam texture"
    CandelaTable table = {};
    std::optional<MeasuredTable> measured = {};  ///< where its angles are others and `table` was resampled; nullopt: `table` is its own
    std::optional<double> declared_flux_lm = {}; ///< as the file says; nullopt: absolute photometry or silent
    std::vector<std::pair<std::string, std::string>> labels = {}; ///< the file's own keywords and texts, UTF-8
    std::vector<std::string> notes = {}; ///< what was odd and how it was taken ("angles descend: sorted"), one sentence each
    FilesRead opened = {};
    std::shared_ptr<const PixelLamp> pixels = {};  ///< whose light at full level `table` is; nullptr: nothing dims by itself
    std::shared_ptr<const LampFile> state_of = {}; ///< of a state of pixels: the lamp with all of them at full level, one for each lamp
};

struct LampFormat {
    std::string_view name, extensions; ///< "beam texture"; ".png, .exr"
    bool (*looks_so)(std::string_view content);
    LampFile (*read)(const std::filesystem::path&, std::string_view content, const LampReadOptions&, FilesRead);
    bool picture = false; ///< its content is the file's bytes; of all others it is their text as UTF-8
};
/// In the order in which a file's content is held against them: the first line of some is free text.
std::span<const LampFormat> lamp_formats();
std::string lamp_format_list(); ///< "IES LM-63 (.ies), ... or beam texture (.png, .exr)"

/// Reads any supported lamp file, told by content first and extension second; where there is a recipe, texts that are neither IES nor an
/// .ldt file by it. Throws InputError.
LampFile read_lamp(const std::filesystem::path& path, const LampReadOptions& options = {});

void mirror(LampFile& lamp); ///< H and -H exchanged, in all tables

/// Writers; the extension decides in write_lamp: .ies (LM-63-2002 type A), .csv (beam matrix, cd), .exr (float beam texture).
void write_lamp(const LampFile& lamp, const std::filesystem::path& path);

} // namespace fernlicht
