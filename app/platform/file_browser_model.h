// The file browser without its looks: which folder is open, what it holds, which entry is chosen,
// and whether the choice can be taken. A fault (no permission, a folder that went away) is a
// sentence in `problem`, never an exception: the user stays where they were. Pure std::filesystem.
#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace arthro::app {

// Files that may be chosen: `words` as shown, extensions lower case with the dot. No extension:
// every file.
struct FileFilter {
  std::string words;
  std::vector<std::string> extensions;
};

enum class BrowseFor { kOpenFile, kOpenFileOrFolder, kSaveFile, kSaveFolder };

struct FileEntry {
  std::filesystem::path path;
  bool is_folder = false;
  bool is_scene = false;  // a folder with a scene.json
  std::uintmax_t bytes = 0;
  std::time_t changed = 0;  // when it was last written; 0: not known
  std::string name() const { return path.filename().string(); }
};

// Result of pressing the accept button.
enum class Acceptance {
  kNothing,    // no name yet, or `problem` says why not
  kEntered,    // the choice was a folder, which is open now
  kOverwrite,  // the file exists; ask, then call AcceptOverwrite
  kDone,       // `accepted` holds the path
};

class FileBrowserModel {
 public:
  // Starts in `start` (its folder, if it is a file), or the nearest folder above it that exists.
  // With kSaveFile a name without an extension gets the first filter's first one; with kSaveFolder
  // the name is that of a folder, new or empty, or of one that holds `scene.json`, which is asked
  // about.
  FileBrowserModel(BrowseFor purpose, std::vector<FileFilter> filters,
                   const std::filesystem::path& start, std::string file_name = {});

  void GoTo(const std::filesystem::path& folder);
  void GoUp();
  void Refresh();
  void SetFilter(std::size_t index);
  void ShowHidden(bool show);
  void Select(const FileEntry& entry);
  // A letter typed over the list at a time in s: selects the first entry whose name begins with the
  // letters typed since the last pause, whatever their case. False where there is none.
  bool Type(char letter, double time);
  bool CreateFolder(const std::string& name);  // and opens it
  Acceptance Accept();
  Acceptance AcceptOverwrite();
  Acceptance AcceptFolder();  // the one that is open; with kOpenFileOrFolder

  BrowseFor purpose() const { return purpose_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<FileEntry>& entries() const { return entries_; }
  const std::vector<FileFilter>& filters() const { return filters_; }
  std::size_t filter() const { return filter_; }
  bool shows_hidden() const { return show_hidden_; }
  const std::string& problem() const { return problem_; }
  const std::filesystem::path& accepted() const { return accepted_; }

  std::string file_name;  // typed or chosen; a path is understood too

 private:
  bool Matches(const std::filesystem::path& file) const;
  Acceptance Finish(const std::filesystem::path& path);

  BrowseFor purpose_;
  std::vector<FileFilter> filters_;
  std::size_t filter_ = 0;
  bool show_hidden_ = false;
  std::filesystem::path folder_, accepted_;
  std::vector<FileEntry> entries_;
  std::string problem_;
  std::string typed_;
  double typed_at_ = 0;
};

// Folders that are one step away: home and those that it usually has, the folders of the recent
// scenes, drives and sticks, and the root. Those that are there, each once.
struct BrowsePlace {
  std::string words;  // "Home", or the folder's name
  std::filesystem::path folder;
};
std::vector<BrowsePlace> BrowsePlaces(const std::filesystem::path& home,
                                      const std::vector<std::filesystem::path>& recent,
                                      const std::filesystem::path& root = "/");

// "2026-11-23 16:45", local time; "" where it is not known.
std::string WordsForTime(std::time_t time);

// "812 B", "3.4 MB".
std::string WordsForBytes(std::uintmax_t bytes);

}  // namespace arthro::app
