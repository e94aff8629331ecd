// Laws at one point: energy, stress and tangent are compared by differences, and the projection
// with Eigen's eigensolver. Every error is relative to μ or to the largest entry compared.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Matrix9 = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

constexpr double kMu = 2.0, kLambda = 18.0;  // ν = 0.45

struct Fibres {
  const char* name;
  double stiffness;
  bool bear_compression;
};
constexpr Fibres kNoFibres{"none", 0, true}, kFibres{"both ways", 40, true},
    kTensionOnly{"tension only", 40, false};

const Eigen::Vector3d kDirection = Eigen::Vector3d(1, 2, -2) / 3;

struct Answer {
  double psi, j;
  Vector9 p;
  Matrix9 a;
};
Answer At(const Matrix3& f, Law law, Tangent tangent = Tangent::kTrue,
          const Fibres& fibres = kNoFibres, InstructionSet set = InstructionSet::kScalar) {
  PointJob job{{kMu, kLambda, fibres.stiffness, fibres.bear_compression},
               law,
               tangent,
               {},
               {kDirection.x(), kDirection.y(), kDirection.z()}};
  for (int i = 0; i < 9; ++i) job.f[i] = f(i / 3, i % 3);
  const PointResponse raw = KernelOf(set)->point(job);
  Answer answer{raw.psi, raw.j, Vector9(raw.p.data()), Matrix9(raw.dp_df.data())};
  return answer;
}

Matrix3 RandomMatrix(Random& random, double size) {
  Matrix3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = random.Uniform(-size, size);
  return m;
}
Matrix3 RandomRotation(Random& random) {
  Eigen::Quaterniond q(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                       random.Uniform(-1, 1));
  return q.normalized().toRotationMatrix();
}
Matrix3 Stretched(Random& random, double s0, double s1, double s2) {
  return RandomRotation(random) * Eigen::Vector3d(s0, s1, s2).asDiagonal() * RandomRotation(random);
}

struct Deformation {
  const char* name;
  Matrix3 f;
};
std::vector<Deformation> Deformations() {
  Random random(7);
  std::vector<Deformation> all;
  for (int i = 0; i < 20; ++i)
    all.push_back({"random", Matrix3::Identity() + RandomMatrix(random, 0.3)});
  for (int i = 0; i < 10; ++i) all.push_back({"wild", RandomMatrix(random, 2)});
  all.push_back({"rest", Matrix3::Identity()});
  for (int i = 0; i < 5; ++i) {
    all.push_back({"rotated", RandomRotation(random)});
    all.push_back({"inverted", Stretched(random, 1.2, 0.9, -0.5)});
    all.push_back({"mirrored", Stretched(random, 1, 1, -0.4)});
    all.push_back({"flat", Stretched(random, 1.3, 0.8, 0)});
    all.push_back({"nearly flat", Stretched(random, 1.1, 0.7, 1e-7)});
    all.push_back({"nearly flat, inverted", Stretched(random, 1.1, 0.7, -1e-7)});
    all.push_back({"a line", Stretched(random, 1.4, 0, 0)});
    all.push_back({"nearly a line", Stretched(random, 1.4, 1e-9, 1e-9)});
    all.push_back({"long", Stretched(random, 20, 0.2, 0.2)});
  }
  all.push_back({"a point", Matrix3::Zero()});
  return all;
}

// Smallest sum of two (signed) singular values; at 0 the rotation of the polar decomposition has no
// derivative.
double LeastStretchSum(const Matrix3& f) {
  const Eigen::Vector3d s = f.jacobiSvd().singularValues();
  return s[1] + std::copysign(s[2], f.determinant());
}

