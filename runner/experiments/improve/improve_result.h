// What `fernlicht improve` found. The writers only format it.
#pragma once

#include "metrics/improve/improve_beam.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

namespace fernlicht {

/// A reading to be gained or kept, of one drive.
struct ImprovedReading {
    std::string drive, asked; ///< name; what was asked, as typed, or "as it is"
    ReadingKey reading;
    bool is_gain = false, at_least = true;
    double bound = 0.0;                     ///< at least or at most this
    Value before, foretold, stepped, found; ///< foretold by the last step, what it found, and what the written lamp reads
    bool met = false;                       ///< by the written lamp
};

struct ImproveDrive {
    std::string name, title, lamp_set;
    int moments = 0;
};

/// A row of the regulation before and after.
struct ImprovedRow {
    std::string id, unit;
    std::string before_verdict, after_verdict; ///< "pass", "fail", "not_measured"
    double before = 0.0, after = 0.0, before_margin = 0.0, after_margin = 0.0;
    std::string limits; ///< ">= 850"
};

struct ImproveExtreme {
    double h_deg = 0.0, v_deg = 0.0, before_cd = 0.0, after_cd = 0.0;
};

struct ImproveResult : Findings {
    std::string lamp, written, solver; ///< names of the files
    std::vector<ImproveDrive> drives;
    std::vector<ImprovedReading> readings;
    std::vector<ImproveStep> steps;
    std::vector<BindingLimit> binding;
    bool gain_missed = false, settled = false; ///< as ImprovedBeam has them
    int variables = 0;
    double floor_cd = 0.0, narrowest_deg = 0.0;
    double flux_before_lm = 0.0, flux_after_lm = 0.0;
    ImproveExtreme most, least, brightest;              ///< more light, less light, and of the changed lamp
    double steepest_before = 0.0, steepest_after = 0.0; ///< cd/deg
    int samples_changed = 0;
    std::string regulation, regulation_title; ///< "" for none
    std::string verdict_before, verdict_after;
    std::vector<ImprovedRow> rows;
    CandelaTable before, after; ///< not in JSON
};

/// All that was asked is met by the written lamp, and no row of the regulation that passed fails.
bool improved(const ImproveResult& result);

/// docs/improve.md tells how to read it.
Document document(const ImproveResult& result);
JsonMembers improve_members(ImproveResult& result); ///< of improve.json

} // namespace fernlicht
