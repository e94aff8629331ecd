// Messages from a running job to the window: thumbnails, the status of frames, the growing mosaic.
// The job's thread puts them in, the window's thread takes them out once per frame. The lock is
// held only while a few pointers move.
#pragma once

#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "app/steps/panorama/board/footage_board.h"
#include "authoring/footage/footage.h"

namespace arthro::app {

struct FootageClip {
  authoring::Clips files;
  authoring::FootageInfo info;
};

struct FootageNews {
  std::optional<FootageClip> clip;   // it could be opened
  std::optional<LensCircle> circle;  // the round window, once enough frames were seen
  std::vector<std::pair<int, SharedPicture>> thumbs;
  std::vector<std::pair<int, FrameNote>> notes;
  SharedPicture mosaic;                                  // the newest one
  std::shared_ptr<const authoring::ReliefSoFar> motion;  // the newest one
};

class FootageMail {
 public:
  void PutClip(FootageClip clip) {
    const std::lock_guard lock(mutex_);
    news_.clip = std::move(clip);
  }
  void PutCircle(const LensCircle& circle) {
    const std::lock_guard lock(mutex_);
    news_.circle = circle;
  }
  void PutThumb(int frame, SharedPicture thumb) {
    const std::lock_guard lock(mutex_);
    news_.thumbs.emplace_back(frame, std::move(thumb));
  }
  void PutNote(int frame, FrameNote note) {
    const std::lock_guard lock(mutex_);
    news_.notes.emplace_back(frame, std::move(note));
  }
  void PutMosaic(SharedPicture mosaic) {
    const std::lock_guard lock(mutex_);
    news_.mosaic = std::move(mosaic);
  }
  void PutReliefSoFar(std::shared_ptr<const authoring::ReliefSoFar> motion) {
    const std::lock_guard lock(mutex_);
    news_.motion = std::move(motion);
  }
  FootageNews Take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
  }

 private:
  std::mutex mutex_;
  FootageNews news_;
};

}  // namespace arthro::app
