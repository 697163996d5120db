#include "scenarios/traffic/road_user.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <mutex>
#include <stdexcept>

namespace fernlicht {
namespace {

struct UsualBody {
    glm::dvec3 size_m;
    double rear_m;
};

// Middle-class vehicles of each kind [estimate].
constexpr std::array bodies{UsualBody{{4.5, 1.8, 1.45}, -0.9}, UsualBody{{5.5, 2.0, 2.4}, -1.1}, UsualBody{{12.0, 2.5, 3.8}, -3.5},
                            UsualBody{{12.0, 2.5, 3.1}, -3.4}, UsualBody{{2.1, 0.8, 1.3}, -0.4}, UsualBody{{1.8, 0.6, 1.6}, -0.35},
                            UsualBody{{0.4, 0.6, 1.75}, -0.2}, UsualBody{{2.0, 2.0, 1.5}, -1.0}};

/// exp(-x^2 ln 2): a half at 1.
double bell(double x) { return std::exp2(-x * x); }

/// The same file for the same intensity as long as somebody holds it: beams are made for each file.
std::shared_ptr<const LampFile> rear_lamp_file(double cd) {
    static std::map<double, std::weak_ptr<const LampFile>> known;
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    if (auto file = known[cd].lock())
        return file;
    static const CandelaTable shape = [] {
        CandelaTable table;
        for (int h = -80; h <= 80; h += 2)
            table.h_deg.push_back(h);
        for (int v = -30; v <= 30; v += 2)
            table.v_deg.push_back(v);
        for (const double v : table.v_deg)
            for (const double h : table.h_deg)
                table.cd.push_back(bell(h / 15.0) * bell(v / 6.0));
        return table;
    }();
    auto file = std::make_shared<LampFile>();
    file->name = "rear lamp";
    file->format = "model";
    file->table = scaled(shape, cd);
    known[cd] = file;
    return file;
}

TrafficLamp rear_lamp(const char* name, LampFunction function, const std::shared_ptr<const LampFile>& file, const glm::dvec3& at_m) {
    TrafficLamp out;
    out.lamp.name = name;
    out.lamp.file = file;
    out.lamp.position_m = at_m;
    out.lamp.yaw_rad = pi;
    out.lamp.source = SourceKind::led;
    out.lamp.colour.linear_srgb = {1.0 / 0.2126, 0.0, 0.0}; // the display's red, of luminance 1
    out.lamp.colour.sp_ratio = 0.1;
    out.lamp.level = function == LampFunction::brake ? 0.0 : 1.0;
    out.function = function;
    out.face_m = {0.12, 0.08};
    return out;
}

} // namespace

MountedLamp RoadUser::lamp_at(const TrafficLamp& mounted, double time_s) const {
    MountedLamp lamp = mounted.lamp;
    for (const LampChange& change : changes)
        if (change.time_s <= time_s && change.lamp == lamp.name)
            apply(change, lamp);
    return lamp;
}

bool RoadUser::visible_at(double time_s) const {
    if (!track || time_s < track->first_s() || time_s > track->last_s())
        return false;
    bool visible = true;
    for (const auto& [from_s, seen] : visibility)
        if (from_s <= time_s)
            visible = seen;
    return visible;
}

glm::dvec3 default_size_m(RoadUserKind kind) { return bodies.at(static_cast<std::size_t>(kind)).size_m; }
double default_rear_m(RoadUserKind kind) { return bodies.at(static_cast<std::size_t>(kind)).rear_m; }

LampFunction function_of(std::string_view name) {
    struct Row {
        std::string_view word;
        LampFunction function;
    };
    static constexpr std::array rows{
        Row{"high", LampFunction::high},       Row{"rear-fog", LampFunction::rear_fog},
        Row{"fog", LampFunction::fog},         Row{"tail", LampFunction::tail},
        Row{"brake", LampFunction::brake},     Row{"position", LampFunction::position},
        Row{"daytime", LampFunction::daytime}, Row{"indicator-left", LampFunction::indicator_left},
        Row{"reverse", LampFunction::reverse}, Row{"indicator-right", LampFunction::indicator_right},
    };
    for (const Row& row : rows)
        if (name.find(row.word) != std::string_view::npos)
            return row.function;
    return LampFunction::low;
}

std::vector<TrafficLamp> rear_lamps(const glm::dvec3& size_m, double rear_m, double tail_cd, double brake_cd) {
    std::vector<TrafficLamp> lamps;
    const double y = 0.5 * size_m.y - 0.15, z = std::min(0.85, 0.6 * size_m.z), x = rear_m - 0.02;
    const bool narrow = size_m.y < 1.0;
    const auto add = [&](double cd, LampFunction function, const char* left, const char* right, double left_m) {
        if (!(cd > 0.0))
            return;
        const auto file = rear_lamp_file(cd);
        lamps.push_back(rear_lamp(left, function, file, {x, narrow ? 0.0 : left_m, z}));
        if (!narrow)
            lamps.push_back(rear_lamp(right, function, file, {x, -left_m, z}));
    };
    add(tail_cd, LampFunction::tail, "tail-left", "tail-right", y);
    add(brake_cd, LampFunction::brake, "brake-left", "brake-right", y - 0.15);
    return lamps;
}

Track::Track(std::vector<TrackPoint> points) : points_(std::move(points)) {
    if (points_.empty())
        throw std::invalid_argument("a track without points");
    for (std::size_t i = 1; i < points_.size(); ++i)
        if (!(points_[i].time_s > points_[i - 1].time_s))
            throw std::invalid_argument("a track whose times do not ascend");
}

TrackPoint Track::at(double time_s) const {
    const auto next = std::ranges::upper_bound(points_, time_s, {}, &TrackPoint::time_s);
    if (next == points_.begin() || next == points_.end()) {
        TrackPoint end = next == points_.begin() ? points_.front() : points_.back();
        if (end.time_s != time_s)
            end.speed_mps = 0.0;
        return end;
    }
    const TrackPoint &a = *(next - 1), &b = *next;
    if (a.time_s == time_s)
        return a;
    const double step = b.time_s - a.time_s, u = (time_s - a.time_s) / step, v = 1.0 - u;
    // Cubic Hermite: with straight, even motion its velocity is the points' own.
    const glm::dvec3 from = a.pose.forward() * (a.speed_mps * step), to = b.pose.forward() * (b.speed_mps * step);
    TrackPoint out;
    out.time_s = time_s;
    out.pose.position_m = a.pose.position_m * (v * v * (1.0 + 2.0 * u)) + from * (u * v * v) +
                          b.pose.position_m * (u * u * (3.0 - 2.0 * u)) - to * (u * u * v);
    out.pose.axes = glm::mat3_cast(glm::normalize(glm::slerp(glm::quat_cast(a.pose.axes), glm::quat_cast(b.pose.axes), u)));
    out.speed_mps = a.speed_mps * v + b.speed_mps * u;
    return out;
}

} // namespace fernlicht
