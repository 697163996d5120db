#include "scenarios/drives/keys/drive_texts.h"

#include "scenarios/drives/keys/control_keys.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/flow_list.h"
#include "scenarios/drives/keys/vehicle_keys.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/fields/write_fields.h"
#include "scenarios/yaml/yaml_tree.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Lines at a depth of two spaces each, as they follow a key: each begins with the end of the one before.
class Lines {
  public:
    template <class... Args> void add(int depth, fmt::format_string<Args...> format, Args&&... args) {
        text_ += '\n';
        text_.append(static_cast<std::size_t>(2 * depth), ' ');
        fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    }
    /// Whole lines, each with its end.
    void add_all(std::string_view lines) {
        if (!lines.empty())
            text_ += fmt::format("\n{}", lines.substr(0, lines.size() - 1));
    }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

std::string_view word(SourceKind kind) { return kind == SourceKind::filament ? "filament" : kind == SourceKind::arc ? "arc" : "led"; }
std::string_view word(BetweenSamples rule) { return rule == BetweenSamples::linear_cd ? "linear_cd" : "log_cd"; }
std::string_view word(TypeCAxis axis) {
    return axis == TypeCAxis::automatic ? "automatic" : axis == TypeCAxis::horizontal ? "horizontal" : "nadir";
}

void write_texture(Lines& out, int depth, const LampReadOptions& options) {
    const double(&h)[2] = options.texture_h_extent_deg;
    const double(&v)[2] = options.texture_v_extent_deg;
    const std::string h_extent = h[0] == h[1] ? "" : fmt::format(", h_extent_deg: [{}, {}]", h[0], h[1]);
    const std::string v_extent = v[0] == v[1] ? "" : fmt::format(", v_extent_deg: [{}, {}]", v[0], v[1]);
    out.add(depth, "texture: {{scale_lx: {}, distance_m: {}{}{}}}", options.texture_scale_lx, options.texture_distance_m, h_extent,
            v_extent);
}

void write_file_keys(Lines& out, int depth, const Drive& drive, const std::shared_ptr<const LampFile>& file) {
    for (const LampSource& source : drive.lamp_sources) {
        if (source.file != file)
            continue;
        out.add(depth, "file: {}", quoted(source.path.string()));
        out.add(depth, "between_samples: {}", word(source.options.rule));
        out.add(depth, "type_c_axis: {}", word(source.options.type_c_axis));
        write_texture(out, depth, source.options);
        if (source.options.mirrored)
            out.add(depth, "mirrored: true");
        return;
    }
    throw std::invalid_argument("write_drive: a lamp's file is not among the drive's lamp_sources");
}

void write_colour(Lines& out, int depth, const LampColour& colour) {
    out.add(depth, "colour: {{linear_srgb: {}, sp_ratio: {}, cct_k: {}}}", flow_list(colour.linear_srgb), colour.sp_ratio, colour.cct_k);
}

void write_lamp_keys(Lines& out, const Drive& drive, const MountedLamp& lamp) {
    out.add(3, "{}:", quoted(lamp.name));
    write_file_keys(out, 4, drive, lamp.file);
    out.add(4, "position_m: {}", flow_list(lamp.position_m));
    if (const Turn& m = lamp.mount; m != Turn{})
        out.add(4, "mount_turn: {{{}, {}, {}}}", angle_entry("yaw", m.yaw_rad), angle_entry("pitch", m.pitch_rad),
                angle_entry("roll", m.roll_rad));
    out.add(4, "aim: {{{}, {}, {}}}", angle_entry("pitch", lamp.pitch_rad), angle_entry("yaw", lamp.yaw_rad),
            angle_entry("roll", lamp.roll_rad));
    out.add(4, "level: {}", lamp.level);
    out.add(4, "source: {}", word(lamp.source));
    out.add(4, "voltage_v: {}", lamp.voltage_v);
    out.add(4, "reference_voltage_v: {}", lamp.reference_voltage_v);
    write_colour(out, 4, lamp.colour);
    out.add(4, "photometric_distance_m: {}", lamp.photometric_distance_m);
}

void write_change(Lines& out, const Drive& drive, const LampChange& change) {
    out.add(3, "- at_s: {}", change.time_s);
    out.add(4, "lamp: {}", quoted(change.lamp));
    if (change.level)
        out.add(4, "level: {}", *change.level);
    std::vector<std::string> aim;
    if (change.pitch_rad)
        aim.push_back(angle_entry("pitch", *change.pitch_rad));
    if (change.yaw_rad)
        aim.push_back(angle_entry("yaw", *change.yaw_rad));
    if (change.roll_rad)
        aim.push_back(angle_entry("roll", *change.roll_rad));
    if (!aim.empty())
        out.add(4, "aim: {{{}}}", fmt::join(aim, ", "));
    if (change.file)
        write_file_keys(out, 4, drive, change.file);
    if (change.source)
        out.add(4, "source: {}", word(*change.source));
    if (change.colour)
        write_colour(out, 4, *change.colour);
}

void write_lamp_set(Lines& out, const Drive& drive, const Variant& variant) {
    out.add(1, "{}:", quoted(variant.name));
    out.add(2, "lamps:");
    for (const MountedLamp& lamp : variant.lamps)
        write_lamp_keys(out, drive, lamp);
    out.add(2, "changes:{}", variant.changes.empty() ? " []" : "");
    for (const LampChange& change : variant.changes)
        write_change(out, drive, change);
}

std::string traffic_place(const TrafficRow& row) {
    if (row.place == TrafficPlace::storyboard) {
        std::string names;
        for (const std::string& entity : row.entities)
            names += (names.empty() ? "" : ", ") + quoted(entity);
        return row.entities.empty() ? "entities: all" : fmt::format("entities: [{}]", names);
    }
    if (row.place == TrafficPlace::lane)
        return fmt::format("lane: {{{}lane: {}, s_m: {}}}", row.start.road.empty() ? "" : fmt::format("road: {}, ", quoted(row.start.road)),
                           row.start.lane, row.start.s_m);
    return fmt::format("{}: {{gap_m: {}}}", row.place == TrafficPlace::ahead ? "ahead" : "oncoming", row.gap_m);
}

} // namespace

