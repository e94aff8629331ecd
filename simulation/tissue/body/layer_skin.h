// What a thin layer looks like under a tool: its surface goes before the tool as far as the tool is
// in it, and the rim comes down with it as a membrane on a foundation does (Pasternak), over half a
// thickness. A picture only: the force is ElasticLayer's. Nothing is computed of a layer that is
// not pressed, and one that is let go is exactly at rest. Own frame (the scene's tissue frame,
// scale applied), m.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/elastic_layer.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

// A tissue without a mesh that gives way as a layer of even thickness on bone.
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

  // The tool where it is drawn, portal frame, `depth` deep in the layer. Allocates nothing.
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
  std::vector<int> neighbour_, first_neighbour_, triangle_, first_triangle_;  // of a vertex
  std::vector<double> dent_, least_;  // a vertex, along −normal: as shown, and what the tool asks
  std::vector<int> moved_;            // vertices near the tool, ascending
  std::uint64_t version_ = 1;
};

}  // namespace arthro::simulation
