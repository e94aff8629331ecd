// A film while it is recorded, and what becomes of it when the program died meanwhile. It stands
// beside its target as .STEM.PID.recording.EXT, readable by its owner alone and locked by the
// program that records. The next program that finds it unlocked puts its whole pictures in place,
// under the intended name or, where that is taken, as STEM-recovered.EXT.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/recording/film_stream.h"

namespace arthro::app {

class UnfinishedFilm {
 public:
  // Throws Error(kFile) as PartialFile, and where this process records there already.
  explicit UnfinishedFilm(const std::filesystem::path& target);
  // Removes the file unless PutWholeInPlace was called.
  ~UnfinishedFilm();
  UnfinishedFilm(const UnfinishedFilm&) = delete;
  UnfinishedFilm& operator=(const UnfinishedFilm&) = delete;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& beside() const { return beside_; }

  // It is not needed any more.
  void Remove();
  // Puts what is whole up to `bytes` in place without replacing anything, and returns where.
  // Throws Error(kFile): it then stays under beside().
  std::filesystem::path PutWholeInPlace(off_t bytes);

 private:
  std::filesystem::path target_, beside_;
  int descriptor_ = -1;
  bool is_kept_ = false;
};

// Finishes the films of this user in `folder` whose programs are dead. A sentence for each.
// `wanted`: a film that is about to be recorded; its name counts as taken.
std::vector<std::string> FinishFilmsIn(const std::filesystem::path& folder,
                                       const std::filesystem::path& wanted = {});

// The folders in which films are recorded, in $XDG_STATE_HOME/arthroscene/recordings or below
// ~/.local/state, so that a later start anywhere finds what a dead program left there. A list that
// cannot be read or written is no fault.
void NoteRecordingFolder(const std::filesystem::path& folder);
// FinishFilmsIn each of them and beside `wanted`; forgets those in which nothing is recorded now.
std::vector<std::string> FinishFilmsEverywhere(const std::filesystem::path& wanted = {});

}  // namespace arthro::app
