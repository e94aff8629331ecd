#include "app/cli/command_line.h"

int main(int argc, char** argv) { return arthro::app::RunCommandLine(argc, argv); }
