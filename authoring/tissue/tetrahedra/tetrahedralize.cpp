#include "authoring/tissue/tetrahedra/tetrahedralize.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <numbers>
#include <optional>
#include <unistd.h>

#include <fmt/format.h>

#include "authoring/tissue/surface/fine_places.h"
#include "authoring/tissue/surface/surface_thicken.h"
#include "authoring/tissue/surface/time_limit.h"
#include "authoring/tissue/tetrahedra/child_process.h"
#include "authoring/tissue/tetrahedra/tetgen_worker.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/temporary_folder.h"
#include "simulation/core/options_json.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Elements per cube of the longest allowed edge, measured on cubes and spheres, and the largest
// number that is attempted: a solver could not use more.
constexpr double kElementsPerCube = 33.0, kMostElements = 2e6;
// Least share of a regular element's shape for which a solver's result is trusted.
constexpr double kSliverVolume = 1e-9;
// TetGen works on a diagonal of 64 to 128; the scale is a power of two, which changes no bit.
constexpr int kDiagonalExponent = 7;
constexpr int kMostEdgePasses = 4;
// Facets this near to one plane, in degrees, may be filled as one; TetGen's own 179.9 costs up to
// 1e-6 of a real meniscus's volume.
constexpr double kFlatAngle = 179.9999;
// Elements flatter than this, in degrees, are smoothed at the end; TetGen's default is 165. Not
// used together with a longest edge, which that smoothing stretches by a fifth.
constexpr double kMaxDihedral = 150.0;

double MsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string SayTetgenCode(int code) {
  switch (code) {
    case 2:
      return "an internal error of TetGen";
    case 3:
      return "TetGen found a self-intersection";
    case 4:
      return "TetGen found two corners nearly on one another";
    case 5:
      return "TetGen found two facets nearly on one another";
    default:
      return fmt::format("TetGen refused the surface (its code {})", code);
  }
}

std::string Say(const ChildResult& result) {
  if (result.end == ChildResult::End::kTimedOut) return "TetGen did not finish in time";
  if (result.end == ChildResult::End::kSignalled) {
    if (result.code == SIGXCPU) return "TetGen did not finish in time";
    const char* signal = ::sigdescr_np(result.code);
    return fmt::format("TetGen crashed ({})", signal != nullptr ? signal : "unknown signal");
  }
  if (result.code == kWorkerDone) return "done";
  if (result.code == kWorkerOutOfMemory) return "TetGen ran out of memory";
  if (result.code >= kWorkerTetgen) return SayTetgenCode(result.code - kWorkerTetgen);
  return "the mesher could not start its work: " + result.output;
}

struct Run {
  const SurfaceMesh& surface;
  const SurfaceSource& source;
  const TetrahedralizeOptions& options;
  const Progress& progress;
  const TimeLimit& limit;
  const fs::path& program;
  TetrahedralizeReport& report;
};

// Runs one child. Returns nothing when TetGen failed in a way that other switches may cure.
std::optional<TetMesh> RunTetgen(const Run& run, const std::string& switches, double max_edge) {
  int exponent = 0;
  std::frexp(run.report.surface.Diagonal(), &exponent);
  const double scale = std::ldexp(1.0, kDiagonalExponent - exponent);

  TetgenJob job;
  job.switches = switches;
  job.flat_angle = kFlatAngle;
  if (max_edge <= 0 && run.options.fine_at.empty()) job.max_dihedral = kMaxDihedral;
  job.max_edge = max_edge * scale;
  for (const Ball& place : run.options.fine_at)
    job.fine.push_back({place.centre * scale, place.radius * scale, run.options.fine_edge * scale});
  job.memory_limit = run.options.memory_limit * 1024 * 1024;
  job.time_limit = run.limit.Left();
  for (const glm::dvec3& x : run.surface.vertices) job.points.push_back(x * scale);
  job.triangles = run.surface.triangles;
  TemporaryFolder folder;
  WriteTetgenJob(folder.path(), job);
  const ChildResult result = RunChild(run.program, {"tetgen-worker", folder.path().string()},
                                      run.limit.Left(), run.progress);
  const std::string said = Say(result);
  run.report.attempts.push_back({switches, said});
  if (said == "TetGen did not finish in time")
    throw Error(Code::kBadMesh,
                fmt::format("{} ({:g} s); use a larger --max-edge-mm, a surface of fewer triangles "
                            "(this one has {}), or a longer --time-limit",
                            said, run.limit.seconds(), run.surface.triangles.size()),
                run.source.file);
  if (said == "TetGen ran out of memory")
    throw Error(
        Code::kBadMesh,
        fmt::format("{} ({:g} MB); use a larger --max-edge-mm, a surface of fewer triangles "
                    "(this one has {}), or a larger --memory-limit",
                    said, run.options.memory_limit, run.surface.triangles.size()),
        run.source.file);
  if (said != "done") return std::nullopt;
  TetMesh mesh = ReadTetgenMesh(folder.path());
  if (mesh.ElementCount() == 0) return std::nullopt;
  for (glm::dvec3& x : mesh.rest_positions) x *= 1.0 / scale;
  return mesh;
}

