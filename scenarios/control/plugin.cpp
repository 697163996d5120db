#include "scenarios/control/plugin.h"

#include "scenarios/control/fmu_law.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csetjmp>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace fernlicht {

struct ControlPlugin::Parts {
    PluginParameters parameters;
    std::vector<ControlledLamp> lamps;
    std::vector<bool> may_move;
    void* library = nullptr;
    const fernlicht_control_plugin_info* info = nullptr;
    std::unique_ptr<FmuLaw> fmu; ///< in place of a library with the interface
    std::string name;
    void* state = nullptr;
    bool failed = false; ///< it must not be called any more
    std::uint64_t every = 1, ticks = 0, calls = 0, over_budget = 0, left_out = 0, calls_with_some_left_out = 0;
    bool any_used = false;      ///< a command that changed something
    std::string first_left_out; ///< "lamp.left.swivel_command_rad 2.5 at 0.02 s, which goes from -1.6 to 1.6"
    double slowest_s = 0.0, last_s = 0.0;
    /// Its last commands, that hold between calls.
    std::vector<fernlicht_lamp_command> commands;
    std::vector<std::vector<double>> segments;
    std::vector<std::vector<double>> from_deg, to_deg; ///< by lamp
    std::vector<std::string> names;
    std::vector<const char*> name_pointers;

    [[noreturn]] void refuse(const std::string& found, const std::string& expected = {}) const {
        throw InputError({parameters.library, 0, 0, {}}, found, expected);
    }
    void call(const std::string& what, const std::function<void()>& work) {
        const CallOutcome outcome = guarded_call(work, parameters.give_up_s);
        failed = failed || !outcome.failed.empty();
        if (failed && fmu)
            fmu->abandon();
        if (failed)
            refuse(fmt::format("{} in {}", printable(outcome.failed, 200), what), "a control law that comes back");
        slowest_s = std::max(slowest_s, outcome.seconds);
        over_budget += outcome.seconds > parameters.budget_s ? 1U : 0U;
    }
    void load();
    void close_fmu() {
        if (!guarded_call([&] { fmu->close(); }, parameters.give_up_s).failed.empty())
            fmu->abandon();
    }
    void forget_times() { over_budget = 0, slowest_s = 0.0; } ///< only steps have a budget
    void keep(SignalTable& table, std::vector<std::vector<double>>& all_segments) const;
};

void ControlPlugin::Parts::load() {
    if (parameters.fmu) {
        fmu = std::make_unique<FmuLaw>(parameters, lamps);
        name = printable(fmu->name());
        std::string wrong;
        call("its start", [&] { wrong = fmu->start(); });
        if (!wrong.empty()) {
            close_fmu();
            refuse(wrong, "an FMU that starts");
        }
        return forget_times();
    }
    library = ::dlopen(parameters.library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
        refuse(fmt::format("cannot be loaded: {}", printable(::dlerror(), 200)), "a shared library for this machine");
    using Entry = const fernlicht_control_plugin_info* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(library, "fernlicht_control_plugin"));
    if (!entry)
        refuse("no function fernlicht_control_plugin()", "a library built against fernlicht_control.h");
    call("fernlicht_control_plugin()", [&] { info = entry(); });
    if (!info)
        refuse("fernlicht_control_plugin() returned nothing");
    if (info->version != FERNLICHT_CONTROL_VERSION)
        refuse(fmt::format("version {} of the interface", info->version), fmt::format("version {}", FERNLICHT_CONTROL_VERSION));
    if (info->size < sizeof(fernlicht_control_plugin_info) || !info->step)
        refuse(fmt::format("a description of {} bytes{}", info->size, info->step ? "" : " without step()"),
               fmt::format("at least {} bytes, with step()", sizeof(fernlicht_control_plugin_info)));
    name = printable(info->name ? info->name : parameters.library.filename().string());
    if (info->create)
        call("create()", [&] { state = info->create(parameters.parameters.c_str()); });
    forget_times();
}

