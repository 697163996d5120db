// An FMU for co-simulation, unpacked and loaded, called in the order that FMI 2.0 and 3.0 ask for.
#pragma once

#include "scenarios/control/fmu/fmu_description.h"

#include <map>
#include <memory>
#include <span>

namespace fernlicht {

struct FmuLog;

class Fmu {
  public:
    /// Unpacks what this machine needs of `file` into a folder of its own, which goes with it, and loads the library. Throws InputError
    /// naming the file: no zip, one whose entries climb out of it, share a name or unpack to more than 1 GiB (the description: 16 MiB), no
    /// or a wrong description (read_fmu_description), no binary for this machine, one that cannot be loaded; DeviceError where there is no
    /// room.
    explicit Fmu(const std::filesystem::path& file);
    Fmu(const Fmu&) = delete;
    Fmu& operator=(const Fmu&) = delete;
    ~Fmu();

    const FmuDescription& description() const { return description_; }
    /// Looks for the functions that set or get values of its type; InputError where they are missing, or the type is none of numbers (for
    /// `set` one of text, too).
    void will_set(const FmuVariable& variable) { want(variable, "Set"); }
    void will_get(const FmuVariable& variable) { want(variable, "Get"); }

    // The calls, in this order, each with "" or what went wrong: "fmi2DoStep() returned discard: <what the FMU logged>". Start values are
    // set before `initialize`, which stays in the mode that the first inputs are set in, until `begin`. They run code of others.
    std::string instantiate();
    std::string initialize(); ///< at 0 s
    std::string begin();
    std::string step(double at_s, double step_s); ///< to at_s + step_s
    void close();                                 ///< the instance; nothing else is called afterwards

    /// Whether the variable's type can hold this number as it is.
    static bool holds(const FmuVariable& variable, double value);
    /// As many numbers as the variable has. Whole numbers are rounded and cut to their type's range; one that is none is 0, or false.
    std::string set(const FmuVariable& variable, std::span<const double> values);
    std::string set_text(const FmuVariable& variable, const std::string& text);
    std::string get(const FmuVariable& variable, std::span<double> values);

    /// Its code has crashed: it is neither called nor unloaded any more.
    void abandon() { abandoned_ = true; }

  private:
    class Folder {
      public:
        Folder();
        Folder(const Folder&) = delete;
        Folder& operator=(const Folder&) = delete;
        ~Folder();
        std::filesystem::path path;
    };
    void unpack(std::string& xml, std::vector<std::string>& platforms);
    void load(const std::vector<std::string>& platforms);
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
    void find(const std::string& function);
    void want(const FmuVariable& variable, const std::string& way);
    template <class F> F* function(const std::string& name) const { return reinterpret_cast<F*>(functions_.at(name)); }
    std::string said(const std::string& function, int status);

    std::filesystem::path file_;
    Folder folder_;
    FmuDescription description_;
    void* library_ = nullptr;
    void* instance_ = nullptr;
    std::map<std::string, void*> functions_;
    std::unique_ptr<FmuLog> log_;
    int worst_ = 0;
    bool abandoned_ = false, begun_ = false;
};

} // namespace fernlicht
