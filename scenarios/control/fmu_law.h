// An FMU as a control law: its inputs and outputs matched by name with what plug-ins are handed and may change (fernlicht_control.h).
#pragma once

#include "scenarios/control/fernlicht_control.h"
#include "scenarios/control/fmu/fmu.h"
#include "scenarios/control/lamp_controller.h"

#include <functional>

namespace fernlicht {

class FmuLaw {
  public:
    /// Throws as Fmu does, and InputError for an input, a parameter or a mapping that nothing fits, and where no output is a command.
    FmuLaw(const PluginParameters& parameters, const std::vector<ControlledLamp>& lamps);

    const std::string& name() const { return fmu_.description().name; }
    const std::vector<std::string>& unread() const { return unread_; } ///< outputs that are no commands of lamps that it may move

    // These call it, each with "" or what went wrong.
    std::string start();
    /// The first call ends its initialization; each further one sets the inputs and steps from the last call's time to this one's. Then its
    /// outputs are commands.
    std::string step(const fernlicht_control_input& in, fernlicht_control_output& out);
    void close() { fmu_.close(); }
    void abandon() { fmu_.abandon(); }

  private:
    using Read = std::function<double(const fernlicht_control_input&)>;
    using Write = std::function<void(fernlicht_control_output&, double)>;
    template <class Each> struct Port {
        FmuVariable variable;
        std::vector<Each> values; ///< one each; what is not matched is nullptr
    };
    void match_input(const FmuVariable& variable, const std::string& name, const SignalTable& table);
    bool match_output(const FmuVariable& variable, const std::string& name, const std::vector<ControlledLamp>& lamps,
                      const std::vector<std::string>& may_move);
    void check_unit(const char* key, const FmuVariable& variable, const std::string& signal, std::string_view ours) const;
    void take_parameters(const PluginParameters& parameters);
    [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected) const;

    std::filesystem::path file_;
    PluginPlaces places_;
    Fmu fmu_;
    std::vector<Port<Read>> inputs_;
    std::vector<Port<Write>> outputs_;
    std::vector<std::pair<FmuVariable, std::string>> texts_; ///< start values
    std::vector<std::pair<FmuVariable, double>> numbers_;
    std::vector<std::string> unread_;
    std::vector<double> values_; ///< of one variable while it is told; a member, since a crash in the FMU leaves a step without its ends
    bool started_ = false;
};

/// What becomes of an input, output or parameter of an FMU, in words: "reads ego.speed_mps".
struct FmuTie {
    FmuVariable variable;
    std::string tie;
};
/// Of all of them, in the FMU's order, by its own names and the law's maps. Whether lamps and units fit is for FmuLaw to say. Throws as Fmu
/// does.
std::vector<FmuTie> fmu_ties(const PluginParameters& parameters);

} // namespace fernlicht
