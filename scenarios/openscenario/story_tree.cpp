#include "scenarios/openscenario/story_tree.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

const char* word(ElementState state) {
    static constexpr const char* words[] = {"initState", "standbyState", "runningState", "completeState"};
    return words[static_cast<int>(state)];
}

bool running(const Element& element) { return element.state == ElementState::running; }
bool complete(const Element& element) { return element.state == ElementState::complete; }

std::optional<Level> level_of(const std::string& type) {
    static constexpr std::pair<std::string_view, Level> known[] = {{"story", Level::story},         {"act", Level::act},
                                                                   {"maneuverGroup", Level::group}, {"maneuver", Level::maneuver},
                                                                   {"event", Level::event},         {"action", Level::action}};
    for (const auto& [name, level] : known)
        if (name == type)
            return level;
    return {};
}

template <class Visit> void walk(Element& element, const Visit& visit) {
    visit(element);
    for (const auto& child : element.children)
        walk(*child, visit);
}

/// "" for an action of the world as a whole.
const std::string& entity_of(const InitAction& init) {
    const auto* global = std::get_if<GlobalAction>(&init.action.what);
    const auto* added = global ? std::get_if<EntityAction>(global) : nullptr;
    return added ? added->entity : init.entity;
}

[[noreturn]] void refuse_waiting(const std::filesystem::path& file, const InitAction& init,
                                 const std::map<std::string, std::string>& waits_for) {
    std::vector<std::string> way{entity_of(init)};
    while (waits_for.contains(way.back()) && std::ranges::count(way, way.back()) == 1)
        way.push_back(waits_for.at(way.back()));
    std::string names;
    for (const std::string& name : way)
        names += fmt::format("{}'{}'", names.empty() ? "" : " > ", printable(name));
    throw InputError({file, init.action.line, 0, init.action.name}, "needs the place of an entity that has none: " + names,
                     "an entity that Init places without it");
}

} // namespace

StoryTree::StoryTree(const Storyboard& storyboard, World& world, PlayedStory& played)
    : storyboard_(&storyboard), world_(&world), played_(&played) {
    build();
    build_triggers();
}

Element& StoryTree::add(Element& parent, Level level, const std::string& name) {
    Element& child = *parent.children.emplace_back(std::make_unique<Element>());
    child.level = level;
    child.path = parent.path.empty() ? name : parent.path + "::" + name;
    child.parent = &parent;
    return child;
}

void StoryTree::build() {
    for (const Story& story : storyboard_->stories) {
        Element& in_story = add(root_, Level::story, story.name);
        for (const Act& act : story.acts) {
            Element& in_act = add(in_story, Level::act, act.name);
            in_act.act = &act;
            for (const ManeuverGroup& group : act.groups) {
                Element& in_group = add(in_act, Level::group, group.name);
                in_group.group = &group;
                in_group.max_executions = group.executions;
                for (const Maneuver& maneuver : group.maneuvers) {
                    Element& in_maneuver = add(in_group, Level::maneuver, maneuver.name);
                    for (const Event& event : maneuver.events) {
                        Element& in_event = add(in_maneuver, Level::event, event.name);
                        in_event.event = &event;
                        in_event.group = &group;
                        in_event.max_executions = event.executions;
                        for (const Action& action : event.actions) {
                            actions_.push_back(&add(in_event, Level::action, action.name));
                            actions_.back()->action = &action;
                        }
                    }
                }
            }
        }
    }
}

void StoryTree::build_triggers() {
    const FindElement by_name = [this](const ElementStateCondition& condition) { return find(condition); };
    const auto judged = [&](const std::optional<Trigger>& trigger) {
        return trigger ? std::optional(JudgedTrigger(*trigger, by_name)) : std::nullopt;
    };
    root_.stop = judged(storyboard_->stop);
    walk(root_, [&](Element& element) {
        if (element.act) {
            element.start = judged(element.act->start);
            element.stop = judged(element.act->stop);
        } else if (element.event) {
            element.start = judged(element.event->start);
        }
    });
}

std::vector<const ElementChanges*> StoryTree::find(const ElementStateCondition& condition) const {
    const auto level = level_of(condition.type);
    std::vector<const ElementChanges*> found;
    const std::string tail = "::" + condition.element;
    walk(const_cast<Element&>(root_), [&](const Element& element) { // NOLINT(cppcoreguidelines-pro-type-const-cast)
        if (level && element.level == *level && (element.path == condition.element || element.path.ends_with(tail)))
            found.push_back(&element.changes);
    });
    if (found.empty())
        played_->notes.push_back(fmt::format("{}: a condition waits for {} '{}', which the storyboard does not have: it stays false",
                                             storyboard_->file.string(), printable(condition.type), printable(condition.element)));
    return found;
}

