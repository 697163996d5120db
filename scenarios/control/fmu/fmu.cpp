#include "scenarios/control/fmu/fmu.h"

#include "scenarios/control/fmu/fmi.h"
#include "scenarios/control/fmu/zip_module.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/program_module.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace fernlicht {

/// All that the FMU's code keeps pointers to. Threads of its own may log, too.
struct FmuLog {
    std::mutex mutex;
    std::string last; ///< warning or error
    fmi::v2::Callbacks callbacks{};

    /// Since it was last asked for.
    std::string taken() {
        const std::lock_guard lock(mutex);
        return std::exchange(last, {});
    }
};

namespace {

constexpr std::uint64_t max_unpacked_bytes = std::uint64_t{1} << 30, max_description_bytes = std::uint64_t{16} << 20;
constexpr std::string_view description_name = "modelDescription.xml";
#if defined(__aarch64__)
constexpr std::string_view platform_2 = "aarch64-linux", platform_3 = "aarch64-linux";
#else
constexpr std::string_view platform_2 = "linux64", platform_3 = "x86_64-linux";
#endif

bool climbs_out(const std::string& name) {
    const std::filesystem::path path(name);
    return name.empty() || path.is_absolute() || std::ranges::find(path, "..") != path.end();
}

void keep_log(void* environment, int status, const char* message) {
    if (!environment || !message || status == fmi::ok)
        return;
    FmuLog& log = *static_cast<FmuLog*>(environment);
    const std::lock_guard lock(log.mutex);
    log.last = message;
}

void log_2(fmi::Environment environment, fmi::v2::Text, int status, fmi::v2::Text, fmi::v2::Text message, ...) {
    std::array<char, 512> text{};
    va_list values;
    va_start(values, message);
    if (message)
        std::vsnprintf(text.data(), text.size(), message, values);
    va_end(values);
    keep_log(environment, status, text.data());
}

void log_3(fmi::Environment environment, int status, fmi::v3::Text, fmi::v3::Text message) { keep_log(environment, status, message); }

/// As an address of FMI 2.0.
std::string uri_of(const std::filesystem::path& folder) {
    std::string uri = "file://";
    for (const char c : folder.string()) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::strchr("/-._~", c);
        uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
}

template <class T> T fmu_value(double value) {
    if constexpr (std::is_floating_point_v<T>)
        return static_cast<T>(value);
    else if constexpr (std::is_same_v<T, bool>)
        return std::abs(value) > 0.0;
    else
        return std::isnan(value)                                                ? T{0}
               : value <= static_cast<double>(std::numeric_limits<T>::lowest()) ? std::numeric_limits<T>::lowest()
               : value >= static_cast<double>(std::numeric_limits<T>::max())    ? std::numeric_limits<T>::max()
                                                                                : static_cast<T>(std::nearbyint(value));
}

template <class Call> int by_fmu_type(FmuType type, const Call& call) {
    switch (type) {
    case FmuType::float64:
        return call(double{});
    case FmuType::float32:
        return call(float{});
    case FmuType::int8:
        return call(std::int8_t{});
    case FmuType::uint8:
        return call(std::uint8_t{});
    case FmuType::int16:
        return call(std::int16_t{});
    case FmuType::uint16:
        return call(std::uint16_t{});
    case FmuType::int32:
        return call(std::int32_t{});
    case FmuType::uint32:
        return call(std::uint32_t{});
    case FmuType::int64:
        return call(std::int64_t{});
    case FmuType::uint64:
        return call(std::uint64_t{});
    case FmuType::flag:
        return call(bool{});
    case FmuType::text:
    case FmuType::none:
        break;
    }
    return fmi::error;
}

std::string function_of(const FmuVariable& variable, const std::string& way, int version) {
    return way + (variable.element != "Enumeration" ? variable.element : version == 2 ? "Integer" : "Int64");
}

} // namespace

