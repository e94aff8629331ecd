#include "simulation/scene/files/scene_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/backdrop/hidden_share.h"
#include "simulation/scene/files/exercise_check.h"
#include "simulation/scene/mesh/held_nodes.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro {
namespace {

double Mm(double metres) { return MmFromMetres(metres); }

void LookAtRights(const std::string& what, const AssetRights& rights, SceneFindings& findings) {
  if (const std::string missing = MissingRights(rights); !missing.empty())
    findings.warnings.push_back(
        fmt::format("{}: no {} is given; patients and makers have rights, so say it under "
                    "\"rights\" before sharing",
                    what, missing));
}

// How wide the panorama looks from the portal, degrees across its middle row and column.
std::string FieldOfPanorama(const Projection& projection, int width, int height) {
  const glm::dvec2 c = projection.centre_px;
  const auto angle = [&](glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec3 one = DirectionFromPixel(projection, a),
                     other = DirectionFromPixel(projection, b);
    return DegreesFromRadians(
        std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other)));
  };
  if (projection.type == ProjectionType::kEquirectangular)
    return fmt::format("{:.0f} x {:.0f} degrees", width / projection.px_per_deg,
                       height / projection.px_per_deg);
  return fmt::format("{:.0f} x {:.0f} degrees", angle({0.0, c.y}, {width - 1.0, c.y}),
                     angle({c.x, 0.0}, {c.x, height - 1.0}));
}

void LookAtPanorama(const LoadedScene& loaded, SceneFindings& findings) {
  const ColourImage& panorama = OrEmpty(loaded.panorama);
  const Projection& projection = loaded.scene.backdrop.projection;
  if (panorama.empty()) return;
  const bool is_gnomonic = projection.type == ProjectionType::kGnomonic;
  findings.found.push_back(fmt::format(
      "panorama: {} x {} px, {}, {}, on a sphere of {:g} mm", panorama.width, panorama.height,
      is_gnomonic ? fmt::format("gnomonic with a focal length of {:g} px", projection.focal_px)
                  : fmt::format("equirectangular with {:g} px per degree", projection.px_per_deg),
      FieldOfPanorama(projection, panorama.width, panorama.height),
      Mm(loaded.scene.backdrop.radius)));
  const glm::dvec2 c = projection.centre_px;
  if (c.x < 0 || c.y < 0 || c.x > panorama.width - 1 || c.y > panorama.height - 1)
    findings.warnings.push_back(
        fmt::format("backdrop.projection.centre_px ({:g}, {:g}) lies outside the panorama; a scope "
                    "pushed straight in sees nothing",
                    c.x, c.y));
}

// Lists the origins of the depths and their median error. `range`: from the least to the largest
// depth, m.
void LookAtOrigins(const LoadedScene& loaded, double range, SceneFindings& findings) {
  const OriginMap& origins = OrEmpty(loaded.depth_origin);
  const DepthMap& sigma = OrEmpty(loaded.depth_sigma);
  if (origins.empty() && sigma.empty()) return;
  findings.relief = SharesOf(*loaded.depth, sigma, origins);
  const ReliefShares& relief = *findings.relief;
  std::string line = "relief:";
  if (!origins.empty())
    line += fmt::format(" {:.1f} % measured, {:.1f} % from brightness, {:.1f} % interpolated",
                        100 * relief.measured, 100 * relief.brightness, 100 * relief.interpolated);
  if (relief.median_sigma)
    line += fmt::format("{} median standard error {:.3g} mm", origins.empty() ? "" : ",",
                        Mm(*relief.median_sigma));
  if (line != "relief:") findings.found.push_back(line);
  // An outline is higher than this (simulation/haptics/relief/relief_steps.h).
  constexpr double kErrorsOfStep = 7;
  if (range > 0 && relief.median_sigma && kErrorsOfStep * *relief.median_sigma > range)
    findings.warnings.push_back(
        fmt::format("the depth map is mostly noise: its noise is {:.3g} mm, and its depths span "
                    "{:.3g} mm; outlines are not drawn",
                    Mm(*relief.median_sigma), Mm(range)));
  else if (relief.median_sigma && loaded.scene.backdrop.depth_sigma.empty())
    findings.warnings.push_back(
        fmt::format("the depth map differs by noise of {:.3g} mm from pixel to pixel, and no "
                    "backdrop.depth_sigma states it; picture and forces smooth it",
                    Mm(*relief.median_sigma)));
  else if (relief.median_sigma && !(*relief.median_sigma > 0))
    findings.hints.push_back(
        "backdrop.depth_sigma says that most depths are exact, so picture and forces keep all of "
        "their noise; remove it from the scene if their error is not known");
  if (relief.without_origin > 0)
    findings.warnings.push_back(
        fmt::format("{:.1f} % of the depths have no origin in backdrop.depth_origin; is it that of "
                    "this depth map?",
                    100 * relief.without_origin));
  if (relief.without_sigma > 0)
    findings.warnings.push_back(
        fmt::format("{:.1f} % of the depths have no standard error in backdrop.depth_sigma; they "
                    "count as the least certain ones",
                    100 * relief.without_sigma));
}

