// Fuzz target: pieces of the tissue track of an attempt. Each piece of the input is its kind, its
// tissue, the size of its body in two bytes, and the body before it is deflated.
#include "simulation/training/track/deflated.h"
#include "simulation/training/track/tissue_track.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  using namespace arthro::simulation;
  constexpr std::size_t kMostPieces = 40;  // a longer input shows nothing new
  std::string_view bytes = test::TextOf(data, size);
  std::vector<TrackPiece> pieces;
  PieceHead head;
  std::uint16_t body = 0;
  while (pieces.size() < kMostPieces && TakePieceHead(bytes, head) && TakeBytes(bytes, body)) {
    const std::string raw(bytes.substr(0, body));
    bytes.remove_prefix(raw.size());
    pieces.push_back(MakePiece(static_cast<double>(pieces.size()), head, Deflated(raw)));
  }
  TissueTrack track(pieces);
  // Forward and back, so that pieces are read after each other and from the last whole skin.
  const auto last = static_cast<int>(pieces.size());
  for (int step = 0; step <= 2 * last; ++step)
    for (const BodyPicture& picture : track.At(step <= last ? step : 2 * last - step).bodies) {
      if (picture.skin == nullptr) continue;
      const std::size_t vertices = picture.skin->surface.vertices.size();
      test::Require(picture.positions.size() == vertices && picture.normals.size() == vertices,
                    "a vertex has a place and a normal");
      for (const auto& triangle : picture.skin->surface.triangles)
        for (const int corner : triangle)
          test::Require(corner >= 0 && static_cast<std::size_t>(corner) < vertices,
                        "a triangle has vertices");
    }
  return 0;
}
