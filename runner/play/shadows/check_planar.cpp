#include "runner/play/shadows/check_planar.h"

#include "renderer/renderer.h"
#include "runner/play/preparation.h"
#include "runner/play/shadows/shadow_truth.h"
#include "scenarios/drives/keys/story_drive.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

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

void check_planar_shadows(const Stage& stage, Device& device, TickRange ticks) {
    const Drive& drive = stage.drive;
    if (drive.shadows.method != ShadowMethod::planar)
        return;
    PlanarTrial trial(stage, device);
    for (const Variant& variant : drive.variants)
        for (State state = start(drive); state.tick <= std::min(ticks.last, tick_count(drive) - 1); state = advance(state, drive))
            if (state.tick >= ticks.first)
                trial.draw(moment_at(state, drive, stage.route, variant), variant.name);
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
