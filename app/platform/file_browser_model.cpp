#include "app/platform/file_browser_model.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The nearest folder at or above `start` that exists.
fs::path ExistingFolder(const fs::path& start) {
  std::error_code ignored;
  fs::path folder = fs::absolute(start.empty() ? fs::path(".") : start, ignored).lexically_normal();
  while (!fs::is_directory(folder, ignored) && folder.has_relative_path())
    folder = folder.parent_path();
  if (folder.filename().empty() && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

// "~" and relative names as a person types them.
fs::path Typed(const fs::path& folder, const std::string& text) {
  if (text == "~" || text.starts_with("~/"))
    if (const char* home = std::getenv("HOME"))
      return fs::path(home) / text.substr(text.size() > 1 ? 2 : 1);
  return (folder / text).lexically_normal();
}

}  // namespace

FileBrowserModel::FileBrowserModel(BrowseFor purpose, std::vector<FileFilter> filters,
                                   const fs::path& start, std::string name)
    : file_name(std::move(name)), purpose_(purpose), filters_(std::move(filters)) {
  folder_ = ExistingFolder(start);
  Refresh();
}

bool FileBrowserModel::Matches(const fs::path& file) const {
  if (filters_.empty() || filters_[filter_].extensions.empty()) return true;
  const auto& extensions = filters_[filter_].extensions;
  return std::find(extensions.begin(), extensions.end(), Lower(file.extension().string())) !=
         extensions.end();
}

void FileBrowserModel::GoTo(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator probe(folder, error);
  if (error) {
    problem_ = folder.string() + " cannot be opened: " + error.message() + ".";
    return;
  }
  folder_ = ExistingFolder(folder);
  Refresh();
}

void FileBrowserModel::GoUp() {
  if (folder_.has_relative_path()) GoTo(folder_.parent_path());
}

void FileBrowserModel::Refresh() {
  entries_.clear();
  problem_.clear();
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    FileEntry entry{it->path()};
    const std::string name = entry.name();
    if (!show_hidden_ && name.starts_with(".")) continue;
    std::error_code ignored;
    entry.is_folder = it->is_directory(ignored);
    if (const auto changed = it->last_write_time(ignored); !ignored)
      entry.changed = std::chrono::system_clock::to_time_t(
          std::chrono::time_point_cast<std::chrono::system_clock::duration>(
              std::chrono::file_clock::to_sys(changed)));
    if (entry.is_folder) entry.is_scene = fs::exists(it->path() / "scene.json", ignored);
    if (!entry.is_folder) {
      if (!Matches(entry.path)) continue;
      entry.bytes = it->file_size(ignored);
      if (ignored) entry.bytes = 0;
    }
    entries_.push_back(std::move(entry));
  }
  if (error) problem_ = folder_.string() + " cannot be read: " + error.message() + ".";
  std::sort(entries_.begin(), entries_.end(), [](const FileEntry& a, const FileEntry& b) {
    if (a.is_folder != b.is_folder) return a.is_folder;
    const std::string a_name = Lower(a.name()), b_name = Lower(b.name());
    return a_name != b_name ? a_name < b_name : a.name() < b.name();
  });
}

void FileBrowserModel::SetFilter(std::size_t index) {
  if (index >= filters_.size()) return;
  filter_ = index;
  Refresh();
}

void FileBrowserModel::ShowHidden(bool show) {
  show_hidden_ = show;
  Refresh();
}

void FileBrowserModel::Select(const FileEntry& entry) {
  problem_.clear();
  if (!entry.is_folder || purpose_ != BrowseFor::kSaveFile) file_name = entry.name();
}

bool FileBrowserModel::Type(char letter, double time) {
  constexpr double kPause = 1.0;  // s
  if (time - typed_at_ > kPause) typed_.clear();
  typed_at_ = time;
  typed_ += letter;
  const std::string wanted = Lower(typed_);
  for (const FileEntry& entry : entries_)
    if (Lower(entry.name()).starts_with(wanted)) {
      Select(entry);
      return true;
    }
  return false;
}

bool FileBrowserModel::CreateFolder(const std::string& name) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos) {
    problem_ = "A folder needs a name without \"/\".";
    return false;
  }
  std::error_code error;
  const fs::path created = folder_ / name;
  if (fs::exists(created, error)) {
    problem_ = "\"" + name + "\" is already there.";
    return false;
  }
  if (!fs::create_directory(created, error)) {
    problem_ = "\"" + name + "\" cannot be made here: " + error.message() + ".";
    return false;
  }
  GoTo(created);
  return true;
}