ControlPlugin::ControlPlugin(const PluginParameters& parameters, const std::vector<ControlledLamp>& lamps, double control_period_s)
    : parts_(std::make_unique<Parts>()) {
    Parts& p = *parts_;
    p.parameters = parameters;
    p.lamps = lamps;
    p.every = static_cast<std::uint64_t>(std::max(1.0, std::ceil(parameters.period_s / control_period_s - 1.0e-6)));
    for (const ControlledLamp& lamp : lamps) {
        p.may_move.push_back(std::ranges::find(parameters.lamps, lamp.name) != parameters.lamps.end());
        p.from_deg.emplace_back();
        p.to_deg.emplace_back();
        for (const AngleBox& window : lamp.windows) {
            p.from_deg.back().push_back(window.left_deg);
            p.to_deg.back().push_back(window.right_deg);
        }
    }
    p.load();
}

ControlPlugin::ControlPlugin(ControlPlugin&&) noexcept = default;

ControlPlugin::~ControlPlugin() {
    if (!parts_)
        return;
    if (parts_->fmu && !parts_->failed)
        parts_->close_fmu();
    if (!parts_->library)
        return;
    if (parts_->failed)
        return; // its code is in an unknown state: neither called nor unloaded
    if (parts_->info && parts_->info->destroy)
        guarded_call([&] { parts_->info->destroy(parts_->state); }, parts_->parameters.give_up_s);
    ::dlclose(parts_->library);
}

void ControlPlugin::Parts::keep(SignalTable& table, std::vector<std::vector<double>>& all_segments) const {
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (!may_move[i])
            continue;
        table.of(i, lamp_signal::swivel_command) = commands[i].swivel_rad;
        table.of(i, lamp_signal::pitch_command) = commands[i].pitch_rad;
        table.of(i, lamp_signal::level) = commands[i].level;
        all_segments[i] = segments[i];
    }
}

