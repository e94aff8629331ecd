#include "authoring/footage/picture_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::string_view DigitsAt(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && IsDigit(text[end])) ++end;
  return text.substr(at, end - at);
}

std::string_view WithoutZeros(std::string_view digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == digits.npos ? std::string_view() : digits.substr(first);
}

std::vector<std::string> FilesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    std::error_code ignored;
    if (!entry->is_directory(ignored)) names.push_back(entry->path().filename().string());
  }
  if (fault)
    throw Error(Code::kFile,
                "this folder could not be listed: " + fault.message() + "; check its permissions",
                folder);
  std::sort(names.begin(), names.end(), ComesBefore);
  return names;
}

// Text before and after the number of a pattern, and the least number of its digits.
struct Pattern {
  std::string before, after;
  std::size_t width = 1;

  bool Fits(std::string_view name) const {
    if (name.size() < before.size() + after.size() + width || !name.starts_with(before) ||
        !name.ends_with(after))
      return false;
    const auto digits = name.substr(before.size(), name.size() - before.size() - after.size());
    return DigitsAt(digits, 0).size() == digits.size() &&
           (digits.size() == width ||
            digits.front() != '0');  // printf writes no leading zero beyond the width
  }
};

std::optional<Pattern> ParsePattern(const std::string& name) {
  Pattern pattern;
  std::string* part = &pattern.before;
  bool has_number = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '%') {
      *part += name[i];
      continue;
    }
    if (i + 1 < name.size() && name[i + 1] == '%') {
      *part += '%';
      ++i;
      continue;
    }
    const std::string_view digits = DigitsAt(name, i + 1);
    const std::size_t letter = i + 1 + digits.size();
    if (has_number || digits.size() > 2 || letter >= name.size() || name[letter] != 'd')
      return std::nullopt;
    if (digits.size() > 1 || (digits.size() == 1 && digits != "0"))
      pattern.width = static_cast<std::size_t>(std::stoi(std::string(digits)));
    has_number = true;
    part = &pattern.after;
    i = letter;
  }
  if (!has_number) return std::nullopt;
  return pattern;
}

}  // namespace

bool IsPictureName(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 11> kEndings = {
      ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp", ".pgm", ".ppm", ".pnm", ".dib"};
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

bool ComesBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const auto da = DigitsAt(a, i), db = DigitsAt(b, j);
      const auto na = WithoutZeros(da), nb = WithoutZeros(db);
      if (na.size() != nb.size()) return na.size() < nb.size();
      if (na != nb) return na < nb;
      i += da.size();
      j += db.size();
    } else {
      if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

std::vector<fs::path> PicturesIn(const fs::path& folder) {
  std::vector<fs::path> pictures;
  const auto names = FilesIn(folder);
  for (const std::string& name : names)
    if (!name.starts_with(".") && IsPictureName(name)) pictures.push_back(folder / name);
  if (pictures.empty())
    throw Error(Code::kBadImage,
                names.empty() ? "this folder is empty; name one that holds pictures, or a video"
                              : fmt::format("this folder holds no pictures, only files such as "
                                            "{}; name a folder of pictures, or a video",
                                            names.front()),
                folder);
  return pictures;
}

std::vector<fs::path> PicturesOf(const fs::path& pattern) {
  const auto parsed = ParsePattern(pattern.filename().string());
  if (!parsed)
    throw Error(Code::kBadArgument,
                "a pattern has one number in the file's name, as in frames/%04d.png", pattern);
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(Code::kFile, "the folder of this pattern does not exist; check the name", pattern);
  std::vector<fs::path> pictures;
  for (const std::string& name : FilesIn(folder))
    if (parsed->Fits(name)) pictures.push_back(folder / name);
  if (pictures.empty())
    throw Error(Code::kBadImage, "no file has a name of this pattern; check the name", pattern);
  return pictures;
}

}  // namespace arthro::authoring
