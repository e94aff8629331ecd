#include "authoring/relief/joined_scale.h"

#include <cmath>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {

JoinedScale JoinScales(std::span<const ScalePart> parts) {
  constexpr double kMostApart = 0.10;  // largest difference of two factors
  double sum = 0, weights = 0;
  for (const ScalePart& part : parts) {
    for (const ScalePart& other : parts) {
      const double ratio = part.factor / other.factor;
      if (ratio > 1 + kMostApart)
        throw Error(
            Code::kBadArgument,
            fmt::format("the {} of {:g} mm and the {} of {:g} mm disagree by {:.0f} %, and at most "
                        "{:.0f} % is accepted; measure both again or leave one of them out",
                        part.source, MmFromMetres(part.metres), other.source,
                        MmFromMetres(other.metres), 100 * (ratio - 1), 100 * kMostApart));
    }
    const double weight = 1 / (part.sigma * part.sigma);
    sum += weight * std::log(part.factor);
    weights += weight;
  }
  return {std::exp(sum / weights), 1 / std::sqrt(weights)};
}

}  // namespace arthro::authoring
