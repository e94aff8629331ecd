// Displayed shape of a thin layer under a tool. The surface yields by the tool's depth, and the rim
// follows like a membrane on a foundation (Pasternak), with a decay length of half a thickness.
// Display only: the force comes from ElasticLayer. An untouched layer costs nothing, and a released
// one is exactly at rest. Own frame (the scene's tissue frame, scale applied), m.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/elastic_layer.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

// Tissue without a mesh that deforms as a layer of constant thickness on bone.
struct LayerSpec {
  std::string name;
  int tissue = 0;       // index in the scene
  SurfaceMesh surface;  // own frame
  Rigid3 portal_from_body;
  ElasticLayer layer;
};

class LayerSkin {
 public:
  explicit LayerSkin(LayerSpec spec);

  // Dents the layer by the drawn tool, portal frame, `depth` deep in the layer. Allocates nothing.
  void Press(std::span<const Capsule> capsules, double depth) noexcept;
  void Release() noexcept;

  bool is_pressed() const { return !moved_.empty(); }
  const LayerSpec& spec() const { return spec_; }
  std::span<const glm::dvec3> positions() const { return positions_; }
  std::span<const glm::dvec3> normals() const { return normals_; }
  const std::shared_ptr<const BodySkin>& skin() const { return skin_; }  // at rest
  std::uint64_t shape_version() const { return version_; }

 private:
  void Relax() noexcept;
  void TakeShape() noexcept;

  LayerSpec spec_;
  std::shared_ptr<const BodySkin> skin_;  // shared with the pictures
  std::vector<glm::dvec3> rest_normals_, positions_, normals_;
  std::vector<int> neighbour_, first_neighbour_, triangle_, first_triangle_;  // per vertex
  std::vector<double> dent_, least_;  // per vertex, along −normal: as shown, as required
  std::vector<int> moved_;            // vertices near the tool, rising
  std::uint64_t version_ = 1;
};

}  // namespace arthro::simulation
