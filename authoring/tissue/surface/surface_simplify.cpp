#include "authoring/tissue/surface/surface_simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/time_limit.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::authoring {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

// Largest rotation of a triangle's normal by a collapse.
constexpr float kMostTurn = 60.0f;  // deg

constexpr const char* kStage = "simplifying the surface";

// Reports the collapses of a decimater, and ends it when the job is cancelled.
class CollapseSteps : public OpenMesh::Decimater::Observer {
 public:
  CollapseSteps(const Progress& progress, std::size_t all)
      : Observer(kEvery), progress_(progress), all_(all) {}

  void notify(std::size_t collapses) override {
    try {
      progress_.Step(kStage,
                     std::min(1.0, static_cast<double>(collapses) / static_cast<double>(all_)));
    } catch (...) {
      stopped_ = std::current_exception();
    }
  }
  bool abort() const override { return stopped_ != nullptr; }
  void ThrowIfStopped() const {
    if (stopped_) std::rethrow_exception(stopped_);
  }

 private:
  static constexpr std::size_t kEvery = 4096;
  const Progress& progress_;
  std::size_t all_;
  std::exception_ptr stopped_;
};

// Quadric error plus a share of the squared edge length, weighted by place.
class EvenQuadric : public OpenMesh::Decimater::ModQuadricT<Mesh> {
 public:
  using Base = OpenMesh::Decimater::ModQuadricT<Mesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<EvenQuadric>;
  using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<Mesh>;
  explicit EvenQuadric(Mesh& mesh) : Base(mesh) {}

  float collapse_priority(const CollapseInfo& info) override {
    // An edge of 3 mm counts as an error of 0.16 mm.
    constexpr double kLengthShare = 0.003;
    const float quadric = Base::collapse_priority(info);
    if (quadric < 0) return quadric;  // not allowed
    const double length = kLengthShare * (info.p0 - info.p1).sqrnorm();
    const glm::dvec3 x(info.p0[0], info.p0[1], info.p0[2]);
    const double by = weight ? (*weight)(1e-3 * x) : 1.0;
    return static_cast<float>((quadric + length) * by);
  }
  const std::function<double(const glm::dvec3&)>* weight = nullptr;
};

// `prepare` adds the module that orders the edges.
template <class Prepare>
Simplification Simplify(SurfaceMesh& surface, int most_triangles, const Progress& progress,
                        const Prepare& prepare) {
  Simplification result;
  result.triangles_before = result.triangles_after = static_cast<int>(surface.triangles.size());
  if (result.triangles_before <= most_triangles) return result;
  progress.Step(kStage, 0.0);

  Mesh mesh;
  OpenMesh::VPropHandleT<int> source;
  mesh.add_property(source);
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    // In millimetres, because the decimater orders edges by squared errors in 32 bits.
    const glm::dvec3 x = 1e3 * surface.vertices[i];
    const auto vertex = mesh.add_vertex({x.x, x.y, x.z});
    mesh.property(source, vertex) = static_cast<int>(i);
  }
  StageSteps faces(progress, kStage, surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    faces.Next();
    mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c));
  }
  mesh.request_face_normals();
  mesh.update_face_normals();

  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle no_folds;
  prepare(decimater);
  decimater.add(no_folds);
  decimater.module(no_folds).set_max_normal_deviation(kMostTurn);
  decimater.initialize();
  CollapseSteps collapses(progress, surface.vertices.size());
  decimater.set_observer(&collapses);
  decimater.decimate_to_faces(0, static_cast<std::size_t>(most_triangles));
  collapses.ThrowIfStopped();
  mesh.garbage_collection();

  SurfaceMesh simple;
  std::vector<char> stays(surface.vertices.size(), false);
  for (const auto vertex : mesh.vertices()) {
    stays[mesh.property(source, vertex)] = true;
    simple.vertices.push_back(surface.vertices[mesh.property(source, vertex)]);
  }
  for (const auto face : mesh.faces()) {
    std::array<int, 3> triangle{};
    int corner = 0;
    for (const auto vertex : mesh.fv_range(face)) triangle[corner++] = vertex.idx();
    simple.triangles.push_back(triangle);
  }
  const SurfaceFinder finder(simple);
  StageSteps distances(progress, kStage, surface.vertices.size());
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    distances.Next();
    if (!stays[i])
      result.largest_distance =
          std::max(result.largest_distance,
                   glm::distance(surface.vertices[i], finder.Nearest(surface.vertices[i])));
  }
  result.triangles_after = static_cast<int>(simple.triangles.size());
  surface = std::move(simple);
  return result;
}

}  // namespace

Simplification SimplifySurface(SurfaceMesh& surface, int most_triangles, const Progress& progress) {
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  return Simplify(surface, most_triangles, progress, [&](auto& decimater) {
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
  });
}

Simplification SimplifyEvenly(SurfaceMesh& surface, int most_triangles,
                              const std::function<double(const glm::dvec3&)>& weight,
                              const Progress& progress) {
  EvenQuadric::Handle quadric;
  return Simplify(surface, most_triangles, progress, [&](auto& decimater) {
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.module(quadric).weight = &weight;
  });
}

}  // namespace arthro::authoring