Acceptance FileBrowserModel::Accept() {
  problem_.clear();
  const bool opens = purpose_ == BrowseFor::kOpenFile || purpose_ == BrowseFor::kOpenFileOrFolder;
  if (file_name.empty()) {
    problem_ = opens ? "Choose a file first." : "Type a name first.";
    return Acceptance::kNothing;
  }
  fs::path path = Typed(folder_, file_name);
  std::error_code error;
  if (purpose_ == BrowseFor::kSaveFolder && fs::is_directory(path, error)) {
    if (fs::exists(path / "scene.json", error)) {
      accepted_ = path;
      return Acceptance::kOverwrite;
    }
    if (fs::is_empty(path, error)) return Finish(path);
  }
  if (fs::is_directory(path, error)) {
    GoTo(path);
    if (problem_.empty()) file_name.clear();
    return problem_.empty() ? Acceptance::kEntered : Acceptance::kNothing;
  }
  if (opens) {
    if (!fs::exists(path, error)) {
      problem_ = "\"" + file_name + "\" is not in this folder.";
      return Acceptance::kNothing;
    }
    return Finish(path);
  }
  // Saving: the extension is added, the folder must be there, and an old file is asked about.
  if (purpose_ == BrowseFor::kSaveFile && path.extension().empty() && !filters_.empty() &&
      !filters_[filter_].extensions.empty())
    path += filters_[filter_].extensions.front();
  if (!fs::is_directory(path.parent_path(), error)) {
    problem_ = "The folder " + path.parent_path().string() + " is not there.";
    return Acceptance::kNothing;
  }
  if (fs::exists(path, error)) {
    accepted_ = path;
    return Acceptance::kOverwrite;
  }
  return Finish(path);
}

Acceptance FileBrowserModel::AcceptOverwrite() {
  return accepted_.empty() ? Acceptance::kNothing : Acceptance::kDone;
}

Acceptance FileBrowserModel::AcceptFolder() {
  const auto is_file = [](const FileEntry& entry) { return !entry.is_folder; };
  if (std::any_of(entries_.begin(), entries_.end(), is_file)) return Finish(folder_);
  problem_ = "This folder has no file of the kind that is asked for; choose another folder.";
  return Acceptance::kNothing;
}

Acceptance FileBrowserModel::Finish(const fs::path& path) {
  accepted_ = path;
  return Acceptance::kDone;
}

std::vector<BrowsePlace> BrowsePlaces(const fs::path& home, const std::vector<fs::path>& recent,
                                      const fs::path& root) {
  std::vector<BrowsePlace> places;
  const auto add = [&](const std::string& words, const fs::path& folder) {
    std::error_code ignored;
    const bool is_known = std::any_of(places.begin(), places.end(), [&](const BrowsePlace& place) {
      return place.folder == folder;
    });
    if (!folder.empty() && !is_known && fs::is_directory(folder, ignored))
      places.push_back({words, folder});
  };
  add("Home", home);
  for (const char* name : {"Desktop", "Documents", "Downloads", "Pictures", "Videos"})
    if (!home.empty()) add(name, home / name);
  for (const fs::path& scene : recent)
    add(scene.parent_path().filename().string(), scene.parent_path());
  // Drives and sticks: /media/USER/NAME, /run/media/USER/NAME and /mnt/NAME.
  for (const char* base : {"media", "run/media", "mnt"}) {
    std::error_code error;
    const bool is_by_user = std::string_view(base) != "mnt";
    for (fs::directory_iterator it(root / base, error), end; !error && it != end;
         it.increment(error)) {
      if (!is_by_user) {
        add(it->path().filename().string(), it->path());
        continue;
      }
      std::error_code inner;
      for (fs::directory_iterator drive(it->path(), inner), last; !inner && drive != last;
           drive.increment(inner))
        add(drive->path().filename().string(), drive->path());
    }
  }
  add("Computer", root);
  return places;
}

std::string WordsForTime(std::time_t time) {
  std::tm local{};
  if (time == 0 || localtime_r(&time, &local) == nullptr) return "";
  char words[32];
  return std::string(words, std::strftime(words, sizeof words, "%Y-%m-%d %H:%M", &local));
}

std::string WordsForBytes(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  const char* units[] = {"kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  while (value >= 999.95 && unit + 1 < std::size(units)) value /= 1000.0, ++unit;
  return fmt::format("{:.1f} {}", value, units[unit]);
}

}  // namespace arthro::app
