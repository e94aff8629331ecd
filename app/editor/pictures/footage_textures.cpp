#include "app/editor/pictures/footage_textures.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GLFW/glfw3.h>

namespace arthro::app {

namespace {

constexpr GLint kClampToEdge = 0x812F;         // GL_CLAMP_TO_EDGE
constexpr GLenum kPixelUnpackBuffer = 0x88EC;  // GL_PIXEL_UNPACK_BUFFER
using GenerateMipmap = void (*)(GLenum);
using BindBuffer = void (*)(GLenum, GLuint);

}  // namespace

PictureTexture::PictureTexture(const ColourImage& picture) {
  if (picture.empty()) return;
  const auto generate_mipmap =
      reinterpret_cast<GenerateMipmap>(glfwGetProcAddress("glGenerateMipmap"));
  const auto bind_buffer = reinterpret_cast<BindBuffer>(glfwGetProcAddress("glBindBuffer"));
  // VTK and ImGui remember what is bound: all is left as it was found.
  GLint bound = 0, alignment = 4, row_length = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glGetIntegerv(GL_UNPACK_ROW_LENGTH, &row_length);
  bind_buffer(kPixelUnpackBuffer, 0);
  glGenTextures(1, &id_);
  glBindTexture(GL_TEXTURE_2D, id_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, kClampToEdge);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, kClampToEdge);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture.width, picture.height, 0, GL_RGB,
               GL_UNSIGNED_BYTE, picture.rgb.data());
  generate_mipmap(GL_TEXTURE_2D);
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, row_length);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
}

PictureTexture::~PictureTexture() {
  if (id_ != 0) glDeleteTextures(1, &id_);
}

PictureTexture::PictureTexture(PictureTexture&& other) noexcept
    : id_(std::exchange(other.id_, 0)) {}

PictureTexture& PictureTexture::operator=(PictureTexture&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

namespace {

constexpr std::size_t kMostKept = 160;  // textures; a few screens full of small pictures
constexpr long long kLargeKept = 2;     // frames that one of more than so many pixels is kept
constexpr int kLargePixels = 256 * 256;

}  // namespace

unsigned FootageTextures::IdOf(const SharedPicture& picture) {
  if (!picture || picture->empty()) return 0;
  const auto [at, is_new] = entries_.try_emplace(picture.get());
  Entry& entry = at->second;
  if (is_new) {
    entry.picture = picture;
    entry.texture = PictureTexture(*picture);
    ++uploads_;
  }
  entry.shown = now_;
  return entry.texture.id();
}

void FootageTextures::EndFrame() {
  std::erase_if(entries_, [&](const auto& item) {
    const Entry& entry = item.second;
    const bool is_large = entry.picture->width * entry.picture->height > kLargePixels;
    return is_large ? now_ - entry.shown > kLargeKept
                    : entries_.size() > kMostKept && entry.shown < now_;
  });
}

}  // namespace arthro::app