void ControlPlugin::step(SignalTable& table, std::vector<std::vector<double>>& all_segments, const Surroundings& surroundings) {
    Parts& p = *parts_;
    if (p.ticks++ % p.every != 0)
        return p.keep(table, all_segments);

    std::vector<fernlicht_road_point> road;
    for (const RoadPoint& point : surroundings.road)
        road.push_back({point.along_m, point.ahead_m, point.left_m, point.curvature_per_m});
    std::vector<fernlicht_other> others;
    for (const OtherUser& other : surroundings.others)
        others.push_back(
            {other.ahead_m, other.left_m, other.heading_rad, other.speed_mps, other.width_m, other.height_m, other.lamps_on ? 1 : 0});
    if (p.names.empty()) {
        for (std::size_t place = 0; place < table.size(); ++place)
            p.names.push_back(table.name(place));
        for (const std::string& name : p.names)
            p.name_pointers.push_back(name.c_str());
    }
    std::vector<fernlicht_lamp> lamps;
    std::vector<fernlicht_lamp_command> commands;
    std::vector<std::vector<double>> segments = all_segments;
    for (std::size_t i = 0; i < p.lamps.size(); ++i) {
        const ControlledLamp& lamp = p.lamps[i];
        lamps.push_back({lamp.name.c_str(), lamp.position_m.x, lamp.position_m.y, lamp.position_m.z, lamp.yaw_rad,
                         table.of(i, lamp_signal::swivel), table.of(i, lamp_signal::pitch), p.may_move[i] ? 1 : 0, lamp.windows.size(),
                         p.from_deg[i].data(), p.to_deg[i].data()});
        commands.push_back({table.of(i, lamp_signal::swivel_command), table.of(i, lamp_signal::pitch_command),
                            table.of(i, lamp_signal::level), segments[i].data()});
    }
    const std::vector<double> values = table.values(); // a copy: the library may write where it should not
    fernlicht_control_input in{};
    in.size = sizeof in;
    in.time_s = table[signal::time];
    in.dt_s = p.calls > 0 ? in.time_s - p.last_s : 0.0;
    in.ego = {table[signal::ego_distance], table[signal::ego_speed],    table[signal::ego_acceleration],
              table[signal::ego_yaw_rate], table[signal::ego_steering], table[signal::ego_spring_pitch] + table[signal::ego_load_pitch]};
    in.illuminance_lx = table[signal::environment_illuminance];
    in.wetness = table[signal::environment_wetness];
    in.road_count = road.size();
    in.other_count = others.size();
    in.lamp_count = lamps.size();
    in.signal_count = values.size();
    in.road = road.data();
    in.others = others.data();
    in.lamps = lamps.data();
    in.signal_names = p.name_pointers.data();
    in.signal_values = values.data();
    fernlicht_control_output out{sizeof(fernlicht_control_output), commands.size(), commands.data()};
    const std::vector<fernlicht_lamp_command> before = commands;
    int answer = 0;
    std::string wrong;
    p.call(fmt::format("{} of '{}' at {:g} s", p.fmu ? "a step" : "step()", p.name, in.time_s),
           [&] { p.fmu ? void(wrong = p.fmu->step(in, out)) : void(answer = p.info->step(p.state, &in, &out)); });
    if (!wrong.empty())
        p.refuse(fmt::format("'{}' at {:g} s: {}", p.name, in.time_s, wrong), "ok");
    if (answer != 0)
        p.refuse(fmt::format("step() of '{}' failed with {} at {:g} s", p.name, answer, in.time_s), "0");
    p.last_s = in.time_s;
    ++p.calls;

    const bool first = p.commands.empty();
    const std::uint64_t left_out_before = p.left_out;
    const auto take = [&](double& value, double given, double held, const auto& name, double least, double greatest) {
        if (value >= least && value <= greatest) {
            p.any_used = p.any_used || value != given;
            return;
        }
        if (p.left_out++ == 0)
            p.first_left_out = fmt::format("{} {:g} at {:g} s, which goes from {:g} to {:g}", name(), value, in.time_s, least, greatest);
        value = held;
    };
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (!p.may_move[i])
            continue;
        const fernlicht_lamp_command &held = first ? before[i] : p.commands[i], &given = before[i];
        const auto of = [&](const char* command) { return [&, command] { return fmt::format("lamp.{}.{}", p.lamps[i].name, command); }; };
        take(commands[i].swivel_rad, given.swivel_rad, held.swivel_rad, of("swivel_command_rad"), -1.6, 1.6);
        take(commands[i].pitch_rad, given.pitch_rad, held.pitch_rad, of("pitch_command_rad"), -0.3, 0.3);
        take(commands[i].level, given.level, held.level, of("level"), 0.0, 1.0);
        for (std::size_t k = 0; k < segments[i].size(); ++k)
            take(
                segments[i][k], all_segments[i][k], first ? all_segments[i][k] : p.segments[i][k],
                [&] { return fmt::format("lamp.{}.segments[{}]", p.lamps[i].name, k + 1); }, 0.0, 1.0);
    }
    p.calls_with_some_left_out += p.left_out > left_out_before ? 1U : 0U;
    p.commands = std::move(commands);
    p.segments = std::move(segments);
    p.keep(table, all_segments);
}

std::vector<std::string> ControlPlugin::notes() const {
    const Parts& p = *parts_;
    std::vector<std::string> notes{fmt::format("control law '{}': {} calls", p.name, p.calls)};
    if (p.fmu && !p.fmu->unread().empty())
        notes.push_back(fmt::format("control law '{}': outputs that are no commands: {}", p.name, fmt::join(p.fmu->unread(), ", ")));
    if (p.over_budget > 0)
        notes.push_back(
            fmt::format("control law '{}': some calls took longer than their budget of {:g} ms", p.name, 1e3 * p.parameters.budget_s));
    if (p.left_out > 0)
        notes.push_back(fmt::format("control law '{}': {} commands were no numbers or out of range, and left out; the first: {}", p.name,
                                    p.left_out, p.first_left_out));
    return notes;
}

std::optional<InputError> ControlPlugin::unusable() const {
    const Parts& p = *parts_;
    if (p.any_used || 2 * p.calls_with_some_left_out <= p.calls)
        return std::nullopt;
    const InputError::Where& own = p.parameters.places.own;
    return InputError(
        own.file.empty() ? InputError::Where{p.parameters.library, 0, 0, {}} : own,
        fmt::format("control law '{}', none of whose {} commands could be used; the first: {}", p.name, p.left_out, p.first_left_out),
        "numbers inside their ranges");
}

