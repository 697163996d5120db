// `fernlicht lamp FILE --regulation ID` and `--cut-off`.
#pragma once

#include "runner/commands/lamp_command.h"

namespace fernlicht {

/// Prints the check; 0 when every row passes, else 1. Throws InputError.
int lamp_regulation(const LampRequest& request);

/// Prints the cut-off's figures; 0. Throws InputError.
int lamp_cut_off(const LampRequest& request);

/// Throws InputError where flags of these two are given without either.
void refuse_regulation_options(const LampRequest& request);

/// The flags of both.
void add_regulation_options(CLI::App& command, LampRequest& request);

} // namespace fernlicht