Fmu::Folder::Folder() {
    std::error_code none;
    std::string name = (std::filesystem::temp_directory_path(none) / "fernlicht-fmu-XXXXXX").string();
    if (none || !::mkdtemp(name.data()))
        throw DeviceError(name + ": cannot be made, to unpack an FMU");
    path = name;
}

Fmu::Folder::~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

Fmu::Fmu(const std::filesystem::path& file) : file_(file), log_(std::make_unique<FmuLog>()) {
    std::string xml;
    std::vector<std::string> platforms;
    unpack(xml, platforms);
    if (xml.empty())
        refuse(fmt::format("no {}", description_name), "an FMU");
    description_ = read_fmu_description(file_ / description_name, xml);
    load(platforms);
}

Fmu::~Fmu() {
    if (library_ && (abandoned_ || worst_ == fmi::fatal)) {
        // NOLINTNEXTLINE(bugprone-unhandled-exception-at-new): out of memory ends the program here
        static auto& left = *new std::vector<std::unique_ptr<FmuLog>>; // as long as the libraries, to the very end
        left.push_back(std::move(log_));
    } else if (library_) {
        ::dlclose(library_);
    }
}

void Fmu::refuse(const std::string& found, const std::string& expected) const { throw InputError({file_, 0, 0, {}}, found, expected); }

void Fmu::unpack(std::string& xml, std::vector<std::string>& platforms) {
    static const auto read_zip = reinterpret_cast<ReadZip*>(module_function("fernlicht-zip", "fernlicht_read_zip"));
    std::uint64_t unpacked = 0;
    std::string entry;
    bool described = false;
    std::ofstream out;
    const auto refuse_second = [&] {
        refuse(fmt::format("an entry '{}' that cannot lie beside the others", printable(entry)),
               "names of their own, that a folder can hold");
    };
    const auto check_written = [&] {
        if (!out)
            throw DeviceError(fmt::format("{}: '{}' cannot be unpacked into {}", file_.string(), printable(entry), folder_.path.string()));
    };
    const auto open = [&] {
        const std::filesystem::path path = folder_.path / entry;
        std::error_code failed;
        std::filesystem::create_directories(path.parent_path(), failed);
        if ((!failed && std::filesystem::exists(path, failed)) || failed == std::errc::not_a_directory ||
            failed == std::errc::file_exists || failed == std::errc::filename_too_long)
            refuse_second();
        out = std::ofstream(path, std::ios::binary);
        check_written();
    };
    ZipReader reader;
    reader.wants = [&](const std::string& name, std::uint64_t bytes) {
        if (climbs_out(name))
            refuse(fmt::format("an entry '{}', which climbs out of the archive", printable(name)), "entries below it");
        const std::size_t slash = name.starts_with("binaries/") ? name.find('/', 9) : std::string::npos;
        const std::string platform = slash == std::string::npos ? "" : name.substr(9, slash - 9);
        if (!platform.empty() && std::ranges::find(platforms, platform) == platforms.end())
            platforms.push_back(platform);
        if (name.ends_with('/') ||
            (name != description_name && platform != platform_2 && platform != platform_3 && !name.starts_with("resources/")))
            return false;
        unpacked += std::min(bytes, max_unpacked_bytes + 1);
        if (unpacked > max_unpacked_bytes)
            refuse(fmt::format("more than {} MiB when unpacked", max_unpacked_bytes >> 20U), "less");
        entry = name;
        if (name != description_name)
            open();
        else if (bytes > max_description_bytes)
            refuse(fmt::format("a {} of more than {} MiB", description_name, max_description_bytes >> 20U), "less");
        else if (std::exchange(described, true))
            refuse_second();
        return true;
    };
    reader.take = [&](std::string_view piece) {
        if (entry == description_name) {
            xml += piece;
            return;
        }
        out.write(piece.data(), static_cast<std::streamsize>(piece.size())).flush();
        check_written();
    };
    try {
        read_zip(file_.string(), reader);
    } catch (const std::invalid_argument& error) {
        refuse(printable(error.what(), 200), "a zip archive, as FMUs are");
    }
}

