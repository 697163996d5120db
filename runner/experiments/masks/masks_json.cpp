#include "runner/experiments/masks/masks_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

JsonMembers masked_drive_members(MaskedDrive& one) {
    return {{"lamp_set", one.lamp_set},
            {"margin_deg", one.margin_deg},
            {"as_it_is", one.as_it_is},
            {"lane_lxs", one.lane_lxs},
            {"verge_lxs", one.verge_lxs},
            {"both_lxs", one.both_lxs},
            {"lost_lxs", one.lost_lxs},
            {"lost_percent", one.lost_percent},
            {"others_lxs", one.others_lxs},
            {"above_lxs", one.above_lxs},
            {"most_lx", one.most_lx},
            {"most_of_limit", one.most_of_limit},
            {"worst_user", or_null(one.worst_user)},
            {"worst_s", one.worst_s},
            {"worst_m", one.worst_m},
            {"on_foot_left_m", one.left_m},
            {"on_foot_right_m", one.right_m}};
}

} // namespace

JsonMembers masks_members(MasksFound& found) {
    return {{"schema", json_constant("fernlicht masks")},
            {"schema_version", json_constant(1)},
            {"context", context_members(found.context)},
            {"drive", found.drive},
            {"title", or_null(found.title)},
            {"against", found.against},
            {"limits", found.limits},
            {"on_foot", found.walker},
            {"on_foot_level", found.walker_level},
            {"from_m", found.places.from_m},
            {"to_m", found.places.to_m},
            {"row_m", found.places.row_m},
            {"across_m", found.places.across_m},
            {"above_m", found.places.above_m},
            {"verge_m", found.places.verge_m},
            {"verge_on_the_left", found.places.left_hand},
            {"moments", found.moments},
            {"step_s", found.step_s},
            {"drives", found.drives, masked_drive_members},
            {"notes", found.notes}};
}

std::string masks_csv(const MasksFound& found) {
    std::string out = "lamp_set,margin_deg,as_it_is,lane_lxs,verge_lxs,both_lxs,lost_lxs,lost_percent,others_lxs,above_lxs,most_lx,"
                      "most_of_limit,worst_user,worst_s,worst_m,on_foot_left_m,left_bound,on_foot_right_m,right_bound\r\n";
    for (const MaskedDrive& one : found.drives)
        out += csv_line(csv_text(one.lamp_set), csv_number(one.margin_deg), std::string(one.as_it_is ? "1" : "0"), csv_number(one.lane_lxs),
                        csv_number(one.verge_lxs), csv_number(one.both_lxs), csv_number(one.lost_lxs), csv_number(one.lost_percent),
                        csv_number(one.others_lxs), csv_number(one.above_lxs), csv_number(one.most_lx), csv_number(one.most_of_limit),
                        csv_text(one.worst_user), csv_number(one.worst_s), csv_number(one.worst_m), csv_number(one.left_m.figure()),
                        std::string(bound_name(one.left_m)), csv_number(one.right_m.figure()), std::string(bound_name(one.right_m)));
    return out;
}

std::string masks_moments_csv(const MasksFound& found) {
    std::string out = "lamp_set,margin_deg,time_s,lane_lx,verge_lx,both_lx,others_lx,above_lx\r\n";
    for (const MaskedDrive& one : found.drives)
        for (const MaskedDrive::Moment& moment : one.moments)
            out += csv_line(csv_text(one.lamp_set), csv_number(one.margin_deg), csv_number(moment.time_s), csv_number(moment.lane_lx),
                            csv_number(moment.verge_lx), csv_number(moment.both_lx), csv_number(moment.others_lx),
                            csv_number(moment.above_lx));
    return out;
}

} // namespace fernlicht
