#include "simulation/training/track/tissue_track.h"

#include <algorithm>
#include <map>
#include <utility>

#include "simulation/scene/mesh/vertex_normals.h"

namespace arthro::simulation {
namespace {

bool IsSkinOf(const KeptSkin& kept, const BodySkin& skin) {
  if (kept.triangles != skin.surface.triangles || kept.is_fresh != skin.is_fresh) return false;
  for (std::size_t i = 0; i < kept.rest.size(); ++i)
    if (kept.box.Place(kept.rest[i]) != skin.surface.vertices[i]) return false;
  return true;
}

std::vector<glm::dvec3> Places(const SkinBox& box, const std::vector<Place16>& places) {
  std::vector<glm::dvec3> x;
  x.reserve(places.size());
  for (const Place16& place : places) x.push_back(box.Place(place));
  return x;
}

}  // namespace

TissueTrack::TissueTrack(std::vector<TrackPiece> pieces) : pieces_(std::move(pieces)) {
  std::stable_sort(pieces_.begin(), pieces_.end(),
                   [](const TrackPiece& a, const TrackPiece& b) { return a.t < b.t; });
  std::map<int, std::size_t> number_of;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    std::string_view bytes = pieces_[i].bytes;
    PieceHead head;
    if (!TakePieceHead(bytes, head)) {
      is_damaged_ = true;
      continue;
    }
    has_begun_ = true;
    if (head.kind == PieceKind::kBegin) continue;
    const auto [at, is_new] = number_of.try_emplace(head.tissue, bodies_.size());
    if (is_new) {
      bodies_.emplace_back();
      world_.bodies.emplace_back().tissue = head.tissue;
    }
    bodies_[at->second].pieces.push_back(i);
  }
}

PieceKind TissueTrack::KindOf(std::size_t piece) const noexcept {
  return static_cast<PieceKind>(pieces_[piece].bytes.front());
}

// Reads the body up to one of its pieces: from where it is, or from the last whole skin before.
void TissueTrack::Read(Body& body, std::size_t number) {
  std::size_t whole = number;
  while (whole > 0 && KindOf(body.pieces[whole]) != PieceKind::kWhole) --whole;
  const bool goes_on = body.at != kRest && body.at >= whole && body.at <= number;
  bool is_read = goes_on;
  for (std::size_t i = goes_on ? body.at + 1 : whole; i <= number; ++i) {
    std::string_view bytes = pieces_[body.pieces[i]].bytes;
    PieceHead head;
    TakePieceHead(bytes, head);
    if (head.kind == PieceKind::kWhole) {
      auto skin = WholeSkin(bytes);
      is_read = skin.has_value();
      if (is_read) body.kept = std::move(skin);
    } else if (is_read) {
      body.kept = ChangedSkin(std::move(*body.kept), bytes);
      is_read = body.kept.has_value();
    }
    is_damaged_ = is_damaged_ || !is_read;
  }
  body.at = is_read ? number : kRest;
}

void TissueTrack::Show(const Body& body, bool at_rest, BodyPicture& picture) {
  const KeptSkin& kept = *body.kept;
  // A skin that stays keeps its identity, which spares the views to take it anew.
  if (picture.skin == nullptr || picture.skin->surface.vertices.size() != kept.rest.size() ||
      !IsSkinOf(kept, *picture.skin))
    picture.skin = std::make_shared<const BodySkin>(
        BodySkin{{Places(kept.box, kept.rest), kept.triangles}, kept.is_fresh});
  picture.positions = at_rest ? picture.skin->surface.vertices : Places(kept.box, kept.places);
  picture.normals.resize(picture.positions.size());
  ComputeVertexNormals(picture.positions, kept.triangles, picture.normals);
  picture.shape = ++shapes_;
}

const WorldPicture& TissueTrack::At(double t) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    // A frame ends at its time, so that a piece of the same time belongs to it.
    const auto after =
        std::partition_point(body.pieces.begin(), body.pieces.end(),
                             [&](std::size_t piece) { return pieces_[piece].t <= t + 1e-9; });
    const bool at_rest = after == body.pieces.begin();
    const std::size_t number =
        at_rest ? kRest : static_cast<std::size_t>(after - body.pieces.begin()) - 1;
    if (body.shown == number) continue;
    body.shown = number;
    Read(body, at_rest ? 0 : number);
    if (body.kept) Show(body, at_rest, world_.bodies[i]);
  }
  return world_;
}

}  // namespace arthro::simulation