std::string street_lamps_text(const Drive& drive) {
    Lines out;
    for (const StreetLampRow& row : drive.street_lamps) {
        out.add(1, "{}:", quoted(row.name));
        write_file_keys(out, 2, drive, row.file);
        if (row.on_objects.empty()) {
            out.add(2, "first_m: {}", row.first_m);
            out.add(2, "last_m: {}", row.last_m);
            out.add(2, "every_m: {}", row.every_m);
            out.add(2, "beside_m: {}", row.beside_m);
        } else {
            out.add(2, "on_objects:");
            for (const std::string& word : row.on_objects)
                out.add(3, "- {}", quoted(word));
        }
        if (row.on_objects.empty() || row.height_m > 0.0)
            out.add(2, "height_m: {}", row.height_m);
        out.add(2, "arm_m: {}", row.arm_m);
        out.add(2, "{}", angle_entry("tilt", row.tilt_rad));
        out.add(2, "level: {}", row.level);
        write_colour(out, 2, row.colour);
    }
    return out.take();
}

std::string variants_text(const Drive& drive) {
    Lines out;
    for (const Variant& variant : drive.variants) {
        write_lamp_set(out, drive, variant);
        if (variant.levelling || variant.swivel)
            out.add_all("    actuators:\n" + block_text(actuators_fields(), &variant, 3));
        out.add_all(write_control(drive, variant));
    }
    return out.take();
}

std::string variants_bits(const Drive& drive) {
    Lines out;
    for (const Variant& variant : drive.variants) {
        write_lamp_set(out, drive, variant);
        out.add_all(field_bits(actuators_fields(), &variant));
        out.add_all(control_bits(drive, variant));
    }
    return out.take();
}

std::string traffic_text(const Drive& drive) {
    Lines out;
    for (const TrafficRow& row : drive.traffic_rows) {
        out.add(1, "{}:", quoted(row.name));
        out.add(2, "kind: {}", road_user_kinds[static_cast<std::size_t>(row.kind)]);
        if (row.size_m)
            out.add(2, "size_m: {}", flow_list(*row.size_m));
        if (!row.model.empty())
            out.add(2, "model: {}", quoted(row.model.string()));
        if (row.model_yaw_rad != 0.0)
            out.add(2, "{}", angle_entry("yaw", row.model_yaw_rad));
        if (row.model_scale != 1.0)
            out.add(2, "scale: {}", row.model_scale);
        out.add(2, "{}", traffic_place(row));
        if (row.place != TrafficPlace::storyboard)
            out.add(2, "speed:");
        for (const SpeedPoint& point : row.speed)
            out.add(3, "- {{at_s: {}, speed_mps: {}}}", point.time_s, point.speed_mps);
        if (!row.lamps.empty())
            out.add(2, "lamps:");
        for (const MountedLamp& lamp : row.lamps)
            write_lamp_keys(out, drive, lamp);
        if (!row.changes.empty())
            out.add(2, "changes:");
        for (const LampChange& change : row.changes)
            write_change(out, drive, change);
        out.add(2, "face_m: [{}, {}]", row.face_m.x, row.face_m.y);
        out.add(2, "tail_cd: {}", row.tail_cd);
        out.add(2, "brake_cd: {}", row.brake_cd);
        if (row.place != TrafficPlace::storyboard)
            out.add(2, "repeat: {{count: {}, every_m: {}}}", row.count, row.every_m);
    }
    return out.take();
}

std::string write_drive(const Drive& drive) {
    return fmt::format("# The resolved drive, written by fernlicht {}: running it again gives the same results.\nfernlicht: 1\n{}",
                       FERNLICHT_VERSION, block_text(drive_fields(), &drive, 0));
}

std::string drive_bits(const Drive& drive) { return field_bits(drive_fields(), &drive); }

} // namespace fernlicht
