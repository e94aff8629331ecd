#include "authoring/phantom/phantom_io.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "authoring/project/every_instrument.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/options_json.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kSchema = "arthroscene.phantom/1";
constexpr const char* kLicence = "CC0-1.0";

const std::set<std::string> kFiles{"scene.json",
                                   "panorama.png",
                                   "panorama.jpg",
                                   "panorama_with_tissue.png",
                                   "panorama_with_tissue.jpg",
                                   "depth.tiff",
                                   "depth_with_tissue.tiff",
                                   "meniscus.ply",
                                   "meniscus.vtu",
                                   "cartilage.ply",
                                   "grid.png",
                                   "lens.json",
                                   "truth.json",
                                   "trace.csv"};

const char* Extension(const Phantom& phantom) {
  return phantom.options.picture == PictureFormat::kJpg ? ".jpg" : ".png";
}

Json JsonOf(const glm::dvec3& x) { return {x.x, x.y, x.z}; }
Json JsonOf(const glm::dvec2& x) { return {x.x, x.y}; }
Json JsonOf(const glm::dquat& q) { return {q.w, q.x, q.y, q.z}; }
Json JsonOf(const Pose& pose) {
  return {{"position", JsonOf(pose.position)},
          {"quaternion", JsonOf(pose.quaternion)},
          {"scale", pose.scale}};
}

// True for a folder that holds only the frames of a clip: 0000.png, 0001.png …
bool IsFootage(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string(), type = entry.path().extension().string();
    if (!entry.is_regular_file() || (type != ".png" && type != ".jpg") ||
        stem.find_first_not_of("0123456789") != std::string::npos)
      return false;
  }
  return true;
}

bool IsEarlierPhantom(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink() && entry.path().filename() == "footage" &&
        IsFootage(entry.path()))
      continue;
    if (!entry.is_regular_file() || !kFiles.contains(entry.path().filename().string()))
      return false;
  }
  std::ifstream stream(folder / "truth.json");
  const Json truth = Json::parse(stream, nullptr, false);
  return truth.is_object() && truth.value("schema", Json()) == kSchema;
}

// Same path for "out", "out/" and "./out".
fs::path Plain(const fs::path& folder) {
  fs::path plain = folder.lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

// Colour of a model that continues a surface of the picture: its mean linear colour, to hundredths.
// A square stands for the inverse of sRGB, as in the view.
glm::dvec3 ModelColour(const PhantomPicture& picture, Surface surface) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < picture.surfaces.size(); ++i) {
    if (picture.surfaces[i] != surface) continue;
    const glm::dvec3 rgb = glm::dvec3(picture.colour.rgb[3 * i], picture.colour.rgb[3 * i + 1],
                                      picture.colour.rgb[3 * i + 2]) /
                           255.0;
    sum += rgb * rgb;
    ++count;
  }
  // The picture holds the shade of its recesses, which is dark and red; a plate in the view has
  // none, and the tint of its preset. The factors make it as bright there as what it continues.
  const glm::dvec3 kInView(1.31, 1.29, 1.18);
  return count > 0.0 ? glm::round(100.0 * kInView * sum / count) / 100.0 : glm::dvec3(0.5);
}

void WriteFiles(const fs::path& folder, const Phantom& phantom, const FootageWriter& footage) {
  const std::string extension = Extension(phantom);
  WriteColourImage(folder / ("panorama" + extension), phantom.without_tissues.colour);
  WriteColourImage(folder / ("panorama_with_tissue" + extension), phantom.with_tissues.colour);
  WriteDepthMap(folder / "depth.tiff", phantom.without_tissues.depth);
  WriteDepthMap(folder / "depth_with_tissue.tiff", phantom.with_tissues.depth);
  WriteSurface(folder / "meniscus.ply", phantom.meniscus.surface);
  WriteTetMesh(folder / "meniscus.vtu", phantom.meniscus.mesh);
  WriteSurface(folder / "cartilage.ply", phantom.cartilage.surface);
  Json truth = TruthOf(phantom);
  if (footage)
    if (const Json filmed = footage(folder); !filmed.is_null()) truth["footage"] = filmed;
  WriteAtomically(folder / "truth.json", truth.dump(1) + "\n");
  WriteAtomically(folder / "trace.csv", TraceCsv(phantom));
  WriteScene(folder / "scene.json", SceneOf(phantom));
}

// Temporary name beside `folder`, used while it is written or replaced.
fs::path Beside(const fs::path& folder, const char* what) {
  fs::path path = folder;
  path.replace_filename(fmt::format(".{}.{}.{}", folder.filename().string(), ::getpid(), what));
  return path;
}

// Creates the folder that WritePhantom will create, and removes it again.
void RequireRoomBeside(const fs::path& folder) {
  std::error_code fault;
  const fs::path trial = Beside(folder, "partial");
  if (!folder.empty() && fs::create_directory(trial, fault)) {
    fs::remove(trial, fault);
    return;
  }
  throw Error(Code::kFile,
              fmt::format("no folder can be made here: {}; name another place with -o",
                          folder.empty() ? "the name is empty"
                          : fault        ? WhyNotWritten(fault.value())
                                         : "its temporary name is taken"),
              folder);
}

}  // namespace

