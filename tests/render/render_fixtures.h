#pragma once
// Contexts, small analytic volumes and scenes that the render tests share.

#include <gtest/gtest.h>

#include <functional>

#include "core/scene/compile.h"
#include "core/stf/lattice.h"
#include "render/context.h"
#include "render/slice_renderer.h"

namespace voledit::test {

/// One context for the whole test program (EGL, else OSMesa), current; GL's errors fail the running test.
GlContext& offscreen();

/// Runs `body` with a context of `backend` current, in a thread of its own: two Mesa libraries must not follow each
/// other on one thread. The common context's functions are loaded again afterwards.
void withContext(GlBackend backend, const std::function<void()>& body);

/// `size` samples of f over the box from −1 to 1 (index to world is scaled and moved to it).
std::shared_ptr<const Volume> sampled(Index3 size, const std::function<double(const Vec3&)>& f);

/// A ball in the middle: 1000 inside radius 0.5, falling smoothly to 0 at 0.8.
std::shared_ptr<const Volume> ballVolume(int size);
/// Waves in all directions, 0 … 1000, with gradients everywhere.
std::shared_ptr<const Volume> wavesVolume(int size);

/// Soft: a wide ramp from 200 to 900; colour changes with the value.
TransferFunction softAppearance();
/// The same opacity for every value.
TransferFunction constantAppearance(double opacity, const Vec3& color);

/// A lattice over `bounds` with some points moved by a fifth of it.
std::shared_ptr<const LatticeMap> bentLattice(const Box3& bounds, Index3 cells = Index3(8));
/// A lattice whose control points are at rest.
std::shared_ptr<const LatticeMap> restLattice(const Box3& bounds, Index3 cells = Index3(8));
/// A lattice that folds space over itself along x.
std::shared_ptr<const LatticeMap> foldedLattice(const Box3& bounds);

/// A scene that looks at `root` from in front, to the right and above; step and opacity distance by `unit`.
CompiledScene sceneOf(TermPtr root, double unit, bool shading = true);

/// Slices with the common context.
Picture slicesOf(const CompiledScene& scene, Index2 size, const SliceOptions& options = {}, double stepScale = 1);
/// Rays with steps `finer` times as small.
Picture raysOf(const CompiledScene& scene, Index2 size, double finer = 8);

}  // namespace voledit::test
