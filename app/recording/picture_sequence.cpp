#include "app/recording/picture_sequence.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark =
    "These pictures are of a recording that goes on, or that was cut short: the last one may not "
    "be whole, and some may be missing after it.\n";

// Not flushed to the disk one by one, which a film's pace would not bear. For its owner alone.
void WriteBytes(const fs::path& file, std::string_view bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  std::FILE* stream = descriptor >= 0 ? ::fdopen(descriptor, "wb") : nullptr;
  bool is_whole =
      stream != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
  int error = errno;
  if (stream != nullptr && std::fclose(stream) != 0) {
    if (is_whole) error = errno;
    is_whole = false;
  }
  if (!is_whole)
    throw Error(Code::kFile, "this picture was not written: " + WhyNotWritten(error), file);
}

}  // namespace

fs::path PictureNames::At(int number) const {
  return folder / fmt::format("{}{:0{}}{}", before, number, digits, after);
}

std::optional<PictureNames> PictureNamesOf(const fs::path& target) {
  std::error_code ignored;
  if (target.filename().empty() || fs::is_directory(target, ignored))
    return PictureNames{target.filename().empty() ? target.parent_path() : target, "frame_", ".png",
                        5};
  if (target.extension() != ".png") return std::nullopt;
  const std::string name = target.filename().string();
  // One %0Nd, N a digit.
  const std::size_t at = name.find('%');
  if (at == std::string::npos || name.find('%', at + 1) != std::string::npos ||
      name.size() < at + 4 || name[at + 1] != '0' || name[at + 2] < '1' || name[at + 2] > '9' ||
      name[at + 3] != 'd')
    throw Error(Code::kBadArgument,
                "pictures are numbered: name them as in frame-%04d.png, or give a folder/", target);
  const fs::path folder = target.parent_path();
  return PictureNames{folder.empty() ? fs::path(".") : folder, name.substr(0, at),
                      name.substr(at + 4), name[at + 2] - '0'};
}

void CheckPictureFolder(const PictureNames& names) {
  std::error_code fault;
  const fs::path& folder = names.folder;
  if (!fs::exists(folder, fault)) {
    const fs::path above = fs::absolute(folder).lexically_normal().parent_path();
    if (!fs::is_directory(above, fault))
      throw Error(Code::kFile,
                  fmt::format("the folder {} does not exist; create it first", above.string()),
                  folder);
    return;
  }
  if (!fs::is_directory(folder, fault))
    throw Error(Code::kFile, "this is a file; pictures are recorded into a folder, name a new one",
                folder);
  const bool is_empty = fs::is_empty(folder, fault);
  if (fault)
    throw Error(Code::kFile, "this folder cannot be read: " + fault.message() + "; choose another",
                folder);
  if (!is_empty)
    throw Error(Code::kFile,
                "this folder is not empty; pictures are recorded into an empty one, name a new one",
                folder);
}

PictureSequence::PictureSequence(PictureNames names) : names_(std::move(names)) {
  CheckPictureFolder(names_);
  std::error_code fault;
  made_folder_ = fs::create_directory(names_.folder, fault);
  if (fault)
    throw Error(Code::kFile,
                "this folder could not be made: " + fault.message() + "; choose another",
                names_.folder);
  WriteBytes(names_.folder / kIncomplete, kMark);
}

void PictureSequence::Add(const ColourImage& picture) {
  if (bytes_.empty() || picture.rgb != last_.rgb) {
    bytes_ = PngFromColourImage(picture);
    last_ = picture;
  }
  WriteBytes(names_.At(count_), bytes_);
  ++count_;
}

void PictureSequence::Finish() {
  std::error_code ignored;
  if (count_ == 0) {
    fs::remove(names_.folder / kIncomplete, ignored);
    if (made_folder_) fs::remove(names_.folder, ignored);
    throw Error(Code::kFile, "this recording has no picture, so nothing was written",
                names_.folder);
  }
  // All of them before the mark goes.
  const int descriptor = ::open(names_.folder.c_str(), O_RDONLY | O_DIRECTORY);
  const bool is_flushed = descriptor >= 0 && ::syncfs(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!is_flushed)
    throw Error(Code::kFile, "these pictures may not be whole: " + WhyNotWritten(error),
                names_.folder);
  fs::remove(names_.folder / kIncomplete, ignored);
}

}  // namespace arthro::app
