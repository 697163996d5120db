#include "runner/play/shadows/choose_shadows.h"

#include "metrics/images/pixel_errors.h"
#include "renderer/renderer.h"
#include "runner/findings/figures.h"
#include "runner/play/preparation.h"
#include "runner/play/shadows/shadow_truth.h"
#include "scenarios/drives/keys/story_drive.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_moments = 64, max_pictures = 256, min_moments = 8;
constexpr int scan_width_px = 16, scan_height_px = 12, scan_texels = 16;
constexpr double compared_px = 160.0 * 120.0;             ///< of a picture
constexpr double deciding_lx = ErrorRule{}.relative_from; ///< what gets less without shadows decides nothing, as in accuracy sections

/// Of one lamp set.
struct ShadowedMoments {
    const LampSet* lamp_set = nullptr;
    std::vector<Moment> moments; ///< evenly spread over all that have a caster in a beam
    int ticks = 0, shadowed = 0;
};

template <class One> std::vector<One> evenly_spread(const std::vector<One>& all, std::size_t most) {
    if (all.size() <= most)
        return all;
    std::vector<One> some;
    for (std::size_t i = 0; i < most; ++i)
        some.push_back(all[i * (all.size() - 1) / (most - 1)]);
    return some;
}

/// Whether the moment drawn last has shadows of the own lamps or of others'; those of sun and moon are looked for where these shine.
bool is_shadowed(const Moment& moment, const Renderer& renderer) {
    const std::vector<PrunedFeature> pruned = renderer.pruned();
    const auto needed = [&](std::string_view what) { return std::ranges::find(pruned, what, &PrunedFeature::what) == pruned.end(); };
    return needed("shadow maps") || (!moment.other_lamps.empty() && needed("shadow maps of other lamps")) ||
           moment.daylight.direct() != nullptr;
}

/// Maps are drawn where anything casts: the smallest ones of the smallest picture tell.
ShadowedMoments shadowed_moments(const Stage& stage, Device& device, const View& view, RendererSettings settings, const LampSet& lamp_set,
                                 std::size_t most) {
    settings.shadows = {};
    settings.shadows.width = settings.shadows.height = scan_texels;
    Renderer renderer(device, stage.scene, settings);
    std::vector<int> all(static_cast<std::size_t>(tick_count(stage.drive)));
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<int>(i);
    const View small = at_size(view, scan_width_px, scan_height_px);
    std::vector<int> shadowed;
    for (const Moment& moment : moments_at(all, stage, lamp_set)) {
        renderer.render(moment, small, {.illuminance = true});
        if (is_shadowed(moment, renderer))
            shadowed.push_back(moment.tick);
    }
    renderer.finish();
    return {&lamp_set, moments_at(evenly_spread(shadowed, most), stage, lamp_set), static_cast<int>(all.size()),
            static_cast<int>(shadowed.size())};
}

View compared_view(const View& view) {
    const double scale = std::sqrt(compared_px / (static_cast<double>(view.width_px) * view.height_px));
    const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
    return at_size(view, scaled(view.width_px), scaled(view.height_px));
}

/// Pictures of all lamp sets and views with the rays that tell the truth about them.
class Trial {
  public:
    Trial(const Stage& stage, Device& device, const RendererSettings& settings, const std::vector<ShadowedMoments>& sets)
        : stage_(stage), device_(device), settings_(settings), rays_(stage.scene),
          unshadowed_(device, stage.scene, without_shadows(settings)) {
        for (const ShadowedMoments& set : sets)
            for (const View& view : stage.drive.views)
                series_.push_back({&set, compared_view(view)});
        for (const Series& series : series_)
            for (const std::size_t m : evenly_spread(indices(series), min_moments))
                keep({&series, m});
    }

    /// Those asked first, and the others until one is beyond the bound: what is found then joins the first.
    TriedShadows tried(ShadowMethod method, double bound) {
        TriedShadows found;
        found.method = method;
        try {
            Renderer renderer(device_, stage_.scene, with(method));
            ask_kept(renderer, found);
            if (*found.error <= bound)
                ask_others(renderer, bound, found);
        } catch (const InputError& refusal) {
            found.error.reset();
            found.refused = refusal.what();
        } catch (const ShadowMemoryError& no_room) {
            found.error.reset();
            found.refused = no_room.what();
        }
        return found;
    }

    /// Pictures that all methods are asked for.
    TriedShadows over_kept(ShadowMethod method) {
        TriedShadows found;
        found.method = method;
        Renderer renderer(device_, stage_.scene, with(method));
        ask_kept(renderer, found);
        return found;
    }

