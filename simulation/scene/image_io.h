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
void WriteDepthMap(const std::filesystem::path& file, const DepthMap& depth);

// Throws Error(kBadScene) when the two do not have the same size.
void RequireSameSize(const ColourImage& panorama, const DepthMap& depth,
                     const std::filesystem::path& depth_file);

}  // namespace arthro