void StoryTree::set(Element& element, ElementState state, const char* transition) {
    if (element.state == state)
        return;
    element.changes.push_back({word(state), transition});
    element.state = state;
}

void StoryTree::run(RunningAction& run, const Action& action) {
    placed(storyboard_->file, action.line, action.name, [&] { run.begin(*world_, *played_); });
}

bool StoryTree::step_run(RunningAction& run, const Action& action, double dt_s, std::vector<unsigned>& moved) {
    return placed(storyboard_->file, action.line, action.name, [&] { return run.step(*world_, dt_s, moved[run.entity()]); });
}

void StoryTree::begin_init(const InitAction& init) {
    if (init.entity.empty())
        return act_on_world(init.action);
    RunningAction fresh(std::get<PrivateAction>(init.action.what), world_->index_of(init.entity));
    fresh.begin(*world_, *played_);
    init_.push_back({&init.action, {std::move(fresh), false}});
}

/// In the order of the file, those of the world first; but what needs the place of an entity that has none yet waits for it, and all later
/// actions of the same entity with it.
void StoryTree::start() {
    std::vector<const InitAction*> left;
    for (const bool global : {true, false})
        for (const InitAction& init : storyboard_->init)
            if (init.entity.empty() == global)
                left.push_back(&init);
    while (!left.empty()) {
        std::vector<const InitAction*> waiting;
        std::map<std::string, std::string> waits_for;
        for (const InitAction* init : left) {
            const std::string& name = entity_of(*init);
            if (!waits_for.contains(name))
                placed(storyboard_->file, init->action.line, init->action.name, [&] {
                    try {
                        begin_init(*init);
                    } catch (const NoPlaceYet& error) {
                        waits_for[name] = error.entity;
                    }
                });
            if (waits_for.contains(name))
                waiting.push_back(init);
        }
        if (waiting.size() == left.size())
            refuse_waiting(storyboard_->file, *waiting.front(), waits_for);
        left = std::move(waiting);
    }
    root_.state = ElementState::running;
    for (const auto& story : root_.children)
        start(*story);
}

void StoryTree::start(Element& element) {
    if (element.state == ElementState::init && element.start)
        return set(element, ElementState::standby, "");
    if (element.level == Level::event)
        return start_event(element);
    set(element, ElementState::running, "startTransition");
    ++element.executions;
    for (const auto& child : element.children)
        start(*child);
    if (element.children.empty())
        end(element);
}

void StoryTree::start_event(Element& element) {
    if (running(element))
        return;
    auto& siblings = element.parent->children;
    if (element.event->priority == Priority::overwrite) {
        for (const auto& sibling : siblings)
            if (sibling.get() != &element && running(*sibling))
                end(*sibling);
    } else if (element.event->priority == Priority::skip &&
               std::any_of(siblings.begin(), siblings.end(), [](const auto& sibling) { return running(*sibling); })) {
        element.changes.push_back({word(element.state), "skipTransition"});
        return;
    }
    std::vector<std::size_t> actors;
    if (element.group->select_triggering && element.start)
        actors = element.start->triggered_by();
    for (const std::string& name : element.group->actors)
        if (const std::size_t at = world_->index_of(name); std::find(actors.begin(), actors.end(), at) == actors.end())
            actors.push_back(at);
    set(element, ElementState::running, "startTransition");
    ++element.executions;
    if (element.children.empty())
        return end(element);
    for (const auto& action : element.children)
        start_action(*action, actors);
}

void StoryTree::end_conflicting(const RunningAction& fresh, const Element* of) {
    for (InitRun& init : init_)
        if (!init.run.over && init.run.action.conflicts(fresh))
            init.run.over = true;
    for (Element* other : actions_) {
        if (other == of || !running(*other))
            continue;
        bool any = false;
        for (Element::Run& run : other->runs)
            if (!run.over && run.action.conflicts(fresh))
                any = run.over = true;
        if (any && std::all_of(other->runs.begin(), other->runs.end(), [](const Element::Run& run) { return run.over; }))
            end(*other);
    }
}

void StoryTree::start_action(Element& element, const std::vector<std::size_t>& actors) {
    element.runs.clear();
    set(element, ElementState::running, "startTransition");
    ++element.executions;
    if (std::holds_alternative<GlobalAction>(element.action->what))
        return placed(storyboard_->file, element.action->line, element.action->name, [&] { act_on_world(*element.action); });
    const auto& what = std::get<PrivateAction>(element.action->what);
    for (const std::size_t actor : actors) {
        element.runs.push_back({RunningAction(what, actor), false});
        end_conflicting(element.runs.back().action, &element);
        run(element.runs.back().action, *element.action);
    }
}