// Tries good elements first; when TetGen fails, the same without new nodes on the surface, which is
// more reliable; last without any bound on quality.
TetMesh Fill(const Run& run, double max_edge) {
  const TetrahedralizeOptions& options = run.options;
  const std::string quality =
      fmt::format("q{:g}/{:g}", options.radius_edge, DegreesFromRadians(options.min_dihedral));
  const std::string order = options.order == 2 ? "o2" : "";
  // z: numbers from 0; Y: no new nodes on the surface; Q: silent.
  for (const std::string& switches :
       {fmt::format("p{}zQ{}", quality, order), fmt::format("pY{}zQ{}", quality, order),
        fmt::format("pYzQ{}", order)}) {
    if (options.keep_surface && switches.find('Y') == switches.npos) continue;
    if (auto mesh = RunTetgen(run, switches, max_edge)) return *std::move(mesh);
  }
  std::string tried;
  for (const TetgenAttempt& attempt : run.report.attempts)
    if (tried.find(attempt.result) == tried.npos)
      tried += (tried.empty() ? "" : ", then ") + attempt.result;
  throw Error(
      Code::kBadMesh,
      fmt::format("this surface could not be filled ({}); remesh it with more even triangles",
                  tried),
      run.source.file);
}

// `flag` is the switch that bounds the longest edge within so much volume.
void RefuseTooMany(double volume, double max_edge, const char* flag, const SurfaceSource& source) {
  if (max_edge <= 0) return;
  const double expected = kElementsPerCube * volume / (max_edge * max_edge * max_edge);
  if (expected <= kMostElements) return;
  const double least = std::cbrt(kElementsPerCube * volume / kMostElements);
  throw Error(
      Code::kBadMesh,
      fmt::format("edges of at most {:g} mm would make about {:.2g} million elements; use "
                  "{} {:.2g} or more",
                  MmFromMetres(max_edge), expected * 1e-6, flag, 1.05 * MmFromMetres(least)),
      source.file);
}

void RequireFinePlaces(const SurfaceMesh& surface, double volume, const SurfaceSource& source,
                       const TetrahedralizeOptions& options) {
  if (options.fine_at.empty() != (options.fine_edge <= 0))
    throw Error(Code::kBadArgument,
                "--fine-at says where the mesh is finer and --fine-edge-mm how fine; give both",
                source.file);
  RequireTouching(options.fine_at, surface, "a place of --fine-at", source);
  double balls = 0;
  for (const Ball& place : options.fine_at)
    balls += 4.0 / 3.0 * std::numbers::pi * place.radius * place.radius * place.radius;
  RefuseTooMany(std::min(volume, balls), options.fine_edge, "--fine-edge-mm", source);
}

void Simplify(SurfaceMesh& surface, const SurfaceSource& source,
              const TetrahedralizeOptions& options, TetrahedralizeReport& report,
              const Progress& progress) {
  report.simplification = SimplifySurface(surface, options.max_triangles, progress);
  report.surface = CheckSurface(surface, progress);
  if (!report.surface.IsClosedManifold() || report.surface.self_intersections.count > 0)
    throw Error(Code::kBadMesh,
                fmt::format("with {} triangles this surface would run through itself; use a larger "
                            "--max-triangles",
                            report.simplification.triangles_after),
                source.file);
}

// Edge that is longer than the limit.
struct LongEdge {
  const char* where;
  double length, asked;  // m

  std::string Words() const {
    return fmt::format("the longest edge{} is {:.4g} mm, more than the {:g} mm asked for", where,
                       MmFromMetres(length), MmFromMetres(asked));
  }
};

std::vector<LongEdge> TooLongEdges(const Run& run) {
  const TetrahedralizeOptions& options = run.options;
  const TetrahedralizeReport& report = run.report;
  std::vector<LongEdge> edges;
  if (options.max_edge > 0 && report.quality.longest_edge > options.max_edge)
    edges.push_back({"", report.quality.longest_edge, options.max_edge});
  if (options.fine_edge > 0 && report.longest_fine_edge > options.fine_edge)
    edges.push_back({" in a place of --fine-at", report.longest_fine_edge, options.fine_edge});
  return edges;
}

