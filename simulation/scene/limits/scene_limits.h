// Ranges and rules that several fields of scene files share.
#pragma once

#include <span>

#include "simulation/core/options.h"

namespace arthro {

// A joint is centimetres wide, so a length of metres means that millimetres were written. m
inline constexpr Range kLength{0, 2, true};
inline constexpr Range kCoordinate{-2, 2};
inline constexpr Range kShare{0, 1};

// Rules of fields that only files of scenes, rigs and lenses have.
struct Words {  // text that is one of these
  std::span<const char* const> words;
};
// Text that tells the elements of a list apart, so it is required and used once.
struct Name {
  std::span<const char* const> reserved = {};
  const char* reserved_for = "";
  bool is_table_cell = false;  // without commas, quotes and line breaks
};
struct Direction {  // vector of any length but zero
  Range each;
};
struct NumberList {};  // finite numbers, however many
struct TextList {};    // texts that are not empty, however many
struct PointList {
  int least, most;
  Range each;
};

}  // namespace arthro
