#include "renderer/device.h"

#include "renderer/gl/device/context.h"
#include "scenarios/values/errors.h"

#include <array>
#include <fmt/format.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace fernlicht {
namespace {

std::unique_ptr<gl::Context> open_named(const std::string& name) {
    if (name == "egl")
        return gl::open_egl_surfaceless();
    if (name == "osmesa")
        return gl::open_osmesa();
    const std::string digits = name.substr(std::string("egl-device=").size());
    return gl::open_egl_device(std::stoi(digits));
}

bool is_known(const std::string& name) {
    constexpr std::string_view device = "egl-device=";
    const std::string_view digits = name.starts_with(device) ? std::string_view(name).substr(device.size()) : "";
    return name == "egl" || name == "osmesa" ||
           (!digits.empty() && digits.size() <= 3 && digits.find_first_not_of("0123456789") == std::string_view::npos);
}

/// What the child says of a backend: "+" and four lines, or "-" and the failure.
std::string tried(const std::string& name) {
    try {
        const DeviceInfo info = open_named(name)->info;
        return "+" + info.gl_version + "\n" + info.gl_renderer + "\n" + info.gl_vendor + (info.software ? "\nsoftware\n" : "\nhardware\n");
    } catch (const DeviceError& error) {
        return std::string("-") + error.what();
    }
}

/// What a process of its own says, and how it ended. A broken driver may crash (OSMesa does where it finds none), one library's context
/// must not meet another's, and NVIDIA's EGL does not work in the child of a process that has looked at it.
struct ChildsAnswer {
    std::string said;
    int status = 0; ///< of waitpid
};

template <class Say> ChildsAnswer ask_child(const Say& say) {
    int ends[2];
    if (::pipe(ends) != 0)
        throw DeviceError("a pipe cannot be made");
    const pid_t child = ::fork();
    if (child < 0)
        throw DeviceError("a process cannot be started");
    if (child == 0) {
        ::close(ends[0]);
        const std::string said = say();
        const ssize_t put = ::write(ends[1], said.data(), said.size());
        ::_exit(put == static_cast<ssize_t>(said.size()) ? 0 : 1);
    }
    ::close(ends[1]);
    ChildsAnswer answer;
    std::array<char, 1024> buffer{};
    for (ssize_t got = 0; (got = ::read(ends[0], buffer.data(), buffer.size())) > 0;)
        answer.said.append(buffer.data(), static_cast<std::size_t>(got));
    ::close(ends[0]);
    ::waitpid(child, &answer.status, 0);
    return answer;
}

BackendAttempt try_in_child(const std::string& name) {
    BackendAttempt attempt{name, false, {}, {}};
    const auto [said, status] = ask_child([&] { return tried(name); });
    if (WIFSIGNALED(status)) {
        attempt.failure = fmt::format("{}: the driver crashes (signal {})", name, WTERMSIG(status));
    } else if (said.starts_with('+')) {
        attempt.works = true;
        attempt.info.backend = name;
        std::istringstream lines(said.substr(1));
        std::string kind;
        for (std::string* const line : {&attempt.info.gl_version, &attempt.info.gl_renderer, &attempt.info.gl_vendor, &kind})
            std::getline(lines, *line);
        attempt.info.software = kind == "software";
    } else {
        attempt.failure = said.empty() ? name + ": the driver ends the process" : said.substr(1);
    }
    return attempt;
}

/// "auto": a GPU, else Mesa without a surface, else OSMesa. "software": the same of what draws on the CPU, EGL's devices in the second
/// place.
std::unique_ptr<gl::Context> open_first(bool software) {
    std::vector<std::string> names{"egl", "osmesa"};
    std::vector<std::string> devices;
    for (const gl::EglDevice& device : gl::list_egl_devices())
        if (device.software == software)
            devices.push_back(fmt::format("egl-device={}", device.index));
    names.insert(names.begin() + (software ? 1 : 0), devices.begin(), devices.end());
    std::string failures;
    for (const std::string& name : names) {
        try {
            std::unique_ptr<gl::Context> context = open_named(name);
            if (!software || context->info.software)
                return context;
            failures += fmt::format("; {}: renders on {}", name, context->info.gl_renderer);
        } catch (const DeviceError& error) {
            failures += fmt::format("; {}", error.what());
        }
    }
    throw DeviceError(fmt::format("nothing here can render{}{}", software ? " on the CPU" : "", ":" + failures.substr(1)));
}

} // namespace

Device::Device(std::unique_ptr<gl::Context> context) : context_(std::move(context)) {}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
const DeviceInfo& Device::info() const { return context_->info; }

Device open_device(const std::string& backend) {
    if (backend == "auto" || backend == "software")
        return Device(open_first(backend == "software"));
    if (!is_known(backend))
        throw InputError({{}, 0, 0, "--backend"}, "found '" + printable(backend) + "'", backend_names);
    return Device(open_named(backend));
}

std::vector<BackendAttempt> try_all_backends() {
    std::vector<std::string> names{"egl"};
    std::istringstream devices(ask_child([] { return std::to_string(gl::list_egl_devices().size()); }).said);
    std::size_t count = 0;
    devices >> count; // none where the child says nothing
    for (std::size_t index = 0; index < count; ++index)
        names.push_back(fmt::format("egl-device={}", index));
    names.emplace_back("osmesa");
    std::vector<BackendAttempt> attempts;
    for (const std::string& name : names)
        attempts.push_back(try_in_child(name));
    return attempts;
}

} // namespace fernlicht