// A mesh coarser than its limit does not have the error that the author chose. With keep_surface
// the surface's own edges were also asked for, and take precedence.
void RequireEdges(const Run& run) {
  if (run.options.keep_surface) return;
  const std::vector<LongEdge> edges = TooLongEdges(run);
  if (edges.empty()) return;
  const std::string& first = run.report.attempts.front().result;
  throw Error(
      Code::kBadMesh,
      fmt::format(
          "{}{}; remesh the surface with more even triangles, ask for a longer "
          "edge, or take the surface's own with --keep-surface",
          edges.front().Words(),
          first == "done" ? "" : ", since no node could be added on the surface (" + first + ")"),
      run.source.file);
}

void Warn(const Run& run) {
  TetrahedralizeReport& report = run.report;
  const TetQuality& quality = report.quality;
  const auto warn = [&](std::string sentence) { report.warnings.push_back(std::move(sentence)); };
  if (report.surface.tiny_components.count > 0)
    warn(
        fmt::format("{} of {} separate parts are tiny and will float freely; --drop-below 0.001 "
                    "drops them",
                    report.surface.tiny_components.count, report.surface.components));
  if (run.options.max_triangles > 0 &&
      report.simplification.triangles_after > run.options.max_triangles)
    warn(fmt::format("{} triangles are left, since fewer would fold the surface",
                     report.simplification.triangles_after));
  if (report.attempts.size() > 1 && report.attempts.front().result != "done")
    warn("no node could be added on the surface (" + report.attempts.front().result +
         "), so elements there are as uneven as its triangles");
  if (quality.min_dihedral < run.options.min_dihedral)
    warn(
        fmt::format("the flattest dihedral angle is {:.2f} degrees; the surface has sharp edges or "
                    "uneven triangles",
                    DegreesFromRadians(quality.min_dihedral)));
  if (quality.worst_relative_volume < kSliverVolume)
    warn("there are nearly flat elements; remesh the surface with more even triangles");
  for (const LongEdge& edge : TooLongEdges(run)) warn(edge.Words());
}

}  // namespace

TetMesh Tetrahedralize(const SurfaceMesh& surface, const SurfaceSource& source,
                       const TetrahedralizeOptions& options, TetrahedralizeReport* report,
                       const Progress& whole, const fs::path& program) {
  TetrahedralizeReport own_report;
  TetrahedralizeReport& result = report ? *report : own_report;
  CheckOptions(options);
  const TimeLimit limit(options.time_limit, options.begun.value_or(Clock::now()));
  const Progress progress = limit.Watch(whole, source.file, surface.triangles.size());

  // Size first: with a wrong unit every other message would be misleading.
  progress.Step("checking the surface", 0.0);
  const auto check_start = Clock::now();
  RepairedSurface repaired =
      RepairSurface(surface, {options.fill_holes, options.drop_below}, progress);
  if (options.thickness != 0)
    result.thickened_parts = ThickenOpenParts(repaired, options.thickness);
  SurfaceSource repaired_source = source;
  repaired_source.triangle_in_file = repaired.source_triangle;
  result.repairs = repaired.repairs;
  result.surface = CheckSurface(repaired.surface, progress);
  RequireTissueSize(result.surface, repaired_source);
  RequireMeshable(result.surface, repaired_source);
  if (options.max_triangles > 0) Simplify(repaired.surface, source, options, result, progress);
  RefuseTooMany(result.surface.volume, options.max_edge, "--max-edge-mm", source);
  RequireFinePlaces(repaired.surface, result.surface.volume, source, options);
  result.check_ms = MsSince(check_start);

  // TetGen's last smoothing can stretch an edge slightly past the limit; then once more, tighter.
  progress.Step("filling it with tetrahedra", 0.1);
  const auto mesh_start = Clock::now();
  const Run run{repaired.surface, source, options, progress, limit, program, result};
  TetMesh mesh;
  double max_edge = options.max_edge;
  for (int pass = 0; pass < kMostEdgePasses; ++pass) {
    mesh = Fill(run, max_edge);
    result.quality = MeasureTets(mesh);
    const double excess = options.max_edge > 0 ? result.quality.longest_edge / options.max_edge : 0;
    // Without nodes on the surface, its own edges keep their lengths.
    if (excess <= 1.0 || result.attempts.back().switches.find('Y') != std::string::npos) break;
    max_edge *= 0.98 / excess;
  }
  result.mesh_ms = MsSince(mesh_start);

  progress.Step("measuring the elements", 0.9);
  const auto measure_start = Clock::now();
  mesh.sets["surface"] = SurfaceNodes(mesh);
  result.nodes = static_cast<int>(mesh.rest_positions.size());
  result.elements = mesh.ElementCount();
  result.surface_nodes = static_cast<int>(
      std::count(mesh.sets["surface"].begin(), mesh.sets["surface"].end(), std::uint8_t{1}));
  for (const Ball& place : options.fine_at)
    result.longest_fine_edge = std::max(result.longest_fine_edge, LongestEdgeIn(place, mesh));
  result.volume_error =
      std::abs(result.quality.volume - result.surface.volume) / result.surface.volume;
  result.measure_ms = MsSince(measure_start);
  if (result.quality.inverted > 0 || result.volume_error > 1e-3)
    throw Error(Code::kBadMesh,
                fmt::format("TetGen's mesh is unsound ({} elements without volume, volume off by "
                            "{:.2g}); remesh the surface with more even triangles",
                            result.quality.inverted, result.volume_error),
                source.file);
  RequireEdges(run);
  Warn(run);
  progress.Step("done", 1.0);
  return mesh;
}