  private:
    /// One lamp set in one view.
    struct Series {
        const ShadowedMoments* set = nullptr;
        View view;
    };
    struct Picture {
        const Series* series = nullptr;
        std::size_t moment = 0;
        bool operator==(const Picture&) const = default;
    };
    struct Kept {
        Picture picture;
        ShadowTruth truth;
    };

    static std::vector<std::size_t> indices(const Series& series) {
        std::vector<std::size_t> all(series.set->moments.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = i;
        return all;
    }

    RendererSettings with(ShadowMethod method) const {
        RendererSettings own = settings_;
        own.shadows.method = method;
        return own;
    }

    ShadowTruth truth_of(const Picture& picture) {
        return {rays_, unshadowed_, picture.series->set->moments, picture.series->view, 0.0, deciding_lx};
    }
    void keep(const Picture& picture) { kept_.push_back({picture, truth_of(picture)}); }
    bool is_kept(const Picture& picture) const { return std::ranges::find(kept_, picture, &Kept::picture) != kept_.end(); }

    static void ask(Renderer& renderer, const Picture& picture, ShadowTruth& truth, TriedShadows& found) {
        const double share = shadow_area(truth.images(renderer, picture.moment)).wrong_share();
        ++found.pictures;
        if (found.error && share <= *found.error)
            return;
        found.error = share;
        found.worst_s = picture.series->set->moments[picture.moment].time_s;
        found.worst_set = picture.series->set->lamp_set->name;
        found.worst_view = picture.series->view.name;
    }

    void ask_kept(Renderer& renderer, TriedShadows& found) {
        for (Kept& kept : kept_)
            ask(renderer, kept.picture, kept.truth, found);
    }

    void ask_others(Renderer& renderer, double bound, TriedShadows& found) {
        for (const Series& series : series_)
            for (std::size_t m = 0; m < series.set->moments.size(); ++m) {
                const Picture picture{&series, m};
                if (is_kept(picture))
                    continue;
                ShadowTruth truth = truth_of(picture);
                ask(renderer, picture, truth, found);
                if (*found.error > bound)
                    return keep(picture);
            }
    }

    const Stage& stage_;
    Device& device_;
    RendererSettings settings_;
    Reference rays_;
    Renderer unshadowed_;
    std::vector<Series> series_;
    std::vector<Kept> kept_; ///< what every method is asked for first
};

std::string bound_text(const ShadowChoice& choice) { return fmt::format("{:.6g} %", 100.0 * choice.bound); }

std::string worst_text(const TriedShadows& tried) {
    return fmt::format("{} % in the worst of {} pictures, view '{}' after {:.2f} s", shadow_percent(*tried.error), tried.pictures,
                       tried.worst_view, tried.worst_s);
}

void try_methods(ShadowChoice& choice, Trial& trial) {
    for (const ShadowMethod method : shadow_methods_by_cost()) {
        const TriedShadows& tried = choice.tried.emplace_back(trial.tried(method, choice.bound));
        if (!tried.error || *tried.error > choice.bound)
            continue;
        choice.chosen = method;
        choice.why = fmt::format("the cheapest whose error stays within {}: {}", bound_text(choice), worst_text(tried));
        return;
    }
    for (TriedShadows& tried : choice.tried)
        if (tried.error)
            tried = trial.over_kept(tried.method);
    const auto least = std::ranges::min_element(choice.tried, {}, [](const TriedShadows& t) { return t.error.value_or(2.0); });
    choice.chosen = least->method;
    choice.why = fmt::format("no method stays within {}; {} errs least: {}", bound_text(choice), name(choice.chosen), worst_text(*least));
}

constexpr int checked_width_px = 16, checked_height_px = 12; ///< what is seen does not matter

const YamlMember* member_of(const YamlValue& map, std::string_view key) {
    const auto found = std::ranges::find(map.members, key, &YamlMember::key);
    return found == map.members.end() ? nullptr : &*found;
}

/// Who asked for `planar`: the line of the drive's file, else the flag that overrules it.
InputError::Where who_asked_for_planar(const Drive& drive) {
    FilesRead opened;
    if (std::filesystem::exists(drive.file) && !is_storyboard_file(drive.file)) {
        const YamlValue document = parse_yaml(to_utf8(read_file(drive.file, opened)), drive.file);
        if (const YamlMember* const shadows = member_of(document, "shadows")) {
            const YamlMember* const method = member_of(shadows->value, "method");
            const YamlValue& value = method ? method->value : shadows->value;
            if (value.text == name(ShadowMethod::planar))
                return {drive.file, value.line, value.column, "shadows"};
        }
    }
    return {drive.file, 0, 0, "--shadows"};
}

/// Draws moments as small as they come: the method refuses those whose ground is not one plane.
class PlanarTrial {
  public:
    PlanarTrial(const Stage& stage, Device& device)
        : stage_(stage), renderer_(device, stage.scene, settings_for(stage.drive, RendererSettings{})),
          small_(at_size(stage.drive.views.front(), checked_width_px, checked_height_px)) {}

