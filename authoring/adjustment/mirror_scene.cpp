#include "authoring/adjustment/mirror_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "authoring/alignment/place_by_hand.h"
#include "authoring/alignment/placing_notes.h"
#include "simulation/scene/exercise/mirrored_exercise.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const DepthMap> MirrorRows(const std::shared_ptr<const DepthMap>& map) {
  if (!map) return nullptr;
  DepthMap mirrored = *map;
  for (auto row = mirrored.relief.begin(); row != mirrored.relief.end(); row += map->width)
    std::reverse(row, row + map->width);
  return Share(std::move(mirrored));
}

std::shared_ptr<const OriginMap> MirrorRows(const std::shared_ptr<const OriginMap>& map) {
  if (!map) return nullptr;
  OriginMap mirrored = *map;
  for (auto row = mirrored.origin.begin(); row != mirrored.origin.end(); row += map->width)
    std::reverse(row, row + map->width);
  return Share(std::move(mirrored));
}

std::shared_ptr<const ColourImage> MirrorRows(const std::shared_ptr<const ColourImage>& picture) {
  if (!picture) return nullptr;
  ColourImage mirrored(picture->width, picture->height);
  for (int y = 0; y < picture->height; ++y)
    for (int x = 0; x < picture->width; ++x) {
      const auto row = static_cast<std::size_t>(y) * picture->width;
      for (std::size_t channel = 0; channel < 3; ++channel)
        mirrored.rgb[3 * (row + x) + channel] =
            picture->rgb[3 * (row + picture->width - 1 - x) + channel];
    }
  return Share(std::move(mirrored));
}

// 0 - 0 is 0, where -0 would change the file.
double Negated(double value) { return 0.0 - value; }

void MirrorTissueMesh(Document& document, Tissue& tissue, const NewFile& new_file) {
  if (tissue.mesh.empty()) return;
  const TetMesh mesh = ReadTetMesh(FileOf(document, tissue.mesh));
  const fs::path file = new_file(tissue.mesh.filename());
  WriteTetMesh(file, Mirrored(mesh));
  document.files[tissue.mesh.generic_string()] = {fs::absolute(file), {}, {}};
}

// The function of a solid; its surface is mirrored already.
void MirrorFunction(Document& document, std::size_t index, const NewFile& new_file) {
  const Tissue& tissue = document.scene.tissues[index];
  const Solid solid = Mirrored(ReadSolid(FileOf(document, tissue.surface)), 0);
  const fs::path file = new_file(tissue.surface.filename());
  WriteSolid(file, solid);
  document.files[tissue.surface.generic_string()] = {
      fs::absolute(file),
      index < document.surfaces.size() ? document.surfaces[index] : nullptr,
      {}};
}

std::shared_ptr<const DepthStrokes> MirrorStrokes(const SharedStrokes& strokes) {
  if (!strokes) return nullptr;
  DepthStrokes mirrored = *strokes;
  for (DepthStroke& stroke : mirrored)
    for (glm::dvec2& point : stroke.points) point.x = 1.0 - point.x;
  return Share(std::move(mirrored));
}

}  // namespace

TetMesh Mirrored(TetMesh mesh) {
  for (glm::dvec3& x : mesh.rest_positions) x.x = Negated(x.x);
  // A mirrored element is turned inside out; corners 1 and 2 change places, and with them the
  // middles of 01 and 20, 13 and 23.
  const auto nodes = static_cast<std::size_t>(mesh.NodesPerElement());
  for (std::size_t at = 0; at + nodes <= mesh.elements.size(); at += nodes) {
    std::swap(mesh.elements[at + 1], mesh.elements[at + 2]);
    if (mesh.order != 2) continue;
    std::swap(mesh.elements[at + 4], mesh.elements[at + 6]);
    std::swap(mesh.elements[at + 8], mesh.elements[at + 9]);
  }
  return mesh;
}

void MirrorScene(Document& document, const NewFile& new_file) {
  Scene& scene = document.scene;
  for (std::size_t i = 0; i < scene.tissues.size(); ++i) {
    Tissue& tissue = scene.tissues[i];
    MirrorInNotes(scene, tissue.name, 0);
    MirrorTissueMesh(document, tissue, new_file);
    tissue = Mirrored(tissue, 0);
    glm::dquat& q = tissue.pose.quaternion;
    q = glm::dquat(q.w, q.x, Negated(q.y), Negated(q.z));
    tissue.pose.position.x = Negated(tissue.pose.position.x);
    if (i < document.surfaces.size() && document.surfaces[i])
      document.surfaces[i] = Share(Mirrored(*document.surfaces[i], 0));
    if (IsSolidFile(tissue.surface)) MirrorFunction(document, i, new_file);
  }
  MoveNotes(scene, [](const glm::dvec3& x) { return glm::dvec3(Negated(x.x), x.y, x.z); });
  const int width = OrEmpty(document.panorama).width;
  document.panorama = MirrorRows(document.panorama);
  document.depth = MirrorRows(document.depth);
  document.depth_sigma = MirrorRows(document.depth_sigma);
  document.depth_origin = MirrorRows(document.depth_origin);
  UnmendedDepth& unmended = document.unmended;
  unmended.depth = MirrorRows(unmended.depth);
  unmended.sigma = MirrorRows(unmended.sigma);
  unmended.origin = MirrorRows(unmended.origin);
  document.depth_strokes = MirrorStrokes(document.depth_strokes);
  Projection& projection = scene.backdrop.projection;
  const double centre = std::nearbyint(projection.centre_px.x / kCentreStep) * kCentreStep;
  projection.centre_px.x = (width - 1) - centre;
  projection.roll = Negated(projection.roll);
  scene.portals.incision_spacing = Negated(scene.portals.incision_spacing);
  for (Exercise& exercise : scene.exercises) exercise = Mirrored(std::move(exercise));
  if (scene.side != BodySide::kUnknown)
    scene.side = scene.side == BodySide::kLeft ? BodySide::kRight : BodySide::kLeft;
  if (!document.footage) return;
  FootageRecord record = *document.footage;
  record.is_mirrored = !record.is_mirrored;
  document.footage = Share(std::move(record));
}

}  // namespace arthro::authoring
