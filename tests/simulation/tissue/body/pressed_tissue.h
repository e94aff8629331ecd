// Tissue with a tool pressed into it and two solvers: the session's, and one iterated to
// convergence, with which the servo's force is compared. The tissue may lie on a plane. Own frame,
// m, N.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/contact/coupling.h"
#include "simulation/tissue/contact/obstacle_contact.h"
#include "simulation/tissue/contact/tool_contact.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/simulation/tissue/contact/slab.h"
#include "tests/simulation/tissue/cut/mesh_boundary.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {

inline constexpr double kStep = 1.0 / 60;  // s

struct PressingTool {
  std::vector<simulation::Capsule> capsules;
  glm::dvec3 tip{0.0}, motion{0.0};
  simulation::ToolGrip grip;
};

inline PressingTool ToolAt(simulation::ToolKind kind, const Rigid3& body_from_tool) {
  simulation::ToolInput input;
  input.is_present = true;
  input.portal_from_tool = body_from_tool;
  std::array<simulation::Capsule, simulation::kMaxCapsules> capsules;
  const int count = PosedCapsules(simulation::ShapeOf(kind), input, capsules);
  return {{capsules.begin(), capsules.begin() + count}, body_from_tool.translation, {}, {}};
}

inline void MoveBy(PressingTool& tool, const glm::dvec3& way) {
  for (simulation::Capsule& capsule : tool.capsules) capsule.a += way, capsule.b += way;
  tool.tip += way;
  tool.motion = way;
}

// State of tissue and tool, copied to try a motion.
struct PressedState {
  simulation::BodyState body;
  PressingTool tool;
};

class PressedTissue {
 public:
  template <class IsHeld>
  PressedTissue(TetMesh elements, SurfaceMesh surface, const simulation::Material& material,
                IsHeld&& is_held)
      : mesh(std::move(elements)),
        finder(mesh),
        skin(simulation::EmbedSkin(std::move(surface), mesh, finder)),
        field(simulation::SolidField::FromSurface(skin.rest, 3.5e-4)),
        contact(skin, mesh, field, material.young_modulus),
        model(std::make_shared<simulation::FemModel>(mesh, material)),
        positions(skin.point.size()),
        normals(skin.point.size()) {
    for (const glm::dvec3& x : mesh.rest_positions) fixed.push_back(is_held(x) ? 7 : 0);
    rest_contact = std::make_unique<simulation::ObstacleContact>(mesh, fixed);
    solver = std::make_unique<simulation::ImplicitSolver>(model, fixed,
                                                          simulation::BodyOptions{}.solver);
    simulation::SolverOptions tight;
    tight.tolerance = 1e-6;
    tight.max_newton = 50;
    tight.max_iterations = 2000;
    exact = std::make_unique<simulation::ImplicitSolver>(model, fixed, tight);
    state.x = mesh.rest_positions;
    state.v.assign(state.x.size(), glm::dvec3(0.0));
    load.assign(state.x.size(), glm::dvec3(0.0));
    Refit();
  }
  PressedTissue(const PressedTissue&) = delete;

  simulation::StepReport Step(PressingTool& tool, simulation::ImplicitSolver& with) {
    contacts.clear();
    contact.Find(tool.capsules, tool.motion, 0, options, contacts, &tool.grip);
    of_tool = contacts.size();
    if (ground != nullptr) {
      rest_contact->Forget();
      rest_contact->Find(*ground, Rigid3{}, state.x, on_ground, contacts);
    }
    results.assign(contacts.size(), {});
    const simulation::StepReport report = with.Step(state, load, contacts, {}, kStep, results);
    UpdateGrip(contacts, results, 0, options, tool.grip);
    Refit();
    return report;
  }
  void Refit() {
    DeformSkin(skin, mesh, state.x, positions, normals);
    contact.Refit(positions, normals, state.x);
  }
  glm::dvec3 Force() const {
    glm::dvec3 force(0.0);
    for (std::size_t i = 0; i < of_tool; ++i) force -= results[i].force;
    return force;
  }
  // Steps until the force is constant; returns the number of steps.
  int Settle(PressingTool& tool, double tolerance = 1e-5, int most = 200) {
    glm::dvec3 last(1e9);
    tool.motion = glm::dvec3(0.0);
    int n = 0, quiet = 0;
    while (n < most && quiet < 3) {
      Step(tool, *exact);
      ++n;
      quiet = glm::length(Force() - last) < tolerance * std::max(glm::length(Force()), 0.01)
                  ? quiet + 1
                  : 0;
      last = Force();
    }
    return n;
  }

  TetMesh mesh;
  simulation::ElementFinder finder;
  simulation::EmbeddedSkin skin;
  simulation::SolidField field;
  simulation::SkinContact contact;
  std::shared_ptr<simulation::FemModel> model;
  std::unique_ptr<simulation::ObstacleContact> rest_contact;
  std::unique_ptr<simulation::ImplicitSolver> solver, exact;
  simulation::FixedAxes fixed;
  simulation::BodyState state;
  simulation::ToolContactOptions options;
  simulation::ObstacleContactOptions on_ground;
  const simulation::RigidObstacle* ground = nullptr;
  std::vector<glm::dvec3> positions, normals, load;
  std::vector<simulation::ContactPoint> contacts;
  std::vector<simulation::ContactResult> results;
  std::size_t of_tool = 0;
};

}  // namespace arthro::test
