#include "scenarios/drives/play/drive_log.h"

#include "scenarios/drives/play/bus_play.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <string_view>

namespace fernlicht {
namespace {

constexpr std::array<const char*, 4> logged{"ego", "lamp", "body", "light"};
constexpr std::size_t numbers = 14; ///< place, axes, speed, factor
constexpr double farthest_from_origin_m = 1.0e7, axes_within = 1.0e-6;
constexpr std::size_t fields = 20; ///< the last is a name with all its commas

void log_row(const std::string& start, DriveLog::Kind kind, const std::string& name, const Pose& pose, double speed, double factor,
             bool visible, std::string& out) {
    const glm::dvec3& p = pose.position_m;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{}", start, logged[static_cast<std::size_t>(kind)], p.x, p.y, p.z);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            fmt::format_to(std::back_inserter(out), ",{}", pose.axes[column][row]);
    fmt::format_to(std::back_inserter(out), ",{},{},{},", speed, factor, visible ? 1 : 0);
    for (const char c : name) // the last field: commas may stand in it
        out += c == '\n' || c == '\r' ? ' ' : c;
    out += '\n';
}

std::string field_text(const std::string& text) {
    std::string out = text;
    for (char& c : out)
        if (c == ',' || c == '\n')
            c = ' ';
    return out;
}

std::array<std::string_view, fields> split(std::string_view line, std::size_t& found) {
    std::array<std::string_view, fields> out;
    for (found = 0; found + 1 < fields; ++found) {
        const std::size_t comma = line.find(',');
        if (comma == std::string_view::npos)
            break;
        out[found] = line.substr(0, comma);
        line.remove_prefix(comma + 1);
    }
    out[found++] = line;
    return out;
}

struct Reader {
    DriveLog& log;

    [[noreturn]] void refuse(std::size_t line, const std::string& found, const std::string& expected) const {
        throw InputError({log.file, line, 0, {}}, found, expected);
    }
    double number(std::string_view text, std::size_t line) const {
        const auto value = to_number(text);
        if (!value)
            refuse(line, fmt::format("found '{}'", printable(std::string(text))), "a number");
        return *value;
    }
    int tick(std::string_view text, std::size_t line) const {
        const double value = number(text, line);
        if (!(value >= 0.0 && value <= std::numeric_limits<int>::max()) || value != std::floor(value))
            refuse(line, fmt::format("found tick {}", printable(std::string(text))), "a whole number from 0 on");
        return static_cast<int>(value);
    }
    void row(std::string_view text, std::size_t line) const {
        std::size_t found = 0;
        const auto field = split(text, found);
        if (found != fields)
            refuse(line, fmt::format("found {} fields", found), fmt::format("{}: {}", fields, drive_log_header));
        DriveLog::Row out;
        std::size_t kind = 0;
        while (kind < logged.size() && field[3] != logged[kind])
            ++kind;
        if (kind == logged.size())
            refuse(line, fmt::format("found '{}'", printable(std::string(field[3]))), "ego, lamp, body or light");
        out.kind = static_cast<DriveLog::Kind>(kind);
        std::array<double, numbers> value{};
        for (std::size_t i = 0; i < numbers; ++i)
            value[i] = number(field[4 + i], line);
        out.pose.position_m = {value[0], value[1], value[2]};
        for (int column = 0; column < 3; ++column)
            for (int r = 0; r < 3; ++r)
                out.pose.axes[column][r] = value[static_cast<std::size_t>(3 + 3 * column + r)];
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(out.pose.position_m[axis]) <= farthest_from_origin_m))
                refuse(line, fmt::format("found a place of {:g} m", out.pose.position_m[axis]),
                       fmt::format("at most {:g} m", farthest_from_origin_m));
            for (int other = axis; other < 3; ++other)
                if (!(std::abs(glm::dot(out.pose.axes[axis], out.pose.axes[other]) - (axis == other ? 1.0 : 0.0)) <= axes_within))
                    refuse(line, "found axes that are not of length 1 and square to one another", "forward, left and up of a pose");
        }
        out.speed_mps = value[12];
        out.factor = value[13];
        out.visible = field[18] == "1";
        out.name = std::string(field[19]);
        log.rows[{std::string(field[0]), tick(field[1], line)}].push_back(std::move(out));
    }
};

/// Takes the rows of one kind in order.
class Taking {
  public:
    Taking(const DriveLog& log, const std::vector<DriveLog::Row>& rows, int tick) : log_(log), rows_(rows), tick_(tick) {}

    const DriveLog::Row& next(DriveLog::Kind kind, const std::string& name) {
        std::size_t& at = at_[static_cast<std::size_t>(kind)];
        while (at < rows_.size() && rows_[at].kind != kind)
            ++at;
        if (at == rows_.size() || rows_[at].name != name)
            throw InputError(
                {log_.file, 0, 0, {}},
                fmt::format("tick {} has {}", tick_, at == rows_.size() ? "no more rows" : fmt::format("'{}'", printable(rows_[at].name))),
                fmt::format("{} '{}', as this drive has it", logged[static_cast<std::size_t>(kind)], printable(name)));
        return rows_[at++];
    }

