// On what a benchmark ran.
#pragma once

#include <string>

namespace arthro::app {

std::string MachineWords();  // processor, cores, build type, compiler

}  // namespace arthro::app
