// The pictures of the footage board as textures: uploaded when they are first shown, and never
// again while they stay the same. Of the small ones only those in sight, and some beside them, are
// kept. Needs the window's OpenGL context.
#pragma once

#include <map>

#include "app/steps/panorama/board/footage_board.h"
#include "simulation/scene/image.h"

namespace arthro::app {

// A picture as an OpenGL texture for Dear ImGui: first row at v = 0, smooth when it is shown
// smaller. Is destroyed in the window's context.
class PictureTexture {
 public:
  PictureTexture() = default;
  explicit PictureTexture(const ColourImage& picture);
  ~PictureTexture();
  PictureTexture(PictureTexture&& other) noexcept;
  PictureTexture& operator=(PictureTexture&& other) noexcept;

  unsigned id() const { return id_; }  // 0: none

 private:
  unsigned id_ = 0;
};

// Textures of the pictures in sight, and of some beside them.
class FootageTextures {
 public:
  void BeginFrame() { ++now_; }

  // 0 for a null picture.
  unsigned IdOf(const SharedPicture& picture);

  // Lets go of what was not shown lately.
  void EndFrame();

  int uploads() const { return uploads_; }  // so far

 private:
  struct Entry {
    SharedPicture picture;  // held, so that its address means it
    PictureTexture texture;
    long long shown = 0;  // when last
  };
  std::map<const ColourImage*, Entry> entries_;
  long long now_ = 0;
  int uploads_ = 0;
};

}  // namespace arthro::app
