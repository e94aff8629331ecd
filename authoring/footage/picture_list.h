// Which files a folder or a printf pattern of pictures means, in the order of their numbers:
// frame 2 comes before frame 10 however many zeros there are.
#pragma once

#include <filesystem>
#include <vector>

namespace arthro::authoring {

// By the name's ending alone: .png, .jpg, .tif, .bmp, .webp and their kin.
bool IsPictureName(const std::filesystem::path& file);

// "frame2" < "frame10" < "frame10b"; names that differ in zeros only are ordered by them.
bool ComesBefore(const std::string& a, const std::string& b);

// The pictures directly in `folder`; other files and hidden ones are passed over. Throws
// Error(kBadImage) when there is none.
std::vector<std::filesystem::path> PicturesIn(const std::filesystem::path& folder);

// Every file that `pattern` ("frames/%04d.png") can name, by its number; numbers may be left out.
// Throws Error(kBadArgument) for a pattern with no number or several, Error(kBadImage) when no
// file fits.
std::vector<std::filesystem::path> PicturesOf(const std::filesystem::path& pattern);

}  // namespace arthro::authoring