namespace {

constexpr std::array caught{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};

sigjmp_buf way_out;
volatile std::sig_atomic_t inside = 0;
pid_t caller = 0;

/// Only the thread that makes the call jumps; another's crash takes its usual course.
void on_signal(int number) {
    if (inside != 0 && static_cast<pid_t>(::syscall(SYS_gettid)) == caller) {
        inside = 0;
        siglongjmp(way_out, number);
    }
    if (number == SIGALRM)
        return;
    std::signal(number, SIG_DFL);
    std::raise(number);
}

/// exit() cannot be undone; but a run that is not finished must not look like one that is.
void on_exit_inside() {
    if (inside == 0)
        return;
    constexpr std::string_view text = "fernlicht: a control plug-in called exit(), expected it to return\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
    ::_exit(2);
}

std::string word(int number, double give_up_s) {
    for (const auto& [known, text] :
         {std::pair(SIGSEGV, "a segmentation fault"), std::pair(SIGBUS, "a bus error"), std::pair(SIGFPE, "an arithmetic fault"),
          std::pair(SIGILL, "an illegal instruction"), std::pair(SIGABRT, "abort()")})
        if (known == number)
            return text;
    return fmt::format("no return within {:g} s", give_up_s);
}

/// Handlers and their own stack, as long as it lives; what was there before comes back.
class Handlers {
  public:
    Handlers() : stack_(std::size_t{64} << 10) {
        stack_t own{};
        own.ss_sp = stack_.data();
        own.ss_size = stack_.size();
        ::sigaltstack(&own, &old_stack_);
        struct sigaction action {};
        action.sa_handler = on_signal;
        action.sa_flags = SA_ONSTACK | SA_NODEFER;
        for (std::size_t i = 0; i < caught.size(); ++i)
            ::sigaction(caught[i], &action, &old_[i]);
    }
    Handlers(const Handlers&) = delete;
    Handlers& operator=(const Handlers&) = delete;
    ~Handlers() {
        for (std::size_t i = 0; i < caught.size(); ++i)
            ::sigaction(caught[i], &old_[i], nullptr);
        ::sigaltstack(&old_stack_, nullptr);
    }

  private:
    std::vector<char> stack_;
    stack_t old_stack_{};
    std::array<struct sigaction, caught.size()> old_{};
};

/// SIGALRM to this thread after a time.
class Alarm {
  public:
    explicit Alarm(double seconds) {
        sigevent event{};
        event.sigev_notify = SIGEV_THREAD_ID;
        event.sigev_signo = SIGALRM;
        event._sigev_un._tid = caller;
        armed_ = ::timer_create(CLOCK_MONOTONIC, &event, &timer_) == 0;
        itimerspec after{};
        const double whole = std::floor(seconds);
        after.it_value = {static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9) + 1};
        if (armed_)
            ::timer_settime(timer_, 0, &after, nullptr);
    }
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;
    ~Alarm() {
        if (armed_)
            ::timer_delete(timer_);
    }

  private:
    timer_t timer_{};
    bool armed_ = false;
};

/// Exceptions end here, on the callee's side of the jump.
std::string called(const std::function<void()>& call) {
    try {
        call();
        return {};
    } catch (const std::exception& error) {
        return fmt::format("an exception: {}", error.what());
    } catch (...) {
        return "an exception";
    }
}

} // namespace

CallOutcome guarded_call(const std::function<void()>& call, double give_up_s) {
    CallOutcome outcome;
    [[maybe_unused]] static const int registered = std::atexit(on_exit_inside);
    caller = static_cast<pid_t>(::syscall(SYS_gettid));
    const auto start = std::chrono::steady_clock::now();
    {
        const Handlers handlers;
        const Alarm alarm(give_up_s);
        if (const int number = sigsetjmp(way_out, 1); number != 0) {
            outcome.failed = word(number, give_up_s);
        } else {
            inside = 1;
            outcome.failed = called(call);
            inside = 0;
        }
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

} // namespace fernlicht