void RequirePhantomFolder(const fs::path& wanted) {
  const fs::path folder = Plain(wanted);
  std::error_code error;
  const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, error))
    throw Error(Code::kFile, "the folder it should lie in does not exist; make it first", folder);
  if (!fs::exists(fs::symlink_status(folder, error))) return RequireRoomBeside(folder);
  if (!fs::is_directory(folder, error))
    throw Error(Code::kFile, "is a file, and a phantom is a folder; name another place with -o",
                folder);
  if (fs::is_symlink(folder, error))
    throw Error(Code::kFile, "is a link; name the folder itself with -o", folder);
  bool ours = false;
  try {
    ours = fs::is_empty(folder) || IsEarlierPhantom(folder);
  } catch (const fs::filesystem_error&) {
    throw Error(Code::kFile, "cannot be read; name another place with -o", folder);
  }
  if (!ours)
    throw Error(Code::kFile,
                "holds files that are not a phantom's, and nothing is overwritten; name a new "
                "folder with -o",
                folder);
  RequireRoomBeside(folder);
}

void WritePhantom(const fs::path& wanted, const Phantom& phantom, const FootageWriter& footage) {
  RequirePhantomFolder(wanted);
  const fs::path folder = Plain(wanted);
  const fs::path partial = Beside(folder, "partial"), old = Beside(folder, "old");
  std::error_code ignored;
  try {
    fs::create_directory(partial);
    WriteFiles(partial, phantom, footage);
    // Renames an earlier phantom first and restores it when the last step fails.
    const bool replaces = fs::exists(folder);
    if (replaces) fs::rename(folder, old);
    try {
      fs::rename(partial, folder);
    } catch (...) {
      if (replaces) fs::rename(old, folder, ignored);
      throw;
    }
    if (replaces) fs::remove_all(old, ignored);
  } catch (const fs::filesystem_error& error) {
    fs::remove_all(partial, ignored);
    throw Error(Code::kFile,
                fmt::format("could not be written: {}; choose another place with -o",
                            error.code().message()),
                folder);
  } catch (...) {
    fs::remove_all(partial, ignored);
    throw;
  }
}

Scene SceneOf(const Phantom& phantom) {
  const std::string extension = Extension(phantom);
  const AssetRights rights{
      fmt::format("computed by arthroscene phantom, seed {}", phantom.options.seed), kLicence,
      "none needed: no patient"};
  Scene scene;
  scene.title = fmt::format("Digital knee {}", phantom.options.seed);
  scene.author = "arthroscene phantom";
  scene.side = BodySide::kRight;  // cavity.h
  scene.backdrop.panorama = "panorama" + extension;
  scene.backdrop.depth = "depth.tiff";
  scene.backdrop.radius = phantom.cavity.radius;
  scene.backdrop.projection = phantom.projection;
  scene.backdrop.rights = rights;
  scene.backdrop.depth_rights = rights;
  // The picture is computed with light from the portal; a trainee sees it lit from the scope.
  scene.backdrop.relight = 0.6;
  scene.portals.incision_spacing = phantom.incision_spacing;
  Tissue meniscus;
  meniscus.name = phantom.meniscus.name;
  meniscus.surface = "meniscus.ply";
  meniscus.mesh = "meniscus.vtu";
  meniscus.fixed = phantom.meniscus.fixed;
  meniscus.pose = phantom.meniscus.portal_from_tissue;
  meniscus.material = "meniscus";
  meniscus.colour = {0.78, 0.70, 0.57};
  meniscus.rights = rights;
  Tissue cartilage = meniscus;
  cartilage.name = phantom.cartilage.name;
  cartilage.surface = "cartilage.ply";
  cartilage.mesh.clear();
  cartilage.fixed.clear();
  cartilage.is_cuttable = false;
  cartilage.pose = phantom.cartilage.portal_from_tissue;
  cartilage.material = "cartilage";
  // The layer continues the cartilage around it, in the light that the panorama holds.
  cartilage.colour = ModelColour(phantom.with_tissues, Surface::kCartilage);
  scene.tissues = {meniscus, cartilage};
  scene.instruments = EveryInstrument();
  return scene;
}

