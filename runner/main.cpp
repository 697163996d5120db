// fernlicht: night drives played headless, headlamps measured.
#include "runner/commands/commands.h"

int main(int argc, char** argv) { return fernlicht::command_line(argc, argv); }