void LookAtDepth(const LoadedScene& loaded, SceneFindings& findings) {
  const DepthMap& depth = OrEmpty(loaded.depth);
  const double radius = loaded.scene.backdrop.radius;
  if (depth.empty()) {
    if (loaded.scene.backdrop.depth.empty())
      findings.hints.push_back(
          "no depth map, so the backdrop is a bare sphere; `arthroscene depth` makes one");
    if (loaded.scene.backdrop.relight > 0)
      findings.hints.push_back(
          "backdrop.relight waits for a depth map, which says how far the lamp's light goes; till "
          "then the footage keeps its own light");
    return;
  }
  std::size_t imaged = 0, outside = 0;
  float least = INFINITY, most = -INFINITY;
  for (const float h : depth.relief) {
    if (std::isnan(h)) continue;
    ++imaged;
    outside += h >= 0.0f && h < radius ? 0 : 1;
    least = std::min(least, h);
    most = std::max(most, h);
  }
  if (imaged == 0) {
    findings.warnings.push_back("the depth map holds nothing but NaN, so nothing can be felt");
    return;
  }
  const double all = static_cast<double>(depth.relief.size());
  findings.found.push_back(
      fmt::format("depth: {} x {} px, relief {:.3g} to {:.3g} mm, {:.1f} % imaged", depth.width,
                  depth.height, Mm(least), Mm(most), 100.0 * static_cast<double>(imaged) / all));
  if (outside > 0)
    findings.warnings.push_back(fmt::format(
        "{} of {} depths lie outside 0 to {:g} mm, the radius of the sphere; are they in metres?",
        outside, imaged, Mm(radius)));
  LookAtOrigins(loaded, static_cast<double>(most - least), findings);
}

// Edges that do not join exactly two triangles, once each way.
int OpenEdges(const SurfaceMesh& surface) {
  std::map<std::pair<int, int>, int> balance;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return static_cast<int>(
      std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second; }));
}

// Reports how a tool meets the tissue, and what is missing for that.
void LookAtKind(const Tissue& tissue, const std::string& what, const IsThinLayer& is_layer,
                SceneFindings& findings) {
  if (tissue.is_implicit && !tissue.mesh.empty())
    findings.errors.push_back(what +
                              " is a solid that does not give way (\"implicit\") and has "
                              "tetrahedra; leave out one of the two");
  else if (tissue.is_implicit && IsSolidFile(tissue.surface))
    findings.found.push_back(what + ": a solid that does not give way, given by functions");
  else if (tissue.is_implicit)
    findings.found.push_back(what + ": a solid that does not give way");
  else if (tissue.mesh.empty() && is_layer && is_layer(tissue))
    findings.found.push_back(what + ": gives way as a thin layer");
  else if (tissue.mesh.empty())
    findings.hints.push_back(
        what +
        " has no tetrahedra, so it does not deform; `arthroscene tetrahedralize` makes them");
}