void StoryTree::judge(Element& element) {
    if (running(element) && element.stop && element.stop->judge(*world_))
        return stop(element);
    if (element.state == ElementState::standby && (!element.start || element.start->judge(*world_)))
        start(element);
    if (running(element))
        for (const auto& child : element.children)
            judge(*child);
}

void StoryTree::step(Element& element, double dt_s, std::vector<unsigned>& moved) {
    if (!running(element))
        return;
    for (const auto& child : element.children)
        step(*child, dt_s, moved);
    if (element.level != Level::action)
        return;
    bool all = true;
    for (Element::Run& run : element.runs) {
        run.over = run.over || step_run(run.action, *element.action, dt_s, moved);
        all = all && run.over;
    }
    if (all)
        end(element);
}

void StoryTree::step(double dt_s, std::vector<unsigned>& moved) {
    judge(root_);
    if (stopped())
        return;
    for (InitRun& init : init_)
        init.run.over = init.run.over || step_run(init.run.action, *init.action, dt_s, moved);
    step(root_, dt_s, moved);
}

void StoryTree::stop(Element& element) {
    for (const auto& child : element.children)
        stop(*child);
    if (element.state == ElementState::init || complete(element))
        return;
    set(element, ElementState::complete, "stopTransition");
    if (element.parent)
        propagate(*element.parent);
}

void StoryTree::propagate(Element& element) {
    if (element.level != Level::storyboard && !complete(element) &&
        std::all_of(element.children.begin(), element.children.end(), [](const auto& child) { return complete(*child); }))
        end(element);
}

void StoryTree::end(Element& element) {
    if (complete(element))
        return;
    for (const auto& child : element.children)
        if (running(*child))
            end(*child);
    if (complete(element))
        return;
    const bool repeats = element.level == Level::group || element.level == Level::event;
    if (repeats && (element.max_executions < 0 || element.executions < element.max_executions)) {
        if (element.start)
            element.start->reset();
        set(element, ElementState::standby, "endTransition");
        for (const auto& child : element.children)
            reset(*child);
    } else {
        set(element, ElementState::complete, "endTransition");
    }
    if (element.parent)
        propagate(*element.parent);
}

void StoryTree::reset(Element& element) {
    for (const auto& child : element.children)
        reset(*child);
    element.state = ElementState::init;
    element.executions = 0;
    if (element.start)
        element.start->reset();
    if (element.stop)
        element.stop->reset();
}

bool StoryTree::all_over() const {
    return !root_.children.empty() &&
           std::all_of(root_.children.begin(), root_.children.end(), [](const auto& story) { return complete(*story); });
}

void StoryTree::act_on_world(const Action& of) {
    const auto& action = std::get<GlobalAction>(of.what);
    if (const auto* environment = std::get_if<EnvironmentAction>(&action)) {
        Environment merged = world_->environment.value_or(Environment{});
        const Environment& by = environment->environment;
        const auto take = [](auto& into, const auto& from) {
            if (from)
                into = from;
        };
        if (by.date_time) {
            merged.time_runs = by.time_runs;
            world_->environment_since_s = world_->time_s;
        }
        take(merged.date_time, by.date_time);
        take(merged.cloud_state, by.cloud_state);
        take(merged.sun_azimuth_rad, by.sun_azimuth_rad);
        take(merged.sun_elevation_rad, by.sun_elevation_rad);
        take(merged.sun_illuminance_lx, by.sun_illuminance_lx);
        take(merged.fog_visual_range_m, by.fog_visual_range_m);
        take(merged.precipitation, by.precipitation);
        take(merged.precipitation_mm_per_h, by.precipitation_mm_per_h);
        take(merged.wetness, by.wetness);
        world_->environment = merged;
        played_->environment.push_back({world_->time_s, merged, world_->environment_since_s});
    } else if (const auto* entity = std::get_if<EntityAction>(&action)) {
        EntityState& state = world_->entity(entity->entity);
        if (entity->add_at)
            state.stand_at(world_->spot(*entity->add_at));
        else
            state.present = false;
    } else if (const auto* value = std::get_if<SetValueAction>(&action)) {
        auto& values = value->variable ? world_->variables : world_->parameters;
        std::string& known = values[value->name];
        if (value->how == SetValueAction::How::set) {
            known = value->value;
        } else {
            const double now = to_number(known).value_or(0.0), by = to_number(value->value).value_or(0.0);
            known = fmt::format("{}", value->how == SetValueAction::How::add ? now + by : now * by);
        }
    } else {
        const auto& signal = std::get<TrafficSignalAction>(action);
        (signal.controller ? world_->phases : world_->signals)[signal.name] = signal.state;
    }
}

} // namespace fernlicht::osc
