// Tears open a meniscus as their kind says, and remove no more than their slot.
#include "authoring/models/meniscus_tear.h"

#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "authoring/models/model_library.h"
#include "simulation/core/error.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/field/polygonise.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

using simulation::SolidField;

// V - E + F: two per closed part without handles, two less per handle.
int EulerNumber(const SurfaceMesh& surface) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  return static_cast<int>(surface.vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(surface.triangles.size());
}

// Area of the skin that was inside of the tissue before.
double FreshArea(const SurfaceMesh& skin, const SolidField& whole) {
  double area = 0;
  for (const auto& [a, b, c] : skin.triangles) {
    const auto &x = skin.vertices[a], &y = skin.vertices[b], &z = skin.vertices[c];
    if (whole.Distance((x + y + z) / 3.0) < -0.25 * whole.spacing())
      area += 0.5 * glm::length(glm::cross(y - x, z - x));
  }
  return area;
}

// Area of the slots' middle surfaces that lies in the tissue.
double TornArea(const SolidField& field, const std::vector<Cut>& cuts) {
  constexpr double kStep = 1e-4;
  double area = 0;
  for (const Cut& cut : cuts) {
    const auto& tear = std::get<TearCut>(cut);
    const glm::dvec3 into = glm::normalize(tear.into);
    for (std::size_t i = 0; i + 1 < tear.path.size(); ++i) {
      const glm::dvec3 way = tear.path[i + 1] - tear.path[i];
      const int along = std::max(1, static_cast<int>(std::lround(glm::length(way) / kStep)));
      const int down = static_cast<int>(std::lround((tear.lead + tear.depth) / kStep));
      const double cell =
          glm::length(glm::cross(way, into)) / along * (tear.lead + tear.depth) / down;
      for (int a = 0; a < along; ++a)
        for (int d = 0; d < down; ++d) {
          const glm::dvec3 x = tear.path[i] + (a + 0.5) / along * way +
                               ((d + 0.5) / down * (tear.lead + tear.depth) - tear.lead) * into;
          if (field.Distance(x) < 0) area += cell;
        }
    }
  }
  return area;
}

struct Case {
  ModelKind model;
  TearEntry tear;
};
class EveryTear : public testing::TestWithParam<Case> {};

TEST_P(EveryTear, OpensTheMeniscusAndRemovesNoMoreThanItsSlot) {
  for (const KneeSide side : {KneeSide::kLeft, KneeSide::kRight}) {
    const LibraryModel model = MakeModel(DefaultOptionsOf(GetParam().model), side);
    const double spacing = simulation::BodyOptions{}.cut_spacing;
    const SolidField whole = SolidField::FromSurface(model.surface, spacing);
    const TearOptions options(GetParam().tear.kind);
    const std::vector<Cut> cuts = TearCuts(model.surface, options);
    SolidField torn = whole;
    const simulation::MadeCuts made = simulation::MakeCuts(torn, cuts, model.fixed);
    const SurfaceMesh skin = simulation::Polygonise(torn), uncut = simulation::Polygonise(whole);
    const int pieces = simulation::PiecesWithoutVolumes(torn).count();
    const double area = TornArea(whole, cuts);
    const double removed = whole.Volume() - torn.Volume();
    std::printf("%s, %s: %d pieces, Euler number %d, %.1f mm2 torn, %.2f %% of the volume\n",
                model.name.c_str(), GetParam().tear.word, pieces, EulerNumber(skin), 1e6 * area,
                100 * removed / whole.Volume());
    const TearKind kind = GetParam().tear.kind;
    const bool is_closed_slot = kind == TearKind::kLongitudinal || kind == TearKind::kBucketHandle;
    EXPECT_EQ(pieces, kind == TearKind::kRoot ? 2 : 1);
    EXPECT_EQ(EulerNumber(uncut), 2);
    // A slot through the body, away from its borders, is a handle; a cut across makes two parts.
    EXPECT_EQ(EulerNumber(skin), is_closed_slot ? 0 : kind == TearKind::kRoot ? 4 : 2);
    EXPECT_GT(area, 5e-6);
    // Both faces of the tear are free; a quarter is left for what lies within a quarter of a
    // spacing of the old skin, and for the free edge, which is thinner than two spacings.
    EXPECT_GT(FreshArea(skin, whole), 1.5 * area);
    // The slot is 1.5 spacings wide at least; half of that again is left for its round ends.
    const double width = std::max(options.width, 1.5 * spacing);
    EXPECT_LT(removed, 1.5 * width * area);
    EXPECT_GT(removed, 0.5 * width * area);
    EXPECT_EQ(made.washed.crumbs, 0);
  }
}

std::vector<Case> AllCases() {
  std::vector<Case> cases;
  for (const ModelKind model : {ModelKind::kMedialMeniscus, ModelKind::kLateralMeniscus})
    for (const TearEntry& tear : TearEntries()) cases.push_back({model, tear});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Library, EveryTear, testing::ValuesIn(AllCases()), [](const auto& entry) {
  std::string name = entry.param.tear.title;
  std::erase(name, ' ');
  return name + (entry.param.model == ModelKind::kMedialMeniscus ? "Medial" : "Lateral");
});