void LookAtTissue(const LoadedScene& loaded, std::size_t index, const IsThinLayer& is_layer,
                  SceneFindings& findings) {
  const Tissue& tissue = loaded.scene.tissues[index];
  const std::string what = fmt::format("tissue \"{}\"", tissue.name);
  LookAtRights(what, tissue.rights, findings);
  LookAtKind(tissue, what, is_layer, findings);
  if (index >= loaded.surfaces.size()) return;
  const SurfaceMesh& surface = OrEmpty(loaded.surfaces[index]);
  if (surface.triangles.empty()) return;
  glm::dvec3 least(INFINITY), most(-INFINITY);
  std::size_t outside = 0;
  for (const glm::dvec3& vertex : surface.vertices) {
    const glm::dvec3 x = tissue.pose * vertex;
    least = glm::min(least, x);
    most = glm::max(most, x);
    outside += glm::length(x) > loaded.scene.backdrop.radius ? 1 : 0;
  }
  const glm::dvec3 size = most - least;
  findings.found.push_back(fmt::format("{}: {} triangles, {:.3g} x {:.3g} x {:.3g} mm, {}", what,
                                       surface.triangles.size(), Mm(size.x), Mm(size.y), Mm(size.z),
                                       tissue.material));
  const int open = OpenEdges(surface);
  if (open > 0 && tissue.is_implicit)
    findings.errors.push_back(
        fmt::format("{} is a solid that does not give way, but its surface is not closed: {} edges "
                    "do not join two triangles; close it",
                    what, open));
  else if (open > 0)
    findings.warnings.push_back(
        fmt::format("{} is not closed: {} edges do not join two triangles; close it before "
                    "tetrahedralizing",
                    what, open));
  if (outside == surface.vertices.size())
    findings.warnings.push_back(what +
                                " lies wholly outside the backdrop's sphere and is never "
                                "seen; move it, or mend its unit or scale");
  else if (HiddenShare(surface, tissue.pose, OrEmpty(loaded.depth), loaded.scene.backdrop) == 1)
    findings.warnings.push_back(what +
                                " lies wholly behind the relief of the backdrop and is never "
                                "seen; move it towards the portal");
  else if (outside > 0)
    findings.warnings.push_back(fmt::format(
        "{} lies outside the backdrop's sphere with {:.0f} % of its vertices", what,
        100.0 * static_cast<double>(outside) / static_cast<double>(surface.vertices.size())));
}

// A mesh that nothing holds drifts at the first touch; one that is held everywhere is rigid.
void LookAtPins(const Tissue& tissue, const TetMesh& mesh, SceneFindings& findings) {
  const std::string what = fmt::format("tissue \"{}\"", tissue.name);
  const std::vector<std::uint8_t> held = HeldNodes(mesh.rest_positions, tissue.fixed);
  const auto count = static_cast<std::size_t>(std::count(held.begin(), held.end(), 1));
  // Three points that are not on one line keep a body from turning; a thin pin has fewer.
  constexpr std::size_t kFewest = 3;
  if (count == 0)
    findings.warnings.push_back(
        what + (tissue.fixed.empty()
                    ? " is held nowhere (\"fixed\" is empty): it will drift when it is touched"
                    : " has no node in any ball of \"fixed\", so nothing holds it: it will drift; "
                      "move the balls onto it or make them larger"));
  else if (count < kFewest)
    findings.warnings.push_back(fmt::format(
        "{} is held at {} of its nodes only and can turn about them; make a ball of \"fixed\" "
        "larger",
        what, count));
  else if (count == held.size())
    findings.warnings.push_back(what +
                                " lies wholly inside the balls of \"fixed\", so it does not "
                                "deform; make them smaller");
  else
    findings.found.push_back(fmt::format("{}: held at {} of {} nodes, {} balls", what, count,
                                         held.size(), tissue.fixed.size()));
  for (std::size_t i = 0; i < tissue.fixed.size(); ++i) {
    const std::vector<std::uint8_t> own = HeldNodes(mesh.rest_positions, {&tissue.fixed[i], 1});
    if (count > 0 && std::count(own.begin(), own.end(), 1) == 0)
      findings.hints.push_back(
          fmt::format("{}: ball {} of \"fixed\" holds no node; it does nothing", what, i + 1));
  }
}

// A mesh that was made for a probed place has nodes there.
void LookAtProbed(const Tissue& tissue, const TetMesh& mesh, SceneFindings& findings) {
  for (std::size_t i = 0; i < tissue.probed.size(); ++i) {
    const std::vector<std::uint8_t> own = HeldNodes(mesh.rest_positions, {&tissue.probed[i], 1});
    if (std::count(own.begin(), own.end(), 1) == 0)
      findings.warnings.push_back(fmt::format(
          "tissue \"{}\": ball {} of \"probed\" has no node of the mesh, which is no finer for it; "
          "move the ball onto the tissue, or make the tetrahedra again",
          tissue.name, i + 1));
  }
}

