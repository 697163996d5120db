#include "runner/files/same_display.h"

#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"

#include <fmt/format.h>
#include <utility>

namespace fernlicht {

std::string check_shown_alike(const NamedPicture& reference, const NamedPicture& tested, const std::string& as) {
    const PictureTags a = read_png_tags(reference.file), b = read_png_tags(tested.file);
    if (!a.shown_by.empty() && !b.shown_by.empty() && a.shown_by != b.shown_by)
        throw InputError({tested.file, 0, 0, {}}, "was shown by '" + printable(b.shown_by, 200) + "'",
                         "'" + printable(a.shown_by, 200) + "' as " + as +
                             ", or the EXRs of the same moments; one `tone_mapper` and `display` in both drives give comparable PNGs");
    for (const auto& [tags, file] : {std::pair(&a, &reference.file), std::pair(&b, &tested.file)})
        if (!tags->icc.empty())
            throw InputError({*file, 0, 0, {}}, "has the colour space of a display, by an ICC profile",
                             "sRGB, which codes are taken for; EXRs of the same moments can be compared");
    if (a.shown_by.empty() == b.shown_by.empty())
        return "";
    return fmt::format(
        "{} was shown by '{}', and {} does not tell (no fernlicht:shown_by): whether the two have a common scale is not known",
        printable(a.shown_by.empty() ? tested.name : reference.name), printable(a.shown_by.empty() ? b.shown_by : a.shown_by, 200),
        printable(a.shown_by.empty() ? reference.name : tested.name));
}

} // namespace fernlicht
