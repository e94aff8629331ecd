// Depth maps of other programs: grey pictures of 8 or 16 bits (PNG, TIFF) and of floating point
// (TIFF, EXR), whose unit and range a person knows. They become a relief over the sphere of the
// backdrop. Lengths in m.
#pragma once

#include <filesystem>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

enum class DepthMeaning {
  kRange,   // distance from the scope portal
  kRelief,  // height over the backdrop, towards the portal
};

struct DepthImportOptions {
  DepthMeaning meaning = DepthMeaning::kRange;
  double low = 0.03;
  double high = 0.05;
  double unit = 1e-3;
  bool is_zero_unknown = true;
  template <class V>
  void Visit(V&& v) {
    v("import_meaning", meaning,
      Choices<DepthMeaning>{{{DepthMeaning::kRange, "range"}, {DepthMeaning::kRelief, "relief"}}},
      "", "range: distance from the scope portal. relief: height over the backdrop.");
    v("import_low", low, Range{-0.5, 2}, "m", "Length of the value 0 of a map of whole numbers.");
    v("import_high", high, Range{-0.5, 2}, "m",
      "Length of the largest value of a map of whole numbers.");
    v("import_unit", unit, Range{1e-9, 10}, "",
      "Metres per unit of a map of floating-point numbers.");
    v("import_zero_unknown", is_zero_unknown, Any{}, "",
      "The value 0 means that no depth is known.");
  }
};

// Numbers of a picture of one channel, as its file has them.
struct GreyNumbers {
  int width = 0, height = 0;
  double white = 0;  // value of white: 255 or 65535; 0: floating point
  std::vector<float> values;
};

// Throws Error(kBadImage) for a file that cannot be read, and for colours.
GreyNumbers ReadGreyNumbers(const std::filesystem::path& file);

// The relief over a backdrop of that radius; NaN where no depth is known. Throws Error(kBadImage)
// where the size is not that of the panorama, or where the surface would lie behind the portal
// because the unit or range is wrong, and says what the file would mean.
DepthMap ReliefFromNumbers(const GreyNumbers& numbers, const DepthImportOptions& options,
                           double radius, int width, int height, const std::filesystem::path& file);

}  // namespace arthro::authoring
