#include "simulation/training/track/track_recorder.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// A look back reads as many changes at most to come to a moment: four seconds of motion.
constexpr int kWholeEvery = 60;

constexpr double kExact = 2e-6;  // m, from which on tissue at rest is recorded once more

bool IsWithin(double distance, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = a - b;
  return glm::dot(way, way) <= distance * distance;
}

}  // namespace

void TrackRecorder::Record(double t, const WorldPicture& world, std::vector<TrackPiece>& pieces) {
  if (!has_begun_) {
    has_begun_ = true;
    bodies_.resize(world.bodies.size());
    pieces.push_back(MakePiece(t, {PieceKind::kBegin, 0}, {}));
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
      if (world.bodies[i].skin != nullptr) {
        bodies_[i].skin = world.bodies[i].skin;
        bodies_[i].places = world.bodies[i].skin->surface.vertices;
      }
  } else if (t < last_ + kTrackStep - 1e-9) {
    return;
  }
  last_ = t;
  for (std::size_t i = 0; i < std::min(bodies_.size(), world.bodies.size()); ++i)
    RecordBody(t, world.bodies[i], bodies_[i], pieces);
}

void TrackRecorder::RecordBody(double t, const BodyPicture& now, Body& body,
                               std::vector<TrackPiece>& pieces) {
  const bool is_cut = now.skin != body.skin;
  if (now.skin == nullptr || now.tissue < 0 ||
      now.positions.size() != now.skin->surface.vertices.size())
    return;
  const bool settles = now.report.is_asleep && !body.is_exact;
  if (!is_cut && now.shape == body.shape && !settles) return;
  body.shape = now.shape;
  body.skin = now.skin;

  std::vector<glm::dvec3> places = now.positions;
  bool moves = is_cut || settles, is_exact = true;
  if (!moves)
    for (std::size_t i = 0; i < places.size(); ++i) {
      is_exact = is_exact && IsWithin(kExact, places[i], body.places[i]);
      if (IsWithin(kTrackStill, places[i], body.places[i]))
        places[i] = body.places[i];
      else
        moves = true;
    }
  body.is_exact = is_exact;
  if (!moves) return;

  // Another box is needed where something leaves it.
  const auto fits = [&](const SkinBox& box) {
    const auto holds = [&](const glm::dvec3& x) { return box.Holds(x); };
    return std::ranges::all_of(places, holds) &&
           (!is_cut || std::ranges::all_of(now.skin->surface.vertices, holds));
  };
  const PieceHead head{PieceKind::kWhole, static_cast<std::uint16_t>(now.tissue)};
  std::string bytes;
  if (body.kept && body.changes < kWholeEvery && fits(body.kept->box)) {
    KeptSkin kept = KeepSkin(*now.skin, places, body.kept->box);
    if (!body.is_exact) Coarsen(*body.kept, kept);
    if (kept == *body.kept) return;
    bytes = MakePiece(t, {PieceKind::kChange, head.tissue}, ChangeBytes(*body.kept, kept)).bytes;
    body.kept = std::move(kept);
    ++body.changes;
  } else {
    body.kept = KeepSkin(*now.skin, places);
    bytes = MakePiece(t, head, WholeBytes(*body.kept)).bytes;
    body.changes = 0;
  }
  body.places.clear();
  for (const Place16& place : body.kept->places) body.places.push_back(body.kept->box.Place(place));
  pieces.push_back({t, std::move(bytes)});
}

}  // namespace arthro::simulation
