#include "app/editor/footage_textures.h"

namespace arthro::app {
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
