// One of our pictures as an OpenGL texture for Dear ImGui: first row at v = 0, smooth when it is
// shown smaller. Needs the window's context, its end too.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::app {

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

}  // namespace arthro::app
