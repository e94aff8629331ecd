// Pictures from and to files; the one place where BGR is swapped. Every error names the file, what
// is wrong with it and what to do.
#pragma once

#include <filesystem>
#include <string>

#include "simulation/scene/image.h"

namespace arthro {

// PNG, JPEG, TIFF, BMP, WebP or PNM as 8-bit RGB: grey is spread over the channels, 16 bit is
// scaled down, alpha is dropped. Throws Error(kBadImage) for a missing, cut off, damaged or
// unreadable file, and for more than 16k x 16k pixels before they are decoded.
ColourImage ReadColourImage(const std::filesystem::path& file);

// Format by extension; written atomically. JPEG at quality 95.
void WriteColourImage(const std::filesystem::path& file, const ColourImage& image);

// The bytes of a PNG file, packed quickly rather than well.
std::string PngFromColourImage(const ColourImage& image);

// One-channel 32-bit float TIFF, metres. Throws Error(kBadImage) for anything else, and for depths
// that are infinite or beyond 10 m.
DepthMap ReadDepthMap(const std::filesystem::path& file);
// kQuick leaves the file as large as the map: for a copy that must be on disk at once.
enum class DepthPacking { kSmall, kQuick };
void WriteDepthMap(const std::filesystem::path& file, const DepthMap& depth,
                   DepthPacking packing = DepthPacking::kSmall);

// Standard error of a depth map in the same form. Throws Error(kBadImage) for anything else, and
// for values that are negative, infinite or beyond 10 m. Written by WriteDepthMap.
DepthMap ReadDepthSigma(const std::filesystem::path& file);

// One-channel 8-bit PNG of the numbers of ReliefOrigin. Throws Error(kBadImage) for anything else.
OriginMap ReadOriginMap(const std::filesystem::path& file);
void WriteOriginMap(const std::filesystem::path& file, const OriginMap& origins);

// Throws Error(kBadScene) when the two do not have the same size.
void RequireSameSize(const ColourImage& panorama, const DepthMap& depth,
                     const std::filesystem::path& depth_file);
void RequireSameSize(const DepthMap& depth, const DepthMap& sigma,
                     const std::filesystem::path& sigma_file);
void RequireSameSize(const DepthMap& depth, const OriginMap& origins,
                     const std::filesystem::path& origin_file);

}  // namespace arthro
