// Progress and Ctrl-C for jobs on the command line.
#pragma once

#include "simulation/core/progress.h"

namespace arthro::app {

// A Progress that draws one line on stderr when that is a terminal, and stops on SIGINT or SIGTERM.
Progress TerminalProgress();

}  // namespace arthro::app
