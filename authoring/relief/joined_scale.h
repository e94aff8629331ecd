// The scale of a reconstruction from lengths that its author knows. Motion gives ratios of lengths;
// one known length makes them metres. Several are joined as the weighted mean of the logarithms of
// their factors.
#pragma once

#include <span>
#include <string>

namespace arthro::authoring {

// The scale by one known length.
struct ScalePart {
  std::string source;  // "length" or "instrument"
  double metres = 0;
  double factor = 1;  // metres per metre of the reconstruction
  double sigma = 0;   // standard error of the factor's logarithm, from the pixels that were named
};

struct JoinedScale {
  double factor = 1, sigma = 0;  // sigma: of the factor's logarithm
};

// Throws Error(kBadArgument) where two parts differ by more than 10 %. Needs one part.
JoinedScale JoinScales(std::span<const ScalePart> parts);

}  // namespace arthro::authoring