  private:
    const DriveLog& log_;
    const std::vector<DriveLog::Row>& rows_;
    int tick_;
    std::array<std::size_t, logged.size()> at_{};
};

} // namespace

const char* const drive_log_header = "lamp_set,tick,time_s,kind,x_m,y_m,z_m,forward_x,forward_y,forward_z,left_x,left_y,left_z,up_x,"
                                     "up_y,up_z,speed_mps,factor,visible,name";

std::string logged_moment(const std::string& lamp_set, const Moment& moment) {
    std::string out;
    const std::string start = fmt::format("{},{},{}", field_text(lamp_set), moment.tick, moment.time_s);
    log_row(start, DriveLog::Kind::ego, "ego", moment.ego, moment.speed_mps, 0.0, true, out);
    for (const LitLamp& lamp : moment.lamps)
        log_row(start, DriveLog::Kind::lamp, lamp.name, lamp.pose, 0.0, lamp.intensity_factor, true, out);
    for (const Body& body : moment.bodies)
        if (!body.own)
            log_row(start, DriveLog::Kind::body, body.name, body.pose, body.speed_mps, 0.0, body.visible, out);
    for (const LitLamp& lamp : moment.other_lamps)
        if (lamp.body >= 0)
            log_row(start, DriveLog::Kind::light, lamp.name, lamp.pose, 0.0, lamp.intensity_factor, true, out);
    return out;
}

DriveLog read_drive_log(const std::filesystem::path& path, FilesRead& opened) {
    DriveLog log;
    log.file = path;
    const std::string text = read_file(path, opened, std::size_t{1} << 30);
    const Reader reader{log};
    std::size_t line = 0;
    for (std::size_t at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view row = std::string_view(text).substr(at, end - at);
        at = end + 1;
        if (line == 0 && row != drive_log_header)
            reader.refuse(1, fmt::format("found '{}'", printable(std::string(row))),
                          fmt::format("{}{}", drive_log_header,
                                      row.starts_with("variant,") ? "; `fernlicht migrate --in-place` writes logs of version 0.1 so" : ""));
        if (line > 0 && !row.empty())
            reader.row(row, line + 1);
    }
    if (log.rows.empty())
        reader.refuse(0, "no rows", "the log of a drive");
    return log;
}

void replay(const DriveLog& log, const std::string& lamp_set, Moment& moment) {
    const auto found = log.rows.find({field_text(lamp_set), moment.tick});
    if (found == log.rows.end())
        throw InputError({log.file, 0, 0, {}}, fmt::format("no tick {} of lamp set '{}'", moment.tick, printable(lamp_set)),
                         "a log of the whole drive, or --frames as it was played");
    Taking rows(log, found->second, moment.tick);
    const DriveLog::Row& ego = rows.next(DriveLog::Kind::ego, "ego");
    moment.ego = ego.pose;
    moment.speed_mps = ego.speed_mps;
    for (LitLamp& lamp : moment.lamps) {
        const DriveLog::Row& row = rows.next(DriveLog::Kind::lamp, lamp.name);
        lamp.pose = row.pose;
        lamp.intensity_factor = row.factor;
    }
    for (Body& body : moment.bodies) {
        const DriveLog::Row& row = rows.next(DriveLog::Kind::body, body.name);
        body.pose = row.pose;
        body.speed_mps = row.speed_mps;
        body.visible = row.visible;
    }
    for (LitLamp& lamp : moment.other_lamps) {
        if (lamp.body < 0)
            continue;
        const DriveLog::Row& row = rows.next(DriveLog::Kind::light, lamp.name);
        lamp.pose = row.pose;
        lamp.intensity_factor = row.factor;
    }
}

std::string signals_csv(const Drive& drive, const ControlRun& run, int first, int last) {
    std::string text = "frame";
    const std::vector<BusInput> no_inputs;
    const std::vector<BusInput>& inputs = drive.bus ? drive.can->inputs : no_inputs;
    for (const std::string& name : run.signals)
        text += "," + name;
    for (const BusInput& input : inputs)
        text += fmt::format(",{0}.state,{0}.age_s", input.name);
    text += '\n';
    for (int tick = std::max(first, 0); tick <= last && static_cast<std::size_t>(tick) < run.rows.size(); ++tick) {
        text += fmt::format("{}", tick);
        for (const double value : run.rows[static_cast<std::size_t>(tick)])
            text += std::isnan(value) ? "," : fmt::format(",{}", value);
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const BusValue& value = drive.bus->at(tick * drive.step_s)[i];
            text += fmt::format(",{},{}", name_of(value.state), value.age_s);
        }
        text += '\n';
    }
    return text;
}

} // namespace fernlicht