    /// `lamp_set`: for messages; "" where it is known.
    void draw(const Moment& moment, const std::string& lamp_set) {
        try {
            renderer_.render(moment, small_, {.illuminance = true});
        } catch (const InputError& refusal) {
            const std::string key = refusal.where().key + ": ", text = refusal.what();
            throw InputError(who_asked_for_planar(stage_.drive),
                             fmt::format("{} (after {:.2f} s{})", text.starts_with(key) ? text.substr(key.size()) : text, moment.time_s,
                                         lamp_set.empty() ? "" : fmt::format(", lamp set '{}'", lamp_set)));
        }
    }
    void finish() { renderer_.finish(); }

  private:
    const Stage& stage_;
    Renderer renderer_;
    View small_;
};

} // namespace

std::vector<ShadowMethod> shadow_methods_by_cost() {
    using enum ShadowMethod;
    return {none, under_car, planar, one_map, map, perspective_map, light_space_map, volumes, soft_map};
}

std::optional<ShadowChoice> choose_shadows(Stage& stage, Device& device, const RendererSettings& settings) {
    Drive& drive = stage.drive;
    if (drive.shadows.method != ShadowMethod::automatic)
        return std::nullopt;
    const Technique& technique = technique_named(drive.technique);
    if (technique.kind != TechniqueKind::ours || technique.name == "photometric-naive") {
        drive.shadows.method = ShadowMethod::map; // all that these know, or more
        return std::nullopt;
    }
    ShadowChoice choice;
    choice.bound = drive.shadows.error_bound;
    RendererSettings light = settings;
    light.shadows = drive.shadows;
    light.profile = false;
    const std::size_t most = std::clamp(max_pictures / (drive.lamp_sets.size() * drive.views.size()), min_moments, max_moments);
    std::vector<ShadowedMoments> sets;
    for (const LampSet& lamp_set : drive.lamp_sets) {
        ShadowedMoments set = shadowed_moments(stage, device, drive.views.front(), light, lamp_set, most);
        choice.ticks += set.ticks;
        choice.ticks_shadowed += set.shadowed;
        choice.compared += static_cast<int>(set.moments.size());
        if (!set.moments.empty())
            sets.push_back(std::move(set));
    }
    if (sets.empty()) {
        choice.why = fmt::format("nothing stands in a beam in any of {} moments", choice.ticks);
    } else {
        Trial trial(stage, device, light, sets);
        try_methods(choice, trial);
    }
    drive.shadows.method = choice.chosen;
    drive.notes.push_back(fmt::format("shadows: auto chose {}: {}", name(choice.chosen), choice.why));
    return choice;
}

void refuse_auto_shadows(const Drive& drive) {
    if (drive.shadows.method == ShadowMethod::automatic)
        throw InputError({drive.file, 0, 0, "shadows"}, "'auto', which is chosen on the drive's pictures, by `fernlicht run` for one",
                         "a method by its name, as the resolved drive of a run has it");
}

void check_planar_shadows(const Stage& stage, Device& device, TickRange ticks) {
    const Drive& drive = stage.drive;
    if (drive.shadows.method != ShadowMethod::planar)
        return;
    PlanarTrial trial(stage, device);
    for (const LampSet& lamp_set : drive.lamp_sets)
        for (State state = start(drive); state.tick <= std::min(ticks.last, tick_count(drive) - 1); state = advance(state, drive))
            if (state.tick >= ticks.first)
                trial.draw(moment_at(state, drive, stage.route, lamp_set), lamp_set.name);
    trial.finish();
}

void check_planar_shadows(const Stage& stage, Device& device, const std::vector<Moment>& moments) {
    if (stage.drive.shadows.method != ShadowMethod::planar)
        return;
    PlanarTrial trial(stage, device);
    for (const Moment& moment : moments)
        trial.draw(moment, "");
    trial.finish();
}

} // namespace fernlicht