void Fmu::load(const std::vector<std::string>& platforms) {
    const bool is_2 = description_.version == 2;
    const std::string name = fmt::format("binaries/{}/{}.so", is_2 ? platform_2 : platform_3, description_.model);
    const std::filesystem::path path = folder_.path / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        refuse(platforms.empty()
                   ? "no binaries"
                   : fmt::format("no {}; binaries for {}", name, printable(fmt::format("{}", fmt::join(platforms, ", ")), 200)),
               name);
    std::filesystem::create_directories(folder_.path / "resources", ignored);
    library_ = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library_) {
        std::string reason = ::dlerror();
        for (std::size_t at = 0; (at = reason.find(folder_.path.string() + '/')) != std::string::npos;)
            reason.erase(at, folder_.path.string().size() + 1);
        refuse(fmt::format("cannot be loaded: {}", printable(reason, 200)), "a shared library for this machine");
    }
    for (const char* const function : {"EnterInitializationMode", "ExitInitializationMode", "DoStep", "Terminate", "FreeInstance"})
        find(function);
    find(is_2 ? "Instantiate" : "InstantiateCoSimulation");
    if (is_2)
        find("SetupExperiment");
}

void Fmu::find(const std::string& function) {
    const std::string name = fmt::format("fmi{}{}", description_.version, function);
    void* const found = ::dlsym(library_, name.c_str());
    if (!found)
        refuse(fmt::format("no function {}() in {}.so", name, description_.model),
               fmt::format("a binary of FMI {}.0", description_.version));
    functions_[function] = found;
}

void Fmu::want(const FmuVariable& variable, const std::string& way) {
    if (variable.type == FmuType::none || (variable.type == FmuType::text && way == "Get"))
        refuse(fmt::format("variable '{}' of type {}", printable(variable.name), variable.element), "a number");
    find(function_of(variable, way, description_.version));
}

std::string Fmu::said(const std::string& function, int status) {
    static constexpr std::array<std::string_view, 6> words{"ok", "warning", "discard", "error", "fatal", "pending"};
    worst_ = std::max(worst_, status);
    const std::string logged = log_->taken();
    if (status == fmi::ok || status == fmi::warning)
        return {};
    return fmt::format("fmi{}{}() returned {}{}{}", description_.version, function,
                       status > 0 && status < 6 ? words[static_cast<std::size_t>(status)] : fmt::format("{}", status),
                       logged.empty() ? "" : ": ", printable(logged, 200));
}

std::string Fmu::instantiate() {
    const char* const name = description_.model.c_str();
    const char* const token = description_.token.c_str();
    const std::filesystem::path resources = folder_.path / "resources";
    if (description_.version == 2) {
        log_->callbacks = {log_2, std::calloc, std::free, nullptr, log_.get()};
        instance_ = function<fmi::v2::Instantiate>("Instantiate")(name, fmi::v2::co_simulation, token, uri_of(resources).c_str(),
                                                                  &log_->callbacks, 0, 1);
    } else {
        instance_ = function<fmi::v3::Instantiate>("InstantiateCoSimulation")(name, token, (resources.string() + '/').c_str(), false, true,
                                                                              false, false, nullptr, 0, log_.get(), log_3, nullptr);
    }
    const std::string logged = log_->taken();
    if (instance_)
        return {};
    return fmt::format("no instance for {} '{}'{}{}", description_.version == 2 ? "guid" : "instantiationToken",
                       printable(description_.token), logged.empty() ? "" : ": ", printable(logged, 200));
}

std::string Fmu::initialize() {
    if (description_.version == 3)
        return said("EnterInitializationMode",
                    function<fmi::v3::EnterInitialization>("EnterInitializationMode")(instance_, false, 0.0, 0.0, false, 0.0));
    if (std::string wrong = said("SetupExperiment", function<fmi::v2::SetupExperiment>("SetupExperiment")(instance_, 0, 0.0, 0.0, 0, 0.0));
        !wrong.empty())
        return wrong;
    return said("EnterInitializationMode", function<fmi::Plain>("EnterInitializationMode")(instance_));
}