// Fourth-order difference along each entry of F: error h⁴ + 1e-16/h.
template <class T>
T Difference(const std::function<T(const Matrix3&)>& value, const Matrix3& f, int entry, double h) {
  const auto at = [&](double step) {
    Matrix3 moved = f;
    moved(entry / 3, entry % 3) += step;
    return value(moved);
  };
  return (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

// Largest relative differences of P from ∂Ψ and of the tangent from ∂P.
struct Mismatch {
  double stress = 0, tangent = 0;
};
Mismatch Compare(const Matrix3& f, Law law, const Fibres& fibres, double h) {
  const Answer exact = At(f, law, Tangent::kTrue, fibres);
  const double stress_scale = exact.p.cwiseAbs().maxCoeff() + kMu + fibres.stiffness;
  const double tangent_scale = exact.a.cwiseAbs().maxCoeff() + kMu + fibres.stiffness;
  Mismatch off;
  for (int i = 0; i < 9; ++i) {
    const double p = Difference<double>(
        [&](const Matrix3& m) { return At(m, law, Tangent::kNone, fibres).psi; }, f, i, h);
    const Vector9 a = Difference<Vector9>(
        [&](const Matrix3& m) { return At(m, law, Tangent::kNone, fibres).p; }, f, i, h);
    off.stress = std::max(off.stress, std::abs(p - exact.p[i]) / stress_scale);
    off.tangent = std::max(off.tangent, (a - exact.a.col(i)).cwiseAbs().maxCoeff() / tangent_scale);
  }
  return off;
}

// h = 1e-3 and derivatives of order 1 leave truncation and rounding errors of 1e-12 each. Singular
// values that are small or close together make the derivatives of R larger: 1e-8.
TEST(PointLaws, StressAndTangentAreDerivativesOfTheEnergy) {
  Mismatch worst;
  int compared = 0;
  for (const Law law : {Law::kStableNeoHookean, Law::kCorotated})
    for (const Deformation& d : Deformations()) {
      if (law == Law::kCorotated && LeastStretchSum(d.f) < 0.1) continue;
      const Mismatch off = Compare(d.f, law, kNoFibres, 1e-3);
      EXPECT_LT(off.stress, 1e-8) << d.name << "\n" << d.f;
      EXPECT_LT(off.tangent, 1e-8) << d.name << "\n" << d.f;
      worst.stress = std::max(worst.stress, off.stress);
      worst.tangent = std::max(worst.tangent, off.tangent);
      ++compared;
    }
  std::printf("%d deformations: stress %.1e, tangent %.1e\n", compared, worst.stress,
              worst.tangent);
  EXPECT_GT(compared, 100);
}

// Corotated law at a small sum of two stretches, with a difference step well below that sum: 1e-5.
TEST(PointLaws, CorotatedTangentIsTheDerivativeNearASingularRotation) {
  Random random(3);
  for (const double sum : {0.05, 0.01, 0.003})
    for (int i = 0; i < 5; ++i) {
      const Mismatch off =
          Compare(Stretched(random, 1.2, 0.5, sum - 0.5), Law::kCorotated, kNoFibres, 0.02 * sum);
      EXPECT_LT(off.stress, 1e-5) << sum;
      EXPECT_LT(off.tangent, 1e-5) << sum;
    }
}

// Fibre lengths on both sides of 1, of the guard at 1e-3, and exactly 0. The kink of tension-only
// fibres at 1 is not tested.
TEST(PointLaws, FibreStressIsTheDerivativeOfItsEnergy) {
  Random random(11);
  for (const Fibres& fibres : {kFibres, kTensionOnly})
    for (const double length : {2.0, 1.1, 0.9, 0.3, 0.02, 5e-4, 0.0}) {
      // F without its part along d, plus length · n: F d = length · n.
      Matrix3 f = Matrix3::Identity() + RandomMatrix(random, 0.3);
      const Eigen::Vector3d n = RandomRotation(random).col(0);
      f += (length * n - f * kDirection) * kDirection.transpose();
      const double h = length > 0.1 ? 1e-3 : length > 1e-3 ? 1e-4 : 1e-4;
      const Mismatch off = Compare(f, Law::kStableNeoHookean, fibres, h);
      // At 0.02 the tangent grows as 1/l and the step is l/200: truncation error 1e-7.
      EXPECT_LT(off.stress, 1e-7) << fibres.name << ", length " << length;
      EXPECT_LT(off.tangent, 1e-7) << fibres.name << ", length " << length;
    }
}

TEST(PointLaws, TensionOnlyFibreStressIsContinuous) {
  const auto stress = [](double length, const Fibres& fibres) {
    const Matrix3 f = Matrix3::Identity() + (length - 1) * kDirection * kDirection.transpose();
    return (At(f, Law::kCorotated, Tangent::kNone, fibres).p -
            At(f, Law::kCorotated, Tangent::kNone, kNoFibres).p)
        .norm();
  };
  for (const double length : {0.0, 0.5, 0.999}) EXPECT_EQ(stress(length, kTensionOnly), 0.0);
  EXPECT_NEAR(stress(1 + 1e-6, kTensionOnly), 40e-6, 1e-10);
  EXPECT_NEAR(stress(0.5, kFibres), 20, 1e-12);
}

TEST(PointLaws, RestAndRotationGiveZeroEnergyAndStress) {
  Random random(5);
  for (const Law law : {Law::kStableNeoHookean, Law::kCorotated}) {
    const Answer rest = At(Matrix3::Identity(), law, Tangent::kTrue, kFibres);
    EXPECT_EQ(rest.psi, 0) << "exactly zero at rest";
    EXPECT_EQ(rest.p.cwiseAbs().maxCoeff(), 0);
    for (int i = 0; i < 20; ++i) {
      const Answer turned = At(RandomRotation(random), law, Tangent::kTrue, kFibres);
      EXPECT_LT(std::abs(turned.psi), 1e-14 * kLambda);
      EXPECT_LT(turned.p.cwiseAbs().maxCoeff(), 1e-14 * kLambda);
    }
  }
}

// Both laws are linear elasticity at rest: P = 2μ ε + λ tr ε.
TEST(PointLaws, BothLawsReduceToLinearElasticityAtRest) {
  for (const Law law : {Law::kStableNeoHookean, Law::kCorotated}) {
    const Matrix9 a = At(Matrix3::Identity(), law).a;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          for (int l = 0; l < 3; ++l)
            EXPECT_NEAR(
                a(3 * i + k, 3 * j + l),
                kMu * ((i == j && k == l) + (i == l && k == j)) + kLambda * (i == k && j == l),
                1e-14 * kLambda);
  }
}

// Compares with the 9×9 whose negative eigenvalues Eigen sets to zero, for matrix and fibres
// separately.
TEST(PointLaws, ProjectedTangentDropsOnlyNegativeEigenvalues) {
  const auto project = [](const Matrix9& a) {
    const Eigen::SelfAdjointEigenSolver<Matrix9> eigen(0.5 * (a + a.transpose()));
    return Matrix9(eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                   eigen.eigenvectors().transpose());
  };
  double worst = 0, most_negative = 0;
  for (const Law law : {Law::kStableNeoHookean, Law::kCorotated})
    for (const Deformation& d : Deformations())
      for (const Fibres& fibres : {kNoFibres, kFibres}) {
        const Matrix9 matrix = At(d.f, law).a;
        const Matrix9 fibre = At(d.f, law, Tangent::kTrue, fibres).a - matrix;
        const Matrix9 expected = project(matrix) + project(fibre);
        const Matrix9 ours = At(d.f, law, Tangent::kProjected, fibres).a;
        const double scale = matrix.cwiseAbs().maxCoeff() + fibre.cwiseAbs().maxCoeff();
        const double off = (ours - expected).cwiseAbs().maxCoeff() / scale;
        // Both eigensolvers are accurate to about 1e-15 of the largest eigenvalue.
        EXPECT_LT(off, 1e-13) << d.name << "\n" << d.f;
        EXPECT_LT((ours - ours.transpose()).cwiseAbs().maxCoeff(), 1e-15 * scale) << d.name;
        const double least =
            Eigen::SelfAdjointEigenSolver<Matrix9>(ours).eigenvalues().minCoeff() / scale;
        EXPECT_GT(least, -1e-13) << d.name;
        worst = std::max(worst, off);
        most_negative = std::min(most_negative, least);
      }
  std::printf("off by %.1e, least eigenvalue %.1e of the largest entry\n", worst, most_negative);
}

TEST(PointLaws, ProjectedTangentEqualsAPositiveTrueTangent) {
  // At J = a the pressure is zero and every eigenvalue of stable neo-Hookean is at least μ.
  // Slightly stretched, the same holds for the corotated law.
  const Matrix3 f = Matrix3::Identity() * std::cbrt(1 + kMu / (kMu + kLambda));
  for (const Law law : {Law::kStableNeoHookean, Law::kCorotated}) {
    const Matrix9 exact = At(f, law, Tangent::kTrue, kFibres).a;
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix9>(exact).eigenvalues().minCoeff(), 0);
    EXPECT_EQ((At(f, law, Tangent::kProjected, kFibres).a - exact).cwiseAbs().maxCoeff(), 0);
  }
}

TEST(PointLaws, ResponseToZeroDeformationIsFinite) {
  for (const Law law : {Law::kStableNeoHookean, Law::kCorotated})
    for (const Tangent tangent : {Tangent::kTrue, Tangent::kProjected})
      for (const Deformation& d : Deformations()) {
        const Answer answer = At(d.f, law, tangent, kFibres);
        EXPECT_TRUE(std::isfinite(answer.psi)) << d.name;
        EXPECT_TRUE(answer.p.allFinite()) << d.name;
        EXPECT_TRUE(answer.a.allFinite()) << d.name;
      }
}

TEST(PointLaws, NanInputGivesNanOutput) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (int entry = 0; entry < 9; ++entry)
      for (const Law law : {Law::kStableNeoHookean, Law::kCorotated}) {
        Matrix3 f = Matrix3::Identity();
        f(entry / 3, entry % 3) = bad;
        const Answer answer = At(f, law, Tangent::kProjected, kFibres);
        EXPECT_FALSE(std::isfinite(answer.psi)) << entry;
        EXPECT_FALSE(answer.p.allFinite()) << entry;
      }
}

TEST(PointLaws, EveryInstructionSetGivesTheSameBits) {
  int sets = 0;
  for (const InstructionSet set :
       {InstructionSet::kSse2, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (KernelOf(set) == nullptr) continue;
    ++sets;
    for (const Law law : {Law::kStableNeoHookean, Law::kCorotated})
      for (const Tangent tangent : {Tangent::kTrue, Tangent::kProjected})
        for (const Deformation& d : Deformations()) {
          const Answer one = At(d.f, law, tangent, kFibres);
          const Answer other = At(d.f, law, tangent, kFibres, set);
          ASSERT_EQ(one.psi, other.psi) << KernelOf(set)->name << ", " << d.name;
          ASSERT_EQ(one.p, other.p) << KernelOf(set)->name << ", " << d.name;
          ASSERT_EQ(one.a, other.a) << KernelOf(set)->name << ", " << d.name;
        }
  }
  std::printf("%d instruction sets compared with the scalar one\n", sets);
  EXPECT_GE(sets, 1);
}

}  // namespace
}  // namespace arthro::simulation
