// Small bodies for the tests of this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <span>
#include <vector>

#include "simulation/core/random.h"
#include "simulation/tissue/fem/fem_model.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::simulation {

inline constexpr double kSide = 0.01;  // m

inline Material Rubber(Law law = Law::kStableNeoHookean) {
  Material m;
  m.law = law;
  m.young_modulus = 1e6;
  m.poisson_ratio = 0.45;
  return m;
}
inline Material Fibred(Law law) {
  Material m = Rubber(law);
  m.fibre_stiffness = 2e7;
  m.fibre_axis = FibreAxis::kCircumferentialZ;
  return m;
}

// Straight block of 2×2×3 cells.
inline TetMesh Block(int order) { return test::BlockMesh(order, {2, 2, 3}); }
// Crescent with mid-edge nodes on the curved boundary.
inline TetMesh Crescent(int order) {
  return test::MeniscusMesh(order, test::MeniscusTicks(test::Cells{6, 2, 1}));
}

inline std::vector<glm::dvec3> Moved(const TetMesh& mesh,
                                     const std::function<glm::dvec3(const glm::dvec3&)>& move) {
  std::vector<glm::dvec3> x;
  for (const glm::dvec3& at : mesh.rest_positions) x.push_back(move(at));
  return x;
}
inline std::vector<glm::dvec3> Shaken(const TetMesh& mesh, double size, int seed = 1) {
  Random random(seed);
  return Moved(mesh, [&](const glm::dvec3& at) {
    return at + glm::dvec3(random.Uniform(-size, size), random.Uniform(-size, size),
                           random.Uniform(-size, size));
  });
}

struct Assembled {
  Assembly sum;
  std::vector<glm::dvec3> force;
  BlockMatrix matrix;
};
inline Assembled AssembleAt(const FemModel& model, const std::vector<glm::dvec3>& x,
                            Tangent tangent = Tangent::kTrue,
                            const ElementKernel* kernel = nullptr) {
  Assembled a;
  a.force.resize(x.size());
  a.matrix.pattern = model.pattern();
  a.matrix.block.resize(model.pattern()->column.size());
  a.sum = model.Assemble(x, model.material().law, tangent, a.force, &a.matrix, kernel);
  return a;
}

inline double Largest(std::span<const glm::dvec3> vectors) {
  double largest = 0;
  for (const glm::dvec3& v : vectors)
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(v[k]));
  return largest;
}
inline glm::dvec3 Sum(std::span<const glm::dvec3> vectors) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& v : vectors) sum += v;
  return sum;
}
inline bool AreFinite(std::span<const glm::dvec3> vectors) {
  for (const glm::dvec3& v : vectors)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(v[k])) return false;
  return true;
}
template <class T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Rotation by 40° about (1, 2, 2)/3.
inline glm::dmat3 SomeRotation() {
  const glm::dvec3 n(1.0 / 3, 2.0 / 3, 2.0 / 3);
  const double c = std::cos(0.7), s = std::sin(0.7);
  glm::dmat3 r;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) r[k][i] = (1 - c) * n[i] * n[k] + (i == k ? c : 0);
  r[1][0] -= s * n.z, r[0][1] += s * n.z;
  r[0][2] -= s * n.y, r[2][0] += s * n.y;
  r[2][1] -= s * n.x, r[1][2] += s * n.x;
  return r;
}

}  // namespace arthro::simulation
