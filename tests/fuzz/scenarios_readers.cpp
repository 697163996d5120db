#include "tests/fuzz/readers.h"

#include "scenarios/can/can_database.h"
#include "scenarios/can/candump_stream.h"
#include "scenarios/can/signal_codec.h"
#include "scenarios/control/fmu/fmu_description.h"
#include "scenarios/display/display_profile.h"
#include "scenarios/drives/drive.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/lamps/beam_files.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/level_track.h"
#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/lamps/pixel_lamp_file.h"
#include "scenarios/lamps/text_grid.h"
#include "scenarios/models/model.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/ratings/rating.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/picture_decoding.h"

#include <array>
#include <cstdint>

namespace fernlicht::fuzz {
namespace {

namespace fs = std::filesystem;

using ReadLampText = LampFile (*)(const fs::path&, std::string_view, const LampReadOptions&, FilesRead);

void check(LampFile lamp) {
    check_invariants(lamp.table);
    mirror(lamp);
    check_invariants(lamp.table);
}

/// What resampling takes tells nothing of a reader.
class FewSamples {
  public:
    FewSamples() { most_resampled = 500; }
    ~FewSamples() { most_resampled = before_; }
    FewSamples(const FewSamples&) = delete;
    FewSamples& operator=(const FewSamples&) = delete;

  private:
    std::size_t before_ = most_resampled;
};

template <ReadLampText read> void read_lamp_text(const fs::path& file) {
    const FewSamples few;
    FilesRead opened;
    check(read(file, lamp_text(read_file(file, opened), file), {}, opened));
}

void read_grid(const fs::path& folder) {
    const FewSamples few;
    FilesRead opened;
    const fs::path file = folder / "grid.txt";
    const GridRecipe recipe = read_grid_recipe(folder / "recipe.yaml", opened);
    check(read_text_grid(file, lamp_text(read_file(file, opened), file), recipe, {}, opened));
}

/// A pixel lamp, a segment or profile of it, and its levels over time.
void read_pixels(const fs::path& folder) {
    FilesRead opened;
    const fs::path file = folder / "lamp.yaml";
    const auto lamp =
        std::make_shared<const LampFile>(read_pixel_lamp(file, lamp_text(read_file(file, opened), file), {}, std::move(opened)));
    check(*lamp);
    const auto track = read_levels(folder / "levels.csv", lamp, opened);
    for (const double time_s : {0.0, 0.55, 0.3})
        check_invariants(track->at(time_s)->table);
}

void append_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(number >> shift);
}

/// CRC-32 of ISO 3309, as PNG takes it.
std::uint32_t check_sum(std::string_view bytes) {
    std::uint32_t sum = ~0U;
    for (const char c : bytes) {
        sum ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            sum = sum >> 1 ^ (0xedb88320U & (0U - (sum & 1U)));
    }
    return ~sum;
}

/// A PNG whose chunks have right check sums, so that what is changed in them is read at all.
std::string with_check_sums(const std::string& bytes) {
    constexpr std::size_t head = 8, frame = 12;
    if (!bytes.starts_with("\x89PNG"))
        return bytes;
    std::string out = bytes.substr(0, head);
    for (std::size_t at = head; at + frame <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
        length = std::min(length, bytes.size() - at - frame);
        const std::string_view chunk = std::string_view(bytes).substr(at + 4, 4 + length);
        append_number(out, static_cast<std::uint32_t>(length));
        out += chunk;
        append_number(out, check_sum(chunk));
        at += frame + length;
    }
    return out;
}

void read_picture(const fs::path& folder) {
    FilesRead opened;
    const fs::path file = folder / "picture.png";
    const std::string bytes = with_check_sums(read_file(file, opened));
    constexpr std::size_t max_pixels = std::size_t{1} << 20;
    tried([&] { decode_picture(file, "", bytes, max_pixels); });
    check(read_beam_texture(file, bytes,
                            {.texture_scale_lx = 10.0, .texture_h_extent_deg = {-30.0, 30.0}, .texture_v_extent_deg = {-10.0, 10.0}}, {}));
}

void read_scenario(const fs::path& folder) {
    FilesRead opened;
    tried([&] { osc::read_storyboard(folder / "scenario.xosc", {.lenient = true}); });
    osc::read_variations(folder / "scenario.xosc", opened);
}

/// A study, and the drive of its first cell.
void read_first_cell(const fs::path& folder) {
    constexpr std::size_t few = 64;
    const Study study = read_study(folder / "study.yaml");
    if (study.points.size() <= few)
        cell_drive(study, cells_of(study).front());
}

/// A rating, and the lamps under it in the drive of its first row.
void read_rated_lamps(const fs::path& folder) {
    const Rating rating = read_rating(folder / "rating.yaml");
    DriveEdits edits;
    edits.lamp_sets = folder / "lamps.yaml";
    read_drive(rating.rows.front().drive, edits);
}

/// A database, and what its signals make of a frame.
void read_database(const fs::path& folder) {
    FilesRead opened;
    std::array<std::uint8_t, 64> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(37 * i);
    for (const CanMessage& message : read_dbc(folder / "database.dbc", opened).messages)
        for (const CanSignal& signal : message.signals)
            if (const auto value = decode(message, signal, std::span(bytes).first(std::min<std::size_t>(message.length, bytes.size()))))
                exact_text(*value);
}

/// Line by line, past those that are refused, and as a whole.
void read_log(const fs::path& folder) {
    FilesRead opened;
    const std::string text = read_file(folder / "bus.log", opened);
    CandumpStream lines(folder / "bus.log", text);
    for (bool more = true; more;)
        tried([&] { more = lines.next() != CandumpStream::What::end; });
    read_candump(folder / "bus.log", opened);
}

void read_fmu(const fs::path& folder) {
    FilesRead opened;
    const fs::path file = folder / "modelDescription.xml";
    read_fmu_description(file, read_file(file, opened));
}

template <auto read> void read_opened(const fs::path& file) {
    FilesRead opened;
    read(file, opened);
}

} // namespace

