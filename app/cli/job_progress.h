// Progress and Ctrl-C for jobs on the command line.
#pragma once

#include "simulation/core/progress.h"

namespace arthro::app {

// A Progress that draws one line on stderr when that is a terminal, and stops on SIGINT, SIGTERM or
// SIGHUP, the last unless the program was started with it ignored.
Progress TerminalProgress();

}  // namespace arthro::app
