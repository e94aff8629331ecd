// Intermediate picture between colour and relief: one grey of 16 bits and the flags of each pixel.
// Grey is 256 times the weighted 8-bit channels, so three channels give finer steps than one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "authoring/depth/depth_options.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

inline constexpr std::uint16_t kWhite = 255 * 256;

struct GreyPlane {
  int width = 0, height = 0;
  std::vector<std::uint16_t> grey;   // 0 … kWhite
  std::vector<std::uint8_t> imaged;  // 1 where tissue was imaged, 0 in the surround

  std::size_t Index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

// Flags of a pixel by its colours alone.
enum PixelFlag : std::uint8_t {
  kDark = 1,       // every channel below the surround's threshold
  kBlack = 2,      // every channel 0
  kSaturated = 4,  // every channel saturated
  kPale = 8,       // no channel below half of another: the colour of the light, not of tissue
};

// Computes greys by the weights of `options` (only their ratio counts) and the flags of every
// pixel. Marks no pixel as imaged.
GreyPlane GreyFromColour(const ColourImage& panorama, const DepthOptions& options,
                         std::vector<std::uint8_t>& flags);

// Runs `rows(first, last)` on strips of rows, in parallel. The strips do not depend on the number
// of threads, and each call writes only its own rows, so neither do the results.
void ForStripsOfRows(int height, const std::function<void(int first, int last)>& rows);

}  // namespace arthro::authoring
