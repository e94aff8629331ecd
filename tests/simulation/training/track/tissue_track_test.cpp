// The tissue track of an attempt: what was drawn live comes back at every moment, in few bytes, and
// what is damaged is left out.
#include "simulation/training/track/tissue_track.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "simulation/training/track/deflated.h"
#include "simulation/training/track/track_recorder.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kFrame = 0.01;  // s

std::shared_ptr<const BodySkin> Ball(int subdivisions = 3) {
  return std::make_shared<const BodySkin>(
      BodySkin{test::Sphere({0.001, 0, 0}, 0.015, subdivisions), {}});
}

WorldPicture WorldOf(const std::shared_ptr<const BodySkin>& skin) {
  WorldPicture world;
  BodyPicture& body = world.bodies.emplace_back();
  body.tissue = 1;
  body.shape = 1;
  body.skin = skin;
  body.positions = skin->surface.vertices;
  body.report.is_asleep = true;
  return world;
}

// Presses the right side of the body inwards by up to `depth`.
void Press(WorldPicture& world, double depth) {
  BodyPicture& body = world.bodies[0];
  body.positions = body.skin->surface.vertices;
  for (glm::dvec3& x : body.positions) x.x -= depth * std::max(0.0, x.x) / 0.016;
  ++body.shape;
  body.report.is_asleep = false;
}

// Bites a piece off on the right: triangles go, and a face of new vertices closes the hole in part.
void Bite(WorldPicture& world, double from_x) {
  BodyPicture& body = world.bodies[0];
  BodySkin bitten;
  const SurfaceMesh& before = body.skin->surface;
  std::vector<int> now(before.vertices.size(), -1);
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    if (before.vertices[i].x > from_x) continue;
    now[i] = static_cast<int>(bitten.surface.vertices.size());
    bitten.surface.vertices.push_back(before.vertices[i]);
    bitten.is_fresh.push_back(body.skin->is_fresh.empty() ? 0 : body.skin->is_fresh[i]);
  }
  for (const auto& triangle : before.triangles) {
    std::array<int, 3> mapped{};
    for (std::size_t k = 0; k < 3; ++k) mapped[k] = now[static_cast<std::size_t>(triangle[k])];
    if (std::ranges::all_of(mapped, [](int corner) { return corner >= 0; }))
      bitten.surface.triangles.push_back(mapped);
  }
  const int fresh = static_cast<int>(bitten.surface.vertices.size());
  for (const double y : {-0.003, 0.0, 0.003}) {
    bitten.surface.vertices.emplace_back(from_x, y, 0.5 * y);
    bitten.is_fresh.push_back(1);
  }
  bitten.surface.triangles.push_back({fresh, fresh + 1, fresh + 2});
  body.skin = std::make_shared<const BodySkin>(std::move(bitten));
  body.positions = body.skin->surface.vertices;
  ++body.shape;
  body.report.is_asleep = false;
}

double LargestDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double largest = a.size() == b.size() ? 0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, glm::distance(a[i], b[i]));
  return largest;
}

// Distance from a place to the nearest of 2^16 levels at most, in a box with a tenth more room on
// each side of the ball's 30 mm: half a diagonal of 36 mm / 65535.
constexpr double kRounding = 0.5 * 1.7321 * 36e-3 / 65535;  // m

struct Recorded {
  std::vector<TrackPiece> pieces;
  std::vector<double> times;
  std::vector<WorldPicture> worlds;  // at those times
};

// A press that comes and goes, bites now and then, and rest between.
Recorded Session(double duration) {
  Recorded session;
  TrackRecorder recorder;
  WorldPicture world = WorldOf(Ball());
  double edge = 0.014;
  for (int k = 1; k * kFrame <= duration; ++k) {
    const double t = k * kFrame;
    if (k > 100 && k % 800 < 400) Press(world, 2e-3 * std::sin(0.05 * k) * std::sin(0.05 * k));
    if (k % 800 == 500) Bite(world, edge -= 5e-4);
    if (k % 800 == 600) world.bodies[0].report.is_asleep = true;
    const std::size_t before = session.pieces.size();
    recorder.Record(t, world, session.pieces);
    if (session.pieces.size() == before) continue;
    session.times.push_back(t);
    session.worlds.push_back(world);
  }
  return session;
}

TEST(TissueTrack, ShowsAtEveryMomentWhatWasDrawnLive) {
  const Recorded session = Session(40);
  ASSERT_GT(session.times.size(), 200U);
  TissueTrack track(session.pieces);
  EXPECT_TRUE(track.has_begun());
  std::mt19937 random(3);
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    const std::size_t k = 1 + random() % (session.times.size() - 1);
    const BodyPicture& live = session.worlds[k].bodies[0];
    const BodyPicture& shown = track.At(session.times[k]).bodies.at(0);
    ASSERT_EQ(shown.tissue, 1);
    ASSERT_EQ(shown.skin->surface.triangles, live.skin->surface.triangles) << session.times[k];
    ASSERT_EQ(shown.positions.size(), shown.normals.size());
    largest = std::max(largest, LargestDistance(shown.positions, live.positions));
    EXPECT_EQ(std::ranges::count(shown.skin->is_fresh, 1),
              std::ranges::count(live.skin->is_fresh, 1));
  }
  EXPECT_LE(largest, kTrackStill + kCoarse * kRounding) << "while it moves";
  EXPECT_FALSE(track.is_damaged());
}

