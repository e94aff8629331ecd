// The pictures of the footage board as textures: uploaded when they are first shown, and never
// again while they stay the same. Of the small ones only those in sight, and some beside them, are
// kept. Needs the window's OpenGL context.
#pragma once

#include <map>

#include "app/editor/picture_texture.h"
#include "app/steps/panorama/footage_board.h"

namespace arthro::app {

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
