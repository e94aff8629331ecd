#include "tests/benchmark/bullet_body.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableLinearElasticityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <cstddef>
#include <vector>

namespace arthro::test {
namespace {

constexpr double kCentimetres = 1e2, kGrams = 1e3, kDynes = 1e5, kBarye = 10;  // per SI unit

btVector3 Vector(const glm::dvec3& v, double factor) {
  return {static_cast<btScalar>(v.x * factor), static_cast<btScalar>(v.y * factor),
          static_cast<btScalar>(v.z * factor)};
}

// Forces added to nodes are cleared before the implicit solver sees them, so they come as a force
// law of their own.
class DeadLoad : public btDeformableLagrangianForce {
 public:
  explicit DeadLoad(std::vector<btVector3> force) : force_(std::move(force)) {}

  void addScaledForces(btScalar scale, TVStack& force) override {
    for (std::size_t i = 0; i < force_.size(); ++i) force[static_cast<int>(i)] += scale * force_[i];
  }
  void addScaledExplicitForce(btScalar scale, TVStack& force) override {
    addScaledForces(scale, force);
  }
  void addScaledDampingForce(btScalar, TVStack&) override {}
  void addScaledDampingForceDifferential(btScalar, const TVStack&, TVStack&) override {}
  void buildDampingForceDifferentialDiagonal(btScalar, TVStack&) override {}
  void addScaledElasticForceDifferential(btScalar, const TVStack&, TVStack&) override {}
  // One law a type, and gravity is treated apart: any other type that is not in use will do.
  btDeformableLagrangianForceType getForceType() override { return BT_COROTATED_FORCE; }

 private:
  std::vector<btVector3> force_;
};

class Solver : public btDeformableBodySolver {
 public:
  explicit Solver(const BulletOptions& options) {
    m_cg.m_maxIterations = options.max_cg_iterations;
    m_cg.setTolerance(static_cast<btScalar>(options.cg_tolerance));
  }
};

}  // namespace

struct BulletBody::Impl {
  explicit Impl(const BulletOptions& options)
      : dispatcher(&configuration),
        solver(options),
        world(&dispatcher, &broadphase, &constraints, &configuration, &solver) {
    constraints.setDeformableSolver(&solver);
    world.setGravity({0, 0, 0});
    world.getWorldInfo().m_gravity.setZero();
    world.setImplicit(true);
    world.setLineSearch(false);
    world.setUseProjection(true);  // without it bodies with nodes of no mass do not move
  }
  ~Impl() {
    if (body) world.removeSoftBody(body.get());
  }

  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btDeformableMultiBodyConstraintSolver constraints;
  Solver solver;
  btDeformableMultiBodyDynamicsWorld world;
  std::unique_ptr<btDeformableLinearElasticityForce> elasticity;
  std::unique_ptr<DeadLoad> load;
  std::unique_ptr<btSoftBody> body;
};

BulletBody::BulletBody(const TetMesh& mesh, const simulation::Material& material,
                       std::span<const double> mass, std::span<const unsigned char> held,
                       std::span<const glm::dvec3> force, const BulletOptions& options)
    : impl_(std::make_unique<Impl>(options)) {
  std::vector<btVector3> places, forces;
  std::vector<btScalar> masses;
  for (std::size_t i = 0; i < mesh.rest_positions.size(); ++i) {
    places.push_back(Vector(mesh.rest_positions[i], kCentimetres));
    forces.push_back(Vector(force[i], held[i] != 0 ? 0 : kDynes));
    masses.push_back(held[i] != 0 ? 0 : static_cast<btScalar>(mass[i] * kGrams));
  }
  impl_->body = std::make_unique<btSoftBody>(
      &impl_->world.getWorldInfo(), static_cast<int>(places.size()), places.data(), masses.data());
  btSoftBody& body = *impl_->body;
  for (std::size_t e = 0; e < mesh.elements.size(); e += 4)
    body.appendTetra(mesh.elements[e], mesh.elements[e + 1], mesh.elements[e + 2],
                     mesh.elements[e + 3]);
  body.initializeDmInverse();
  body.m_tetraScratches.resize(body.m_tetras.size());
  body.m_tetraScratchesTn.resize(body.m_tetras.size());
  body.m_cfg.collisions = 0;
  body.setSelfCollision(false);
  body.setActivationState(DISABLE_DEACTIVATION);
  impl_->world.addSoftBody(&body);

  const auto [mu, lambda] = simulation::LameOf(material);
  impl_->elasticity = std::make_unique<btDeformableLinearElasticityForce>(
      static_cast<btScalar>(mu * kBarye), static_cast<btScalar>(lambda * kBarye), btScalar(0),
      static_cast<btScalar>(options.damping));
  impl_->load = std::make_unique<DeadLoad>(std::move(forces));
  impl_->world.addForce(&body, impl_->elasticity.get());
  impl_->world.addForce(&body, impl_->load.get());
}

BulletBody::~BulletBody() = default;

void BulletBody::Step(double dt) { impl_->world.stepSimulation(static_cast<btScalar>(dt), 0); }

glm::dvec3 BulletBody::Position(int node) const {
  const btVector3& x = impl_->body->m_nodes[node].m_x;
  return glm::dvec3(x.x(), x.y(), x.z()) / kCentimetres;
}

}  // namespace arthro::test
