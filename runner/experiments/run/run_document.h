// A run's report as sections of a document.
#pragma once

#include "runner/findings/run_page.h"

namespace fernlicht {

/// A lamp set's name beside its colour.
Cell lamp_cell(const ComparedDrive& drive, std::size_t index);

/// The verdict in a word, then its reasons, and what could not be measured.
Section verdict_section(const Report& report);
/// Punctuality and losses of a live run.
Section live_section(const LiveFigures& live);

/// The three figures that matter most, lamp set against lamp set.
Cards key_figures(const ComparedDrive& drive);
/// "xenon against halogen: ...": the first of them in a sentence; "" where nothing was measured.
std::string key_sentence(const ComparedDrive& drive);

using Sections = std::vector<Section>;
/// Each adds what it has to say of a drive, if anything. Reach, width and area per limit and lamp set, one table per plane and lane:
void add_extents(const ComparedDrive& drive, Sections& sections);
/// How the lamps are aimed and where that puts their beams.
void add_aims(const ComparedDrive& drive, Sections& sections);
/// Plots over the drive, signals, and what it cost.
void add_course(const ComparedDrive& drive, Sections& sections);
/// What cars within the drive's tolerances read.
void add_cars(const ComparedDrive& drive, Sections& sections);
/// How far each lamp set's lux images lie from the reference, and what that cost.
void add_accuracy(const ComparedDrive& drive, Sections& sections);
/// Readings beside each other per lamp set; lamps with their files; what was noted and left out, and what that saved.
void add_details(const ComparedDrive& drive, Sections& sections);
/// How shadows and pictures are drawn, and how pictures are seen on a display.
void add_drawing(const ComparedDrive& drive, Sections& sections);

} // namespace fernlicht