Json TruthOf(const Phantom& phantom) {
  const Cavity& c = phantom.cavity;
  const Plateau& p = c.plateau;
  Json landmarks = Json::array();
  for (const Landmark& landmark : phantom.landmarks) {
    Json entry{{"name", landmark.name}, {"x_in_portal", JsonOf(landmark.x_in_portal)}};
    if (const auto pixel = PixelFromDirection(phantom.projection, landmark.x_in_portal)) {
      entry["pixel"] = JsonOf(*pixel);
      // Checks whether the landmark is visible in the picture with the tissues, or hidden by a
      // nearer surface.
      const int u = static_cast<int>(std::lround(pixel->x)),
                v = static_cast<int>(std::lround(pixel->y));
      const DepthMap& depth = phantom.with_tissues.depth;
      constexpr double kHidden = 0.5e-3;  // m
      entry["visible"] = u >= 0 && v >= 0 && u < depth.width && v < depth.height &&
                         glm::length(landmark.x_in_portal) < c.radius - depth.at(u, v) + kHidden;
    }
    landmarks.push_back(entry);
  }
  Json ligament = Json::array();
  for (const Bundle& bundle : c.ligament)
    ligament.push_back(
        {{"from", JsonOf(bundle.from)}, {"to", JsonOf(bundle.to)}, {"radius", bundle.radius}});
  const auto tissue = [](const PhantomTissue& t, const char* file) {
    return Json{{"surface", file},
                {"portal_from_tissue", JsonOf(t.portal_from_tissue)},
                {"vertices", t.surface.vertices.size()},
                {"triangles", t.surface.triangles.size()}};
  };
  const auto tubercle = [](const Tubercle& t) {
    return Json{{"centre", JsonOf(t.centre)}, {"radii", JsonOf(t.radii)}, {"height", t.height}};
  };
  const auto ellipsoid = [](const Ellipsoid& e) {
    return Json{{"type", "ellipsoid"},
                {"centre", JsonOf(e.centre)},
                {"radii", JsonOf(e.radii)},
                {"portal_from_body", JsonOf(e.portal_from_body)}};
  };
  Json roots = Json::array();
  for (const MeniscalRoot& root : p.roots)
    roots.push_back({{"from", JsonOf(root.from)},
                     {"to", JsonOf(root.to)},
                     {"half_width", root.half_width},
                     {"height", root.height}});
  PhantomOptions recorded = phantom.options;
  recorded.threads = 0;  // has no effect, so it is not part of the truth
  Json options = JsonFromOptions(recorded);
  options.erase("threads");
  return Json{{"schema", kSchema},
              {"seed", phantom.options.seed},
              {"options", options},
              {"panorama",
               {{"width", phantom.without_tissues.colour.width},
                {"height", phantom.without_tissues.colour.height}}},
              {"radius", c.radius},
              {"incision_spacing", phantom.incision_spacing},
              {"condyle", ellipsoid(c.condyle)},
              {"lateral_condyle", ellipsoid(c.lateral_condyle)},
              {"trochlea", ellipsoid(c.trochlea)},
              {"plateau",
               {{"type", "height field"},
                {"portal_from_plateau",
                 {{"position", JsonOf(p.portal_from_plateau.translation)},
                  {"quaternion", JsonOf(p.portal_from_plateau.rotation)}}},
                {"curvature", {p.curvature_x, p.curvature_y}},
                {"half_width_medial", p.half_width_medial},
                {"half_width_lateral", p.half_width_lateral},
                {"half_depth", p.half_depth},
                {"roll_off", p.roll_off},
                {"eminence", {tubercle(p.eminence[0]), tubercle(p.eminence[1])}},
                {"footprint", tubercle(p.footprint)},
                {"roots", roots},
                {"capsule",
                 {{"medial_centre", JsonOf(p.border.medial)},
                  {"medial_radii", JsonOf(p.border.medial_radii)},
                  {"lateral_x", p.border.lateral_x},
                  {"lateral_radius", p.border.lateral_radius},
                  {"height", p.border.height},
                  {"front_height", p.border.front_height},
                  {"reach", p.border.reach},
                  {"hiatus_depth", p.border.hiatus_depth},
                  {"hiatus_angle", p.border.hiatus_angle}}},
                {"lateral_meniscus",
                 {{"width", p.lateral_meniscus.width}, {"height", p.lateral_meniscus.height}}},
                {"lobule_height", p.lobule_height},
                {"cartilage_bed",
                 {{"centre", JsonOf(p.bed.centre)},
                  {"radii", JsonOf(p.bed.radii)},
                  {"wobble", JsonOf(p.bed.wobble)},
                  {"depth", p.bed.depth},
                  {"wall", p.bed.wall}}}}},
              {"ligament", ligament},
              {"capsule",
               {{"side", c.capsule_side},
                {"front", c.capsule_front},
                {"overhang", c.overhang},
                {"fold_height", c.fold_height}}},
              {"fat_pad", {{"distance", c.fat_distance}, {"lobe_height", c.lobe_height}}},
              {"tissues",
               {{phantom.meniscus.name, tissue(phantom.meniscus, "meniscus.ply")},
                {phantom.cartilage.name, tissue(phantom.cartilage, "cartilage.ply")}}},
              {"landmarks", landmarks}};
}

std::string TraceCsv(const Phantom& phantom) {
  std::string csv = "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n";
  for (const TraceRow& row : phantom.trace) {
    const glm::dvec3& h = row.hip_in_device;
    const glm::dquat& q = row.handle_in_device;
    // Resolution of 0.1 micrometre and 1 microradian, finer than any device's.
    fmt::format_to(std::back_inserter(csv),
                   "{:.3f},{},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f},{}\n", row.t,
                   row.is_scope ? "scope" : "instrument", h.x, h.y, h.z, q.w, q.x, q.y, q.z,
                   row.buttons);
  }
  return csv;
}

}  // namespace arthro::authoring
