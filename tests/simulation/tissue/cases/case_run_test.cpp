// Cases without a valid answer.
#include "simulation/tissue/cases/case_run.h"

#include <gtest/gtest.h>

#include "tests/support/shared_data.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::simulation {
namespace {

// Bar fixed at one end under a load that no shape of the material can bear.
TissueCase Crushed(Law law, bool is_dynamic) {
  TissueCase c;
  c.mesh = test::BeamMesh(1, {4, 1, 1});
  c.material.law = law;
  c.material.young_modulus = 1e6;
  c.material.poisson_ratio = law == Law::kCorotated ? 0.0 : 0.4;
  c.fixed = {{"clamp", 7}};
  c.body_force = {-1e10, 3e9, 2e9};  // N/m³: a million times its weight, towards the clamp
  c.is_dynamic = is_dynamic;
  c.dt = 0.01;
  c.steps = 3;
  return c;
}

TEST(RunCase, EquilibriumWithInvertedElementsIsNotConverged) {
  for (const Law law : {Law::kCorotated, Law::kStableNeoHookean}) {
    const CaseResult result = RunCase(Crushed(law, false));
    EXPECT_GT(result.inverted_elements, 0);
    EXPECT_FALSE(result.converged);
  }
}

TEST(RunCase, MotionWithInvertedElementsIsNotConverged) {
  const CaseResult result = RunCase(Crushed(Law::kCorotated, true));
  EXPECT_GT(result.inverted_elements, 0);
  EXPECT_FALSE(result.converged);
}

TEST(RunCase, EquilibriaWithInvertedElementsAreRefused) {
  ARTHRO_REQUIRE_SHARED(folder, "faults/solve");
  for (const char* name : {"17", "75"}) {
    const CaseResult result = RunCase(ReadCase(folder / name / "case.json"));
    EXPECT_EQ(result.converged, result.inverted_elements == 0) << name;
  }
}

}  // namespace
}  // namespace arthro::simulation