std::string ReportText(const TetrahedralizeReport& report, const SurfaceSource& source,
                       const TetrahedralizeOptions& options) {
  const SurfaceRepairs& repairs = report.repairs;
  const SurfaceCheck& surface = report.surface;
  const TetQuality& quality = report.quality;
  nlohmann::json attempts = nlohmann::json::array();
  for (const TetgenAttempt& attempt : report.attempts)
    attempts.push_back({{"switches", attempt.switches}, {"result", attempt.result}});
  nlohmann::json fine_at = nlohmann::json::array();
  for (const Ball& place : options.fine_at)
    fine_at.push_back(
        {{"centre", {place.centre.x, place.centre.y, place.centre.z}}, {"radius", place.radius}});
  const glm::dvec3 size = surface.high - surface.low;
  const nlohmann::json json = {
      {"schema", "arthroscene.tetrahedralize/1"},
      {"input", {{"file", source.file.string()}, {"unit", source.unit}}},
      {"order", options.order},
      {"nodes", report.nodes},
      {"elements", report.elements},
      {"surface_nodes", report.surface_nodes},
      {"volume", quality.volume},
      {"volume_error", report.volume_error},
      {"min_dihedral_deg", DegreesFromRadians(quality.min_dihedral)},
      {"max_dihedral_deg", DegreesFromRadians(quality.max_dihedral)},
      {"worst_radius_edge", quality.worst_radius_edge},
      {"worst_relative_volume", quality.worst_relative_volume},
      {"worst_jacobian", quality.worst_jacobian},
      {"longest_edge", quality.longest_edge},
      {"median_edge", quality.median_edge},
      {"fine_at", fine_at},
      {"longest_fine_edge", report.longest_fine_edge},
      {"surface",
       {{"vertices", surface.vertices},
        {"triangles", surface.triangles},
        {"components", surface.components},
        {"volume", surface.volume},
        {"area", surface.area},
        {"size", {size.x, size.y, size.z}}}},
      {"repairs",
       {{"merged_vertices", report.reading.merged_vertices},
        {"polygons_split", report.reading.polygons_split},
        {"welded_vertices", repairs.welded_vertices},
        {"degenerate_triangles", report.reading.degenerate_triangles + repairs.collapsed_triangles},
        {"flattened_triangles", repairs.flattened_triangles},
        {"duplicate_triangles", repairs.duplicate_triangles},
        {"unreferenced_vertices",
         report.reading.unreferenced_vertices + repairs.unreferenced_vertices},
        {"thickened_parts", report.thickened_parts},
        {"filled_holes", repairs.filled_holes},
        {"reoriented_triangles", repairs.reoriented_triangles},
        {"flipped_components", repairs.flipped_components},
        {"dropped_components", repairs.dropped_components}}},
      {"simplification",
       {{"triangles_before", report.simplification.triangles_before},
        {"triangles_after", report.simplification.triangles_after},
        {"largest_distance", report.simplification.largest_distance}}},
      {"improvement",
       {{"min_dihedral_before_deg", DegreesFromRadians(report.improvement.before)},
        {"edges_removed", report.improvement.edges_removed},
        {"faces_flipped", report.improvement.faces_flipped},
        {"edges_collapsed", report.improvement.edges_collapsed},
        {"nodes_moved", report.improvement.nodes_moved}}},
      {"attempts", attempts},
      {"warnings", report.warnings},
      {"stages_ms",
       {{"check", report.check_ms}, {"mesh", report.mesh_ms}, {"measure", report.measure_ms}}},
      {"options", JsonFromOptions(options)},
  };
  return json.dump(2) + "\n";
}

}  // namespace arthro::authoring