std::span<const Reader> scenarios_readers() {
    static const std::vector<Reader> all{
        {"ies",
         {"lamp.ies"},
         [](const fs::path& f) { read_lamp_text<read_ies>(f / "lamp.ies"); },
         "scenarios/lamps/ies_reader.cpp",
         "scenarios/library/lamps/street-*.ies"},
        {"ldt", {"lamp.ldt"}, [](const fs::path& f) { read_lamp_text<read_eulumdat>(f / "lamp.ldt"); }, "scenarios/lamps/eulumdat.cpp", ""},
        {"matrix",
         {"lamp.csv"},
         [](const fs::path& f) { read_lamp_text<read_beam_matrix>(f / "lamp.csv"); },
         "scenarios/lamps/beam_matrix.cpp",
         "scenarios/library/lamps/*.csv"},
        {"grid",
         {"grid.txt", "recipe.yaml"},
         read_grid,
         "scenarios/lamps/grid_recipe.cpp scenarios/lamps/text_grid.cpp scenarios/lamps/list_grid.cpp",
         ""},
        {"pixels",
         {"lamp.yaml", "segment.csv", "levels.csv"},
         read_pixels,
         "scenarios/lamps/pixel_lamp_reader.cpp scenarios/lamps/level_track_reader.cpp",
         ""},
        {"picture", {"picture.png"}, read_picture, "scenarios/values/picture_decoding.cpp scenarios/lamps/beam_texture.cpp", ""},
        {"opendrive",
         {"road.xodr"},
         [](const fs::path& f) { read_opendrive(f / "road.xodr"); },
         "scenarios/roads/opendrive",
         "scenarios/library/roads/*.xodr"},
        {"openscenario",
         {"scenario.xosc", "catalogs/cars.xosc"},
         read_scenario,
         "scenarios/openscenario/reader scenarios/openscenario/osc_catalogs.cpp scenarios/openscenario/expression.cpp",
         "scenarios/library/storyboards/*.xosc"},
        {"drive",
         {"tested.yaml"},
         [](const fs::path& f) { read_drive(f / "tested.yaml"); },
         "scenarios/drives/keys",
         "scenarios/drive.example.yaml scenarios/library/drives/*.yaml"},
        {"study",
         {"study.yaml", "drive.yaml"},
         read_first_cell,
         "scenarios/studies",
         "scenarios/study.example.yaml scenarios/library/studies/*.yaml"},
        {"rating", {"rating.yaml", "lamps.yaml"}, read_rated_lamps, "scenarios/ratings", "scenarios/rating.example.yaml"},
        {"dbc", {"database.dbc"}, read_database, "scenarios/can/dbc", "scenarios/library/can/*.dbc"},
        {"candump", {"bus.log"}, read_log, "scenarios/can/candump_parse.cpp scenarios/can/can_frame.cpp", ""},
        {"gltf",
         {"model.gltf", "model.bin"},
         [](const fs::path& f) { read_model(f / "model.gltf"); },
         "scenarios/models",
         "scenarios/library/models/*.gl*"},
        {"fmu", {"modelDescription.xml"}, read_fmu, "scenarios/control/fmu/fmu_description.cpp", ""},
        {"display",
         {"display.yaml"},
         [](const fs::path& f) { read_opened<read_display_profile>(f / "display.yaml"); },
         "scenarios/display/display_profile.cpp",
         "scenarios/library/displays/*.yaml"},
        {"spectrum", {"light.csv"}, [](const fs::path& f) { read_opened<read_spectrum>(f / "light.csv"); }, "", ""},
        {"drive-log", {"drive-log.csv"}, [](const fs::path& f) { read_opened<read_drive_log>(f / "drive-log.csv"); }, "", ""},
    };
    return all;
}

} // namespace fernlicht::fuzz
