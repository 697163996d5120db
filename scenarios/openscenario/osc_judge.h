// Conditions and triggers over time: edges, delays, rules.
#pragma once

#include "scenarios/openscenario/osc_world.h"

#include <functional>

namespace fernlicht::osc {

/// States that a storyboard element went to, in order; conditions read on from where they last looked.
struct ElementChange {
    std::string state, transition; ///< "runningState", "startTransition"
};
using ElementChanges = std::vector<ElementChange>;
/// The changes of the element that a condition names. Throws InputError where there is none.
using FindElement = std::function<std::vector<const ElementChanges*>(const ElementStateCondition&)>;

class JudgedTrigger {
  public:
    JudgedTrigger() = default;
    JudgedTrigger(const Trigger& trigger, const FindElement& find);

    /// At world.time_s. A group is judged from its first condition on; behind one that is false only those with a delay are looked at.
    bool judge(const World& world);
    void reset(); ///< before another execution: delays begin anew
    /// Entities that made conditions by entity true when it was last judged true.
    const std::vector<std::size_t>& triggered_by() const { return triggered_by_; }

  private:
    struct Judged {
        const TimedCondition* condition;
        std::vector<const ElementChanges*> elements; ///< ElementStateCondition
        std::vector<std::size_t> seen;
        std::string last_state;
        bool evaluated = false, last = false;
        std::vector<std::pair<double, bool>> history; ///< values with the time they began
        std::size_t past = 0;                         ///< of the history, looked at already
    };
    bool value(Judged& judged, const World& world);
    bool by_entity(const ByEntity& condition, const World& world);
    static bool state_is(Judged& judged, const ElementStateCondition& condition);
    bool delayed(Judged& judged, bool value, double time_s);

    std::vector<std::vector<Judged>> groups_;
    std::vector<std::size_t> triggered_by_;
};

bool holds(double a, double b, Rule rule); ///< equal within 1e-6
/// Seconds since 1970 of an ISO 8601 date and time, its offset from UTC taken; nullopt for other text.
std::optional<double> seconds_of(const std::string& date_time);

} // namespace fernlicht::osc
