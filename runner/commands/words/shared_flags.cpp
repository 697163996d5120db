#include "runner/commands/words/shared_flags.h"

#include <algorithm>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr SharedFlag flags[] = {
    // What is read
    {"DRIVE", "DRIVE", "drive (YAML) or storyboard (.xosc): a file, a shipped one by name, or - for a drive on standard input"},
    {"DRIVES", "DRIVE...", "drives (YAML) or storyboards (.xosc): files, shipped ones by name, or - for a drive on standard input"},
    {"STUDY", "STUDY", "study: a file (YAML), or a shipped one by name"},
    {"LOG", "FILE", "candump log in any of its forms, or - for standard input"},
    {"LOGS", "FILE...", "candump logs in any of their forms, or - for standard input"},
    {"NIGHT", "NIGHT", "last, a number or a date"},
    {"IDS", "ID...", "first digits of ids, or DRIVE/LAMP SET/TECHNIQUE"},
    {"ID", "ID", "first digits of an id, or DRIVE/LAMP SET/TECHNIQUE"},
    // What is driven
    {"--lamp", "[SIDE=]FILE", "use this lamp file for all low beams, or for the lamps whose name contains SIDE (left, right, high)"},
    {"--lamp-model", "NAME", "built-in lamp: halogen-low, halogen-high, xenon-low or xenon-high"},
    {"--low-beams", "NAME|FILE", "lamp of both sides: a file, or built-in: halogen-low, halogen-high, xenon-low or xenon-high"},
    {"--yaw", "DEG", "turn the model left, in degrees"},
    {"--lamp-set", "NAME", "lamp set to take"},
    {"--lamps", "FILE", "take the lamp sets, mounts, vehicle and control of this file: lamp sets (YAML), or a drive"},
    {"--recipe", "NAME|FILE", "how lamp files that are text grids are laid out: a YAML file or a shipped one by name (docs/lamps.md)"},
    {"--road", "FILE", "OpenDRIVE road in place of the drive's or storyboard's own"},
    {"--road-folder", "FOLDER", "look here, too, for the road of a storyboard"},
    {"--lenient", "", "skip what cannot be used, and say so"},
    {"--aim", "as-is|auto", "aim of low and high beams in place of the drive's; auto turns each until its cut-off lies 1 % down"},
    {"--frames", "FIRST:LAST", "play only these moments, counted from 0; either end may be left out"},
    {"--moment", "S", "take the moment nearest to this time, in seconds into the drive"},
    {"--count", "N", "number of moments, spread evenly over the drive"},
    {"--duration", "S", "seconds to play"},
    {"--can-log", "FILE", "candump log that the drive's `can` reads"},
    {"--can-start", "S", "timestamp of the log that is the drive's 0 s, in seconds"},
    // How it is rendered
    {"--technique", "NAME", "technique to light the scene with; `fernlicht techniques` lists all"},
    {"--techniques", "NAME,...", "techniques to compare; `fernlicht techniques` lists all"},
    {"--shadows", "NAME", "shadow method; `fernlicht techniques` lists all"},
    {"--dressing", "none|plain|dressed", "how what stands beside the road looks"},
    {"--beams", "BEAM,...", "forms of the beam textures: float, eight-bit or WIDTHxHEIGHTxBITS"},
    {"--backend", "NAME", "auto, egl, egl-device=N, osmesa or software"},
    {"--light-pass", "auto|shader|cpu", "where photometric computes light"},
    {"--resolution", "WIDTHxHEIGHT", "size of the perspective views in pixels"},
    {"--vertical-fov", "DEG", "vertical field of view in degrees"},
    {"--ppd", "N", "pixels per degree"},
    {"--rate", "FPS", "frames per second"},
    {"--lamp-radius", "M", "radius of lamps as discs in metres; 0: points"},
    {"--target-error", "SHARE", "standard error to reach in each pixel of the reference, such as 0.5% or 0.005"},
    {"--max-samples", "N", "most samples for each pixel of the reference"},
    {"--rounds", "N", "rounds of timing; in each, everything that is compared renders the moments once"},
    {"--seed", "N", "seed of all that is random"},
    {"--trace", "FILE", "new file for a timeline of what takes how long, for Perfetto and chrome://tracing (docs/ci.md)"},
    {"--no-accuracy", "", "do not compare moments with the reference"},
    {"--quiet", "", "show no progress"},
    // How it is judged
    {"--baselines", "FOLDER", "folder of baselines"},
    {"--strict", "", "refuse lamp files that make readings meaningless, instead of warning"},
    {"--rating", "NAME|FILE", "rating: a file (YAML), or a shipped one by name"},
    {"--regulation", "ID", "table of a regulation to judge by; `fernlicht lamp --regulation list` names all"},
    {"--left-hand-traffic", "", "mirror the table, for traffic on the left"},
    {"--noise", "SHARE", "standard deviation of an intensity, such as 1%; what the tables themselves show counts where it is larger"},
    // Which of many
    {"--only", "NAME,...", "only these; * and ? are wildcards"},
    {"--list", "", "list what there is, and play nothing"},
    {"--study", "NAME", "only this study"},
    {"--store", "FOLDER", "folder of played cells (default: $XDG_CACHE_HOME/fernlicht/store)"},
    {"--history", "FILE", "file of the history of nights (docs/history.md)"},
    {"--fail-on-change", "", "exit with 1 if anything changed since the last accepted night, or cannot be compared with it"},
    {"--note", "REASON", "the reason, in one sentence"},
    {"--dry-run", "", "say what would be removed, and remove nothing"},
    // Where it goes
    {"--out", "FOLDER", "new or empty folder for the results"},
    {"-o,--out", "FILE", "new file to write, or - for standard output"},
    {"--picture", "FILE", "new file for a picture, or - for standard output"},
    {"--force", "", "overwrite files that exist"},
    {"--resume", "", "continue what was interrupted in the folder of --out"},
    {"--json", "", "print JSON"},
    {"--csv", "", "print CSV"}};

} // namespace

const SharedFlag& shared_flag(const std::string& name) {
    const auto found = std::ranges::find_if(flags, [&](const SharedFlag& flag) { return name == flag.name; });
    if (found == std::end(flags))
        throw std::logic_error("no shared flag " + name);
    return *found;
}

std::string parser_name(const SharedFlag& flag) {
    const std::string value = flag.value;
    return *flag.name == '-' ? flag.name : value.substr(0, value.find("..."));
}

} // namespace fernlicht