// The slot opens by the displacement in the middle and by nothing at its ends, and the surface
// stays closed.
TEST(MeniscusTear, ADisplacedHandleLeavesItsRimAndKeepsBothEnds) {
  for (const KneeSide side : {KneeSide::kLeft, KneeSide::kRight}) {
    const LibraryModel model = MakeModel(DefaultOptionsOf(ModelKind::kMedialMeniscus), side);
    TearOptions options(TearKind::kBucketHandle);
    options.displacement = MetresFromMm(6);
    SolidField torn = SolidField::FromSurface(model.surface, simulation::BodyOptions{}.cut_spacing);
    simulation::MakeCuts(torn, TearCuts(model.surface, options), model.fixed);
    const SurfaceMesh skin = simulation::Polygonise(torn);
    const SurfaceMesh displaced = WithDisplacedHandle(skin, model.surface, options);
    ASSERT_EQ(displaced.vertices.size(), skin.vertices.size());
    EXPECT_EQ(EulerNumber(displaced), 0) << "a handle";
    double most = 0;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < skin.vertices.size(); ++i) {
      const double way = glm::distance(skin.vertices[i], displaced.vertices[i]);
      most = std::max(most, way);
      moved += way > 0 ? 1 : 0;
    }
    EXPECT_NEAR(most, options.displacement, 0.02 * options.displacement);
    EXPECT_GT(moved, skin.vertices.size() / 10);
    EXPECT_LT(moved, skin.vertices.size() * 2 / 3) << "the rim stays";
    // Edges of neighbouring triangles stay short: nothing is torn across the slot.
    double longest = 0;
    for (const auto& t : displaced.triangles)
      for (int k = 0; k < 3; ++k)
        longest = std::max(
            longest, glm::distance(displaced.vertices[t[k]], displaced.vertices[t[(k + 1) % 3]]));
    EXPECT_LT(longest, 5 * simulation::BodyOptions{}.cut_spacing);
  }
}

TEST(MeniscusTear, ADisplacementThatDoesNotFitIsRefusedInWords) {
  const LibraryModel model =
      MakeModel(DefaultOptionsOf(ModelKind::kMedialMeniscus), KneeSide::kRight);
  TearOptions radial(TearKind::kRadial);
  radial.displacement = MetresFromMm(4);
  EXPECT_THROW(WithDisplacedHandle(model.surface, model.surface, radial), Error);
  SurfaceMesh small = model.surface;
  for (glm::dvec3& x : small.vertices) x *= 0.55;
  TearOptions far(TearKind::kBucketHandle);
  far.length = MetresFromMm(20);
  far.rim_width = MetresFromMm(2);
  far.displacement = MetresFromMm(12);
  try {
    WithDisplacedHandle(small, small, far);
    ADD_FAILURE() << "the handle would lie beyond the notch";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("displace its handle less"), std::string::npos)
        << error.what();
  }
}

// An imported meniscus lies anyhow in its file's frame.
TEST(MeniscusTear, IsTheSameOnAMeniscusThatWasTurnedAndMoved) {
  const LibraryModel model =
      MakeModel(DefaultOptionsOf(ModelKind::kMedialMeniscus), KneeSide::kRight);
  const Rigid3 moved{glm::angleAxis(0.9, glm::normalize(glm::dvec3(0.3, 0.1, 1.0))),
                     {0.1, -0.2, 0.05}};
  SurfaceMesh turned = model.surface;
  for (glm::dvec3& x : turned.vertices) x = moved * x;
  const double spacing = simulation::BodyOptions{}.cut_spacing;
  for (const TearEntry& entry : TearEntries()) {
    const TearOptions options(entry.kind);
    const double here =
        TornArea(SolidField::FromSurface(model.surface, spacing), TearCuts(model.surface, options));
    const double there =
        TornArea(SolidField::FromSurface(turned, spacing), TearCuts(turned, options));
    // The field's grid lies otherwise in the tissue: its surface differs by some hundredths of a
    // spacing, over slots of some 4 mm height.
    EXPECT_NEAR(there, here, 0.05 * here) << entry.word;
  }
}

TEST(MeniscusTear, ABallIsRefused) {
  EXPECT_THROW(TearCuts(test::Sphere({0, 0, 0}, 0.01, 3), TearOptions(TearKind::kRadial)), Error);
}

TEST(MeniscusTear, ATearThatDoesNotFitIsRefusedInWords) {
  const LibraryModel model =
      MakeModel(DefaultOptionsOf(ModelKind::kMedialMeniscus), KneeSide::kRight);
  TearOptions options(TearKind::kRadial);
  options.reach = 0.015;
  options.position = 0.5;
  try {
    TearCuts(model.surface, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("smaller reach"), std::string::npos) << error.sentence();
  }
  TearOptions longest(TearKind::kBucketHandle);
  longest.length = 0.08;
  EXPECT_THROW(TearCuts(model.surface, longest), Error);
}

}  // namespace
}  // namespace arthro::authoring