TEST(TissueTrack, TheWayToAMomentMakesNoDifference) {
  const Recorded session = Session(40);
  TissueTrack forward(session.pieces), jumping(session.pieces);
  std::vector<std::vector<glm::dvec3>> places;
  for (const double t : session.times) places.push_back(forward.At(t).bodies.at(0).positions);
  std::mt19937 random(4);
  for (int i = 0; i < 300; ++i) {
    const std::size_t k = random() % session.times.size();
    ASSERT_EQ(jumping.At(session.times[k]).bodies.at(0).positions, places[k]) << session.times[k];
  }
}

TEST(TissueTrack, TissueIsAtRestBeforeItMovesAndExactWhenItHasComeToRest) {
  TrackRecorder recorder;
  std::vector<TrackPiece> pieces;
  WorldPicture world = WorldOf(Ball());
  const std::vector<glm::dvec3> rest = world.bodies[0].positions;
  recorder.Record(0.01, world, pieces);
  Press(world, 1e-3);
  recorder.Record(1, world, pieces);
  Press(world, 1e-3 + 18e-6);  // less than what is drawn
  recorder.Record(2, world, pieces);
  ASSERT_EQ(pieces.size(), 2U);
  world.bodies[0].report.is_asleep = true;
  recorder.Record(3, world, pieces);
  ASSERT_EQ(pieces.size(), 3U);
  TissueTrack track(pieces);
  EXPECT_LE(LargestDistance(track.At(0.5).bodies.at(0).positions, rest), kRounding);
  EXPECT_LE(LargestDistance(track.At(9).bodies.at(0).positions, world.bodies[0].positions),
            kRounding);
  EXPECT_LE(LargestDistance(track.At(0).bodies.at(0).positions, rest), kRounding);
}

TEST(TrackRecorder, RecordsNothingWhileNothingMoves) {
  TrackRecorder recorder;
  std::vector<TrackPiece> pieces;
  WorldPicture world = WorldOf(Ball());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> tremble(-3e-6, 3e-6);
  for (int k = 1; k < 6000; ++k) {
    recorder.Record(k * kFrame, world, pieces);
    // The cycles of a contact at rest, which the live picture does not draw either.
    for (glm::dvec3& x : world.bodies[0].positions) x.z += tremble(random) - 0.5 * (x.z - x.z);
    world.bodies[0].positions = world.bodies[0].skin->surface.vertices;
    for (glm::dvec3& x : world.bodies[0].positions) x.z += tremble(random);
    ++world.bodies[0].shape;
    world.bodies[0].report.is_asleep = false;
  }
  ASSERT_EQ(pieces.size(), 1U) << "the begin alone";
  EXPECT_LE(pieces[0].bytes.size(), 8U);
}

TEST(TrackRecorder, RecordsFifteenTimesASecondAtMost) {
  const Recorded session = Session(20);
  for (std::size_t i = 1; i < session.times.size(); ++i)
    EXPECT_GE(session.times[i] - session.times[i - 1], kTrackStep - 1e-9);
}

TEST(TrackRecorder, ABiteTakesFewBytes) {
  TrackRecorder recorder;
  std::vector<TrackPiece> pieces;
  WorldPicture world = WorldOf(Ball(5));
  recorder.Record(0, world, pieces);
  Press(world, 1e-3);
  recorder.Record(1, world, pieces);
  Bite(world, 0.0158);
  recorder.Record(2, world, pieces);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_LE(pieces[2].bytes.size(), pieces[1].bytes.size() / 2);
}

TEST(TissueTrack, DamagedPiecesAreLeftOutUntilTheNextWholeSkin) {
  Recorded session = Session(40);
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < session.pieces.size(); ++i)
    if (session.pieces[i].bytes[0] == static_cast<char>(PieceKind::kWhole)) whole.push_back(i);
  ASSERT_GE(whole.size(), 3U);
  TissueTrack sound(session.pieces);
  session.pieces[whole[1]].bytes.resize(40);
  TissueTrack track(session.pieces);
  for (const double t : session.times) {
    const bool is_known =
        t < session.pieces[whole[1]].t - 1e-6 || t >= session.pieces[whole[2]].t - 1e-6;
    const auto places = track.At(t).bodies.at(0).positions;
    if (!is_known) continue;
    EXPECT_EQ(places, sound.At(t).bodies.at(0).positions) << t;
  }
  EXPECT_TRUE(track.is_damaged());
}

TEST(TissueTrack, BytesThatAreNoneAreRefusedWithoutHarm) {
  const Recorded session = Session(12);
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    std::vector<TrackPiece> pieces = session.pieces;
    for (int i = 0; i < 3; ++i) {
      std::string& bytes = pieces[random() % pieces.size()].bytes;
      std::string_view head(bytes);
      head = head.substr(0, std::min<std::size_t>(3, head.size()));
      auto raw = Inflated(std::string_view(bytes).substr(head.size()));
      if (!raw || raw->empty()) continue;
      (*raw)[random() % raw->size()] = static_cast<char>(random());
      if (random() % 2 == 0) raw->resize(random() % raw->size());
      bytes = std::string(head) + Deflated(*raw);
    }
    TissueTrack track(pieces);
    for (double t = 0; t < 12; t += 0.3)
      for (const BodyPicture& body : track.At(t).bodies) {
        if (body.skin == nullptr) continue;
        for (const auto& triangle : body.skin->surface.triangles)
          for (const int corner : triangle)
            ASSERT_LT(static_cast<std::size_t>(corner), body.positions.size());
      }
  }
}

}  // namespace
}  // namespace arthro::simulation
