// The place in a container of a thing counted by an int, for OpenCV and Eigen count with int and
// the standard library with std::size_t. Below zero it is not a place, and nothing asks.
#pragma once

#include <cstddef>

namespace arthro {

constexpr std::size_t At(int i) { return static_cast<std::size_t>(i); }

}  // namespace arthro