std::string Fmu::begin() {
    begun_ = true;
    return said("ExitInitializationMode", function<fmi::Plain>("ExitInitializationMode")(instance_));
}

std::string Fmu::step(double at_s, double step_s) {
    if (description_.version == 2)
        return said("DoStep", function<fmi::v2::DoStep>("DoStep")(instance_, at_s, step_s, 1));
    bool event = false, ends = false, early = false;
    double until_s = at_s;
    if (std::string wrong =
            said("DoStep", function<fmi::v3::DoStep>("DoStep")(instance_, at_s, step_s, true, &event, &ends, &early, &until_s));
        !wrong.empty())
        return wrong;
    return ends || early ? fmt::format("fmi3DoStep() {} at {:g} s", ends ? "asks for the end" : "returned early", until_s) : "";
}

void Fmu::close() {
    if (!instance_ || abandoned_ || worst_ == fmi::fatal)
        return;
    if (begun_ && worst_ < fmi::discard)
        function<fmi::Plain>("Terminate")(instance_);
    function<void(fmi::Instance)>("FreeInstance")(instance_);
    instance_ = nullptr;
}

bool Fmu::holds(const FmuVariable& variable, double value) {
    if (variable.element == "Boolean")
        return value == 0.0 || value == 1.0;
    return by_fmu_type(variable.type, [&]<class T>(T) -> int {
               constexpr auto max = static_cast<double>(std::numeric_limits<T>::max());
               if constexpr (std::is_floating_point_v<T>)
                   return std::abs(value) <= max;
               else // in doubles the greatest of 64 bits is rounded up
                   return value == std::floor(value) && value >= static_cast<double>(std::numeric_limits<T>::lowest()) && value < max + 1.0;
           }) == 1;
}

std::string Fmu::set(const FmuVariable& variable, std::span<const double> values) {
    const std::string name = function_of(variable, "Set", description_.version);
    return said(name, by_fmu_type(variable.type, [&]<class T>(T) {
                    const auto raw = std::make_unique<T[]>(values.size());
                    std::ranges::transform(values, raw.get(), [&](double value) {
                        return variable.element == "Boolean" ? T(fmu_value<bool>(value)) : fmu_value<T>(value);
                    });
                    return description_.version == 2
                               ? function<fmi::v2::Set<T>>(name)(instance_, &variable.reference, 1, raw.get())
                               : function<fmi::v3::Set<T>>(name)(instance_, &variable.reference, 1, raw.get(), values.size());
                }));
}

std::string Fmu::set_text(const FmuVariable& variable, const std::string& text) {
    const char* const value = text.c_str();
    const std::string name = function_of(variable, "Set", description_.version);
    return said(name, description_.version == 2 ? function<fmi::v2::Set<const char*>>(name)(instance_, &variable.reference, 1, &value)
                                                : function<fmi::v3::Set<const char*>>(name)(instance_, &variable.reference, 1, &value, 1));
}

std::string Fmu::get(const FmuVariable& variable, std::span<double> values) {
    const std::string name = function_of(variable, "Get", description_.version);
    return said(name, by_fmu_type(variable.type, [&]<class T>(T) {
                    const auto raw = std::make_unique<T[]>(values.size());
                    const int status = description_.version == 2
                                           ? function<fmi::v2::Get<T>>(name)(instance_, &variable.reference, 1, raw.get())
                                           : function<fmi::v3::Get<T>>(name)(instance_, &variable.reference, 1, raw.get(), values.size());
                    std::ranges::transform(std::span(raw.get(), values.size()), values.begin(),
                                           [](T value) { return static_cast<double>(value); });
                    return status;
                }));
}

} // namespace fernlicht
