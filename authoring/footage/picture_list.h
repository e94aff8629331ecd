// Lists the pictures of a folder or of a printf pattern by number: frame 2 comes before frame 10,
// whatever the number of leading zeros.
#pragma once

#include <filesystem>
#include <vector>

namespace arthro::authoring {

// Judges by the extension alone: .png, .jpg, .tif, .bmp, .webp and their variants.
bool IsPictureName(const std::filesystem::path& file);

// "frame2" < "frame10" < "frame10b"; names that differ only in zeros are ordered by their zeros.
bool ComesBefore(const std::string& a, const std::string& b);

// Lists the pictures directly in `folder`, without other files and hidden ones. Throws
// Error(kBadImage) when there is none.
std::vector<std::filesystem::path> PicturesIn(const std::filesystem::path& folder);

// Lists every file that `pattern` ("frames/%04d.png") can name, by number; numbers may be missing.
// Throws Error(kBadArgument) for a pattern with no number or several, Error(kBadImage) when no file
// matches.
std::vector<std::filesystem::path> PicturesOf(const std::filesystem::path& pattern);

}  // namespace arthro::authoring
