#include "tests/render/render_fixtures.h"

#include <glad/gl.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "core/eval/ray_caster.h"

namespace voledit::test {

namespace {

void GLAD_API_PTR onMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text,
                            const void*) {
    // What compilers say is thrown and tested as an Error.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    if (type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH) ADD_FAILURE() << "OpenGL: " << text;
}

void watch() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, nullptr);
}

std::shared_ptr<const LatticeMap> lattice(const Box3& bounds, Index3 cells,
                                          const std::function<void(Lattice&, const Vec3&)>& bend) {
    Lattice made;
    made.frame = frameOf(bounds);
    made.control = restControlPoints(made.basis, made.points, made.frame);
    bend(made, bounds.size());
    return std::make_shared<LatticeMap>(made, cells, Outside::Hide);
}

}  // namespace

GlContext& offscreen() {
    // Never destroyed: the last test's GL objects may outlive it otherwise.
    static GlContext* context = [] {
        GlContext* made = createOffscreenContext(GlBackend::Auto).release();
        watch();
        return made;
    }();
    return *context;
}

void withContext(GlBackend backend, const std::function<void()>& body) {
    offscreen();
    std::thread([&] {
        const auto context = createOffscreenContext(backend);
        watch();
        body();
    }).join();
    offscreen().makeCurrent();
}

std::shared_ptr<const Volume> sampled(Index3 size, const std::function<double(const Vec3&)>& f) {
    VolumeGrid grid;
    grid.size = size;
    for (int a = 0; a < 3; ++a) {
        grid.worldFromIndex[a][a] = 2.0 / (size[a] - 1);
        grid.worldFromIndex[3][a] = -1;
    }
    std::vector<float> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                values.push_back(float(f(transformPoint(grid.worldFromIndex, Vec3(i, j, k)))));
    return Volume::fromValues(grid, std::move(values));
}

std::shared_ptr<const Volume> ballVolume(int size) {
    return sampled(Index3(size), [](const Vec3& p) {
        const double t = std::clamp((0.8 - glm::length(p)) / 0.3, 0.0, 1.0);
        return 1000 * t * t * (3 - 2 * t);
    });
}

std::shared_ptr<const Volume> wavesVolume(int size) {
    return sampled(Index3(size), [](const Vec3& p) {
        return 500 + 500 * std::sin(5 * p.x + 1) * std::sin(4 * p.y + 2) * std::sin(6 * p.z);
    });
}

TransferFunction softAppearance() {
    TransferFunction f;
    f.color.points = {{200, {0.2, 0.3, 0.9}}, {600, {0.9, 0.3, 0.2}}, {1000, {1, 0.95, 0.8}}};
    f.opacity.points = {{200, 0}, {900, 0.5}};
    return f;
}

TransferFunction constantAppearance(double opacity, const Vec3& color) {
    TransferFunction f;
    f.color.points = {{0, color}};
    f.opacity.points = {{0, opacity}};
    return f;
}

std::shared_ptr<const LatticeMap> bentLattice(const Box3& bounds, Index3 cells) {
    return lattice(bounds, cells, [](Lattice& l, const Vec3& size) {
        l.control[l.indexOf({3, 3, 3})] += Vec3(0.2, 0, 0.2) * size;
        l.control[l.indexOf({0, 3, 0})] -= Vec3(0.2, 0, 0) * size;
        l.control[l.indexOf({1, 0, 2})] -= Vec3(0, 0.2, 0) * size;
        l.control[l.indexOf({2, 1, 3})] += Vec3(0, 0, 0.2) * size;
    });
}

std::shared_ptr<const LatticeMap> restLattice(const Box3& bounds, Index3 cells) {
    return lattice(bounds, cells, [](Lattice&, const Vec3&) {});
}

std::shared_ptr<const LatticeMap> foldedLattice(const Box3& bounds) {
    return lattice(bounds, Index3(8), [](Lattice& l, const Vec3& size) {
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 4; ++j) {
                l.control[l.indexOf({1, j, k})].x += size.x;
                l.control[l.indexOf({2, j, k})].x -= size.x;
            }
    });
}

CompiledScene sceneOf(TermPtr root, double unit, bool shading) {
    CompiledScene scene;
    scene.camera = fittingCamera(root->bounds, 4.0 / 3.0);
    const double distance = glm::length(scene.camera.eye - scene.camera.target);
    scene.camera.eye = scene.camera.target + distance * glm::normalize(Vec3(0.5, -0.8, 0.45));
    scene.root = std::move(root);
    scene.render.shading = shading;
    scene.opacityDistance = scene.unitStep = unit;
    return scene;
}

Picture slicesOf(const CompiledScene& scene, Index2 size, const SliceOptions& options, double stepScale) {
    offscreen();
    SliceRenderer renderer(options);
    renderer.begin(scene, size, stepScale);
    renderer.advance(0);
    return renderer.readBack();
}

Picture raysOf(const CompiledScene& scene, Index2 size, double finer) {
    CompiledScene fine = scene;
    fine.render.step /= finer;
    return castRays(fine, size);
}

}  // namespace voledit::test
