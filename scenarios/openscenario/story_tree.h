// The storyboard's tree while it is played: states of stories, acts, maneuver groups, maneuvers, events and actions.
#pragma once

#include "scenarios/openscenario/osc_actions.h"
#include "scenarios/openscenario/osc_judge.h"

#include <memory>

namespace fernlicht::osc {

enum class Level { storyboard, story, act, group, maneuver, event, action };
enum class ElementState { init, standby, running, complete };

struct Element {
    Level level = Level::storyboard;
    std::string path; ///< the names from the story down, "::" between
    Element* parent = nullptr;
    std::vector<std::unique_ptr<Element>> children;
    ElementState state = ElementState::init;
    int executions = 0, max_executions = -1; ///< groups and events only
    std::optional<JudgedTrigger> start, stop;
    ElementChanges changes;
    const Act* act = nullptr;
    const Event* event = nullptr;
    const Action* action = nullptr;
    const ManeuverGroup* group = nullptr;
    struct Run {
        RunningAction action;
        bool over = false;
    };
    std::vector<Run> runs; ///< of an action that runs: one for each actor
};

/// As OpenSCENARIO XML 1.3, 8.3 has the states; per tick triggers are judged from the root down, then running actions go on in order.
class StoryTree {
  public:
    StoryTree(const Storyboard& storyboard, World& world, PlayedStory& played);

    void start(); ///< init actions and the stories
    /// Judges triggers, then steps all running actions. What entities' actions moved is added to `moved`, one for each entity.
    void step(double dt_s, std::vector<unsigned>& moved);
    bool stopped() const { return root_.state == ElementState::complete; }
    bool all_over() const; ///< there are stories, and each is complete

  private:
    static Element& add(Element& parent, Level level, const std::string& name);
    void build();
    void build_triggers();
    std::vector<const ElementChanges*> find(const ElementStateCondition& condition) const;

    void set(Element& element, ElementState state, const char* transition);
    void start(Element& element);
    void start_event(Element& element);
    void start_action(Element& element, const std::vector<std::size_t>& actors);
    void judge(Element& element);
    void step(Element& element, double dt_s, std::vector<unsigned>& moved);
    void stop(Element& element);
    void end(Element& element);
    void propagate(Element& element);
    static void reset(Element& element);
    void begin_init(const InitAction& init);
    void run(RunningAction& run, const Action& action);
    bool step_run(RunningAction& run, const Action& action, double dt_s, std::vector<unsigned>& moved);
    void act_on_world(const Action& action);
    void end_conflicting(const RunningAction& fresh, const Element* of);

    const Storyboard* storyboard_;
    World* world_;
    PlayedStory* played_;
    Element root_;
    std::vector<Element*> actions_; ///< all of the tree
    struct InitRun {
        const Action* action;
        Element::Run run;
    };
    std::vector<InitRun> init_;
};

} // namespace fernlicht::osc