void LookAtScope(const Scene& scene, SceneFindings& findings) {
  findings.found.push_back(
      fmt::format("scope: {:g} degrees oblique, field of view {:g} degrees, rod of {:g} mm",
                  DegreesFromRadians(scene.scope.view_angle),
                  DegreesFromRadians(scene.scope.field_of_view), Mm(scene.rig.scope.rod_length)));
  const double spacing = scene.portals.incision_spacing, radius = scene.backdrop.radius;
  findings.found.push_back(fmt::format("portals: instrument {:g} mm to the {} of the scope",
                                       Mm(std::abs(spacing)), spacing < 0 ? "left" : "right"));
  if (std::abs(spacing) >= radius)
    findings.warnings.push_back(
        fmt::format("the instrument's portal, {:g} mm from the scope's, lies outside the "
                    "backdrop's sphere of {:g} mm",
                    Mm(std::abs(spacing)), Mm(radius)));
  for (const auto& [length, what] : {std::pair{scene.rig.scope.rod_length, "scope"},
                                     std::pair{scene.rig.instrument.rod_length, "instrument"}})
    if (length < radius)
      findings.warnings.push_back(
          fmt::format("the {}'s rod of {:g} mm is shorter than the way to the backdrop, {:g} mm",
                      what, Mm(length), Mm(radius)));
}

}  // namespace

std::string MissingRights(const AssetRights& rights) {
  std::string missing;
  for (const auto& [text, word] :
       {std::pair{&rights.source, "source"}, std::pair{&rights.licence, "licence"},
        std::pair{&rights.consent, "consent"}})
    if (text->empty()) missing += (missing.empty() ? "" : ", ") + std::string(word);
  return missing;
}

std::vector<std::string> MissingForSharing(const Scene& scene) {
  std::vector<std::string> missing;
  if (scene.title.empty()) missing.push_back("the scene has no title");
  if (scene.author.empty()) missing.push_back("the scene has no author");
  const auto look = [&](const std::string& asset, const AssetRights& rights) {
    if (const std::string words = MissingRights(rights); !words.empty())
      missing.push_back(fmt::format("{} has no {}", asset, words));
  };
  if (!scene.backdrop.panorama.empty()) look("the panorama", scene.backdrop.rights);
  for (const Tissue& tissue : scene.tissues)
    look(fmt::format("tissue \"{}\"", tissue.name), tissue.rights);
  return missing;
}

SceneFindings CheckScene(const LoadedScene& loaded, const IsThinLayer& is_layer) {
  SceneFindings findings;
  const Scene& scene = loaded.scene;
  findings.found.push_back(fmt::format("title: {}", scene.title.empty() ? "none" : scene.title));
  if (scene.title.empty()) findings.hints.push_back("no title; lists show the folder's name");
  if (scene.author.empty()) findings.hints.push_back("no author");
  LookAtPanorama(loaded, findings);
  LookAtDepth(loaded, findings);
  LookAtRights("panorama", scene.backdrop.rights, findings);
  LookAtScope(scene, findings);
  for (std::size_t i = 0; i < scene.tissues.size(); ++i)
    LookAtTissue(loaded, i, is_layer, findings);
  if (scene.tissues.empty())
    findings.hints.push_back("no tissues, so there is nothing that deforms");
  findings.found.push_back(fmt::format("instruments: {}, exercises: {}", scene.instruments.size(),
                                       scene.exercises.size()));
  if (scene.instruments.empty())
    findings.hints.push_back("no instruments; practice offers all of them");
  if (scene.exercises.empty())
    findings.hints.push_back("no exercises, so practice is free and unscored");
  for (std::string& fault : ExerciseFaults(scene)) findings.errors.push_back(std::move(fault));
  return findings;
}

SceneFindings CheckScene(const std::filesystem::path& scene, LoadedScene* what,
                         const IsThinLayer& is_layer) {
  std::vector<std::string> errors;
  LoadedScene loaded = LoadScene(scene, errors);
  SceneFindings findings = CheckScene(loaded, is_layer);
  const auto named = [&](const Error& error) -> std::string {
    return NamedByScene(error, loaded).what();
  };
  for (const Tissue& tissue : loaded.scene.tissues) {
    std::error_code ignored;
    const std::filesystem::path file = FileOf(loaded, tissue.mesh);
    if (tissue.mesh.empty() || !std::filesystem::exists(file, ignored)) continue;
    try {
      TetReadReport report;
      const TetMesh mesh = ReadTetMesh(file, &report);
      findings.found.push_back(fmt::format("tissue \"{}\": {} tetrahedra of order {}, {} nodes",
                                           tissue.name, mesh.ElementCount(), mesh.order,
                                           mesh.rest_positions.size()));
      for (const std::string& message : report.messages)
        findings.warnings.push_back(named(Error(Code::kBadMesh, message, file)));
      LookAtPins(tissue, mesh, findings);
      LookAtProbed(tissue, mesh, findings);
    } catch (const Error& error) {
      errors.push_back(named(error));
    }
  }
  findings.errors.insert(findings.errors.begin(), errors.begin(), errors.end());
  if (what != nullptr) *what = std::move(loaded);
  return findings;
}

}  // namespace arthro
