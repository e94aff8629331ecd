// Machine and build of a benchmark.
#pragma once

#include <string>

namespace arthro::app {

std::string MachineWords();  // processor, cores, build type, compiler

}  // namespace arthro::app
