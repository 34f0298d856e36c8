#pragma once
// A small scene with a lattice, and the editor's workspace about it, without a window.

#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "app/editor/tools/tool_actions.h"
#include "app/editor/workspace.h"
#include "core/fields/volume.h"
#include "core/scene/edits.h"

namespace voledit::test {

/// 9×9×9 samples, ten units apart from −40 to 40 on each axis, with values −1000 … 3000 along x.
inline std::shared_ptr<const Volume> smallVolume() {
    VolumeGrid grid;
    grid.size = {9, 9, 9};
    grid.worldFromIndex = Mat4(10.0);
    grid.worldFromIndex[3] = Vec4(-40, -40, -40, 1);
    std::vector<std::int16_t> values;
    for (int n = 0; n < 729; ++n) values.push_back(std::int16_t(-1000 + 500 * (n % 9)));
    return Volume::fromValues(grid, std::move(values));
}

/// The scene of `smallVolume` ("small") with a lattice "lattice" about it, where asked.
inline Scene smallScene(bool withLattice) {
    Scene scene = sceneOfVolume("small.nrrd", "small", "");
    if (withLattice) addLattice(scene, "lattice", FfdTransfer{}, frameOf(Box3{Vec3(-40), Vec3(40)}));
    return scene;
}

/// A workspace that looks at `scene` from the front, a little from above and beside.
inline void openIn(Workspace& workspace, const Scene& scene) {
    workspace.open = true;
    workspace.document = Document(scene);
    workspace.assets.volumes = {{"small", smallVolume()}};
    workspace.camera = {{70, -380, 120}, {0, 0, 0}, {0, 0, 1}, 30};
    workspace.viewSize = {800, 600};
    workspace.compiled = compile(scene, workspace.assets, 0, nullptr);
}

/// As the editor does once a frame.
inline void recompile(Workspace& workspace) {
    workspace.compiled = compile(workspace.document.scene(), workspace.assets, 0, &workspace.compiled);
}

inline Vec3 pointOf(const Workspace& workspace, const Index3& at) {
    return shownControlPoint(workspace, "lattice", at).value();
}

/// Pixel of a control point of "lattice".
inline Vec2 pixelOf(const Workspace& workspace, const Index3& at) {
    return Vec2(project(workspace.camera, workspace.viewSize, pointOf(workspace, at)));
}

/// Index of a control point of a 4×4×4 lattice.
inline std::size_t indexOf(const Index3& at) {
    return std::size_t(at.x + 4 * (at.y + 4 * at.z));
}

/// Feeds tools as the editor does, compiling after each event.
struct Hand {
    Workspace& workspace;
    ViewportTools& tools;
    Modifiers with{};

    void send(PointerPhase phase, const Vec2& at, PointerButton button = PointerButton::None, double wheel = 0) {
        tools.pointer(toolContext(workspace), {phase, at, button, with, wheel});
        recompile(workspace);
    }
    void move(const Vec2& at) { send(PointerPhase::Move, at); }
    void down(const Vec2& at, PointerButton button = PointerButton::Left) { send(PointerPhase::Down, at, button); }
    void up(const Vec2& at, PointerButton button = PointerButton::Left) { send(PointerPhase::Up, at, button); }
    void click(const Vec2& at) {
        move(at);
        down(at);
        up(at);
    }
    void dragTo(const Vec2& from, const Vec2& to, PointerButton button = PointerButton::Left) {
        move(from);
        down(from, button);
        for (int step = 1; step <= 4; ++step) move(from + (to - from) * (step / 4.0));
    }
    void drag(const Vec2& from, const Vec2& to, PointerButton button = PointerButton::Left) {
        dragTo(from, to, button);
        up(to, button);
    }
    bool key(const std::string& name) {
        const bool taken = tools.key(toolContext(workspace), {name, with});
        recompile(workspace);
        return taken;
    }
};

}  // namespace voledit::test
