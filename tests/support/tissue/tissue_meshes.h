// Bodies on which tissue is measured, made in code at any resolution: a cantilever beam, Cook's
// membrane with a thickness, a bonded block, and a meniscus as a crescent wedge [benchmarks.md,
// Tissue references]. Each is a grid of hexahedra cut in six tetrahedra about the diagonal, and a
// map from the grid's parameters into space: middle nodes of T10 lie where the map puts the middle
// of the parameters, so on the true curved boundary. Own frame, m.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::test {

// Ends of the cells of a grid along each of its three parameters; rising, two at least.
using GridTicks = std::array<std::vector<double>, 3>;
using Cells = std::array<int, 3>;

std::vector<double> EvenTicks(double low, double high, int cells);
// Each cell `ratio` times as long as the one before.
std::vector<double> GradedTicks(double low, double high, int cells, double ratio);

// Nodes in the order of the grid, the last parameter running fastest; of order 2 it is the grid of
// half the cells. `place` must keep the handedness of the parameters.
TetMesh GridMesh(int order, const GridTicks& ticks,
                 const std::function<glm::dvec3(const glm::dvec3&)>& place);

// 100 × 10 × 10 mm along x. Sets: clamp (x = 0), end (x = 100 mm), tip (its four corners).
TetMesh BeamMesh(int order, const Cells& cells);

// 48 mm wide, its left side 44 mm and its right one 16 mm high, 10 mm thick. Sets: clamp, end, tip
// (the two upper corners of the end).
TetMesh CookMesh(int order, const Cells& cells);

// A cube of 10 mm. Sets: bottom, top, bulge (the middle of the side at x = 10 mm, when a node is
// there).
TetMesh BlockMesh(int order, const Cells& cells);

// Crescent about z with a wedge as section: z = 0 below, 1.5 mm high inside and 6 mm outside.
// Parameters: share of the sweep of 200° from +100° to −100°, radius in m, share of the height.
// Sets: horns (both ends), underside (z = 0 without the horns), patch (on the top, 12.5 to 15 mm
// from the axis, within 8.333° of the middle: 4.4 × 2.5 mm), inner (the upper inner edge in the
// middle).
// Without ticks on the patch's borders it is smaller than it should be.
TetMesh MeniscusMesh(int order, const GridTicks& ticks);

inline constexpr double kMeniscusInner = 0.010, kMeniscusOuter = 0.020;   // m
inline constexpr double kPatchInner = 0.0125, kPatchOuter = 0.015;        // m
inline constexpr double kSweepDegrees = 200, kPatchDegrees = 100.0 / 12;  // sweep of half the patch

// Even cells: 24 × 4 × 2 is the reference's S, 48 × 8 × 4 its M, 72 × 12 × 4 its L.
GridTicks MeniscusTicks(const Cells& cells);

// Cells that are small where a probe presses and long elsewhere, the same on both sides of the
// middle. `degrees` from the middle, 0 to 100; `radius` from 10 to 20 mm; `height` 0 to 1. For a
// patch, 100 / 12 degrees, 12.5 and 15 mm are among them.
GridTicks MeniscusTicks(const std::vector<double>& degrees, const std::vector<double>& radius_mm,
                        const std::vector<double>& height);

// One cell under the patch along the sweep and `beyond` on each side of it, shorter towards the
// horns, where the crescent bends most; three cells across it, or four; one over the height. For
// loads that bend the whole body: 6 (2 beyond + 1) × 3 or 4 elements.
GridTicks BentMeniscusTicks(int beyond, int across);

// Cells of 0.3 to 0.5 mm along the patch's rim, where the pressure under a flat tool is largest,
// and of the far body hardly any: for a meniscus that rests on the plateau and is pressed locally.
// 162 cells, 972 elements; where the ticks lie was searched for the least error of meniscus_indent.
GridTicks PressedMeniscusTicks();

}  // namespace arthro::test
