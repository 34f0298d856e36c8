#include "app/editor/panels/render_panel.h"

#include <glm/geometric.hpp>

#include "app/editor/timeline/key_row.h"
#include "app/editor/widgets.h"
#include "core/scene/edits.h"
#include "core/scene/scene_at.h"

namespace voledit {

namespace {

void drawRenderer(Workspace& workspace) {
    static const std::vector<std::string> names{"Auto", "Slices", "Rays"};
    int index = int(workspace.renderer);
    if (ui::choice("Renderer", index, names,
                   "Slices: OpenGL, fast. Rays: on the processor, the reference. Auto: what suits the machine.")
            .changed)
        workspace.renderer = RendererChoice(index);
}

RenderSettings settingsOf(const Workspace& workspace) {
    return sceneAt(workspace.document.scene(), workspace.time).render;
}

void drawShading(Workspace& workspace) {
    RenderSettings render = settingsOf(workspace);
    const auto apply = [&](const Edit& edit, const char* name) {
        applyEdit(workspace.document, edit, name,
                  [&](Scene& scene) { setRenderSettings(scene, render, workspace.when()); });
    };
    apply(ui::checkbox("Shading", render.shading, "Light surfaces by the gradient of the data"), "Change shading");
    if (!render.shading) return;
    const auto number = [&](const char* label, const char* member, double& value, const Tracked<double>& tracked,
                            const NumberFormat& format, const char* help, const char* step) {
        const KeyRow keys(workspace, std::string("/render/") + member, label, keyStateOf(tracked, workspace.time));
        apply(ui::slider(label, value, format, help), step);
    };
    const TrackedRender tracked = workspace.document.scene().render;
    const NumberFormat share{0, 1, 0, 2}, exponent{1, 200, 0, 0, "", true};
    number("Ambient", "ambient", render.ambient, tracked.ambient, share, "Light from everywhere",
           "Change ambient light");
    number("Diffuse", "diffuse", render.diffuse, tracked.diffuse, share, "Light on matt surfaces",
           "Change diffuse light");
    number("Specular", "specular", render.specular, tracked.specular, share, "Highlights", "Change specular light");
    number("Shininess", "shininess", render.shininess, tracked.shininess, exponent, "Sharpness of the highlights",
           "Change shininess");

    static const std::vector<std::string> lights{"Headlight", "Fixed"};
    int light = render.light ? 1 : 0;
    const Edit chosen = ui::choice("Light", light, lights, "Shines from the eye, or from a fixed direction");
    if (chosen.changed) render.light = light == 1 ? std::optional<Vec3>(Vec3(-1, -2, 2)) : std::nullopt;
    apply(chosen, "Change light");
    if (!render.light) return;
    NumberFormat direction{-10, 10, 0.01, 2};
    const KeyRow keys(workspace, tracked.light ? "/render/light" : "", "Direction",
                      tracked.light ? keyStateOf(*tracked.light, workspace.time) : KeyState::None);
    const Edit turned = ui::vector("Direction", *render.light, direction, "From the surface towards the light");
    if (glm::length(*render.light) > 1e-6) apply(turned, "Change light");
}

}  // namespace

void drawRenderPanel(Workspace& workspace) {
    Document& document = workspace.document;
    drawRenderer(workspace);
    RenderSettings render = settingsOf(workspace);
    NumberFormat steps{0.1, 4, 0, 2, "", true};
    {
        const KeyRow keys(workspace, "/render/step", "Step", keyStateOf(document.scene().render.step, workspace.time));
        const Edit edit =
            ui::slider("Step", render.step, steps, "Of the smallest spacing: smaller is finer and slower");
        applyEdit(document, edit, "Change step",
                  [&](Scene& scene) { setRenderSettings(scene, render, workspace.when()); });
    }
    render = settingsOf(workspace);
    {
        const KeyRow keys(workspace, "/render/background", "Background",
                          keyStateOf(document.scene().render.background, workspace.time));
        const Edit edit = ui::color("Background", render.background, "Behind everything");
        applyEdit(document, edit, "Change background",
                  [&](Scene& scene) { setRenderSettings(scene, render, workspace.when()); });
    }
    drawShading(workspace);
}

}  // namespace voledit
