#include "app/editor/panels/render_panel.h"

#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "app/editor/timeline/key_row.h"
#include "app/editor/widgets.h"
#include "core/scene/edits.h"
#include "core/scene/scene_at.h"

namespace voledit {

namespace {

/// A number of the settings, by its names on the screen and in the file.
struct Number {
    const char* label;
    const char* member;
    double RenderSettings::*value;
    Tracked<double> TrackedRender::*keyed;
    const char* help;
};

constexpr Number kStep{"Step", "step", &RenderSettings::step, &TrackedRender::step,
                       "Of the smallest spacing: smaller is finer and slower"};
constexpr Number kShadows{"Shadows", "shadows", &RenderSettings::shadows, &TrackedRender::shadows,
                          "How much of the first light what is in front takes. 0: no shadows are computed."};
constexpr Number kOcclusion{"Occlusion", "occlusion", &RenderSettings::occlusion, &TrackedRender::occlusion,
                            "How much of the ambient light creases and hollows lose. 0: none is computed."};
constexpr Number kRadius{"Occlusion radius", "occlusionRadius", &RenderSettings::occlusionRadius,
                         &TrackedRender::occlusionRadius,
                         "How far surroundings count, as a part of the object's diagonal"};
constexpr Number kAmbient{"Ambient", "ambient", &RenderSettings::ambient, &TrackedRender::ambient,
                          "Light from everywhere"};
constexpr Number kDiffuse{"Diffuse", "diffuse", &RenderSettings::diffuse, &TrackedRender::diffuse,
                          "Light on matt surfaces"};
constexpr Number kSpecular{"Specular", "specular", &RenderSettings::specular, &TrackedRender::specular, "Highlights"};
constexpr Number kShininess{"Shininess", "shininess", &RenderSettings::shininess, &TrackedRender::shininess,
                            "Sharpness of the highlights"};
constexpr Number kExposure{"Exposure", "exposure", &RenderSettings::exposure, &TrackedRender::exposure,
                           "Brightens or darkens the picture: one stop is twice the light"};

/// The settings as they are at the time shown; the rows change them, and what was changed goes back as one step.
struct Rows {
    Workspace& workspace;
    TrackedRender tracked = workspace.document.scene().render;
    RenderSettings now = sceneAt(workspace.document.scene(), workspace.time).render;

    void apply(const Edit& edit, const std::string& step) const {
        applyEdit(workspace.document, edit, step,
                  [&](Scene& scene) { setRenderSettings(scene, now, workspace.when()); });
    }
    void number(const Number& row, const NumberFormat& format) {
        const KeyRow keys(workspace, std::string("/render/") + row.member, row.label,
                          keyStateOf(tracked.*row.keyed, workspace.time));
        apply(ui::slider(row.label, now.*row.value, format, row.help), stepOf(row.label));
    }
    void background() {
        const KeyRow keys(workspace, "/render/background", "Background",
                          keyStateOf(tracked.background, workspace.time));
        apply(ui::color("Background", now.background, "Behind everything"), "Change background");
    }
    void toggle(const char* label, bool RenderSettings::*value, const char* help) {
        apply(ui::checkbox(label, now.*value, help), stepOf(label));
    }
    static std::string stepOf(std::string label) {
        label[0] = char(label[0] - 'A' + 'a');
        return "Change " + label;
    }
};

constexpr NumberFormat kShare{0, 1, 0, 2};

void drawRenderer(Workspace& workspace) {
    static const std::vector<std::string> names{"Auto", "Slices", "Rays"};
    int index = int(workspace.renderer);
    if (ui::choice("Renderer", index, names,
                   "Slices: OpenGL. Rays: on the processor. Auto: the faster of both for this scene on this machine.")
            .changed)
        workspace.renderer = RendererChoice(index);
    ui::number("Frame budget", workspace.frameBudgetMs, {kLeastFrameBudget, kMostFrameBudget, 0.2, 0, " ms"},
               "What a frame may take while something moves: resolution and step follow it. Not part of the scene.");
}

void drawFixedLight(Rows& rows) {
    const auto& keyed = rows.tracked.light;
    const KeyRow keys(rows.workspace, keyed ? "/render/light" : "", "Direction",
                      keyed ? keyStateOf(*keyed, rows.workspace.time) : KeyState::None);
    const Edit turned =
        ui::vector("Direction", *rows.now.light, {-10, 10, 0.01, 2}, "From the surface towards the light");
    if (glm::length(*rows.now.light) > 1e-6) rows.apply(turned, "Change light");
}

void drawLight(Rows& rows) {
    static const std::vector<std::string> lights{"Headlight", "Key, fill, rim", "Soft", "Dramatic", "Fixed direction"};
    const int fixed = int(lights.size()) - 1;
    int light = rows.now.light ? fixed : int(rows.now.rig);
    const Edit chosen = ui::combo("Light", light, lights,
                                  "Headlight: from the eye. Key, fill, rim; Soft; Dramatic: lights that move with the "
                                  "view. Fixed direction: one light that stays where it is.");
    if (chosen.changed) {
        rows.now.light = light == fixed ? std::optional<Vec3>(Vec3(-1, -2, 2)) : std::nullopt;
        if (light != fixed) rows.now.rig = LightRig(light);
    }
    rows.apply(chosen, "Change light");
    if (rows.now.light) drawFixedLight(rows);
    rows.number(kShadows, kShare);
    rows.number(kOcclusion, kShare);
    if (rows.now.occlusion > 0) rows.number(kRadius, {0.005, 0.5, 0, 3, "", true});
}

void drawSurfaces(Rows& rows) {
    rows.number(kAmbient, kShare);
    rows.number(kDiffuse, kShare);
    rows.number(kSpecular, kShare);
    rows.number(kShininess, {1, 200, 0, 0, "", true});
}

void drawTones(Rows& rows) {
    static const std::vector<std::string> mappings{"None", "Filmic"};
    int mapping = int(rows.now.toneMapping);
    const Edit chosen = ui::choice("Tone mapping", mapping, mappings,
                                   "None: colours as they are composited. Filmic: a curve that keeps highlights.");
    if (chosen.changed) rows.now.toneMapping = ToneMapping(mapping);
    rows.apply(chosen, "Change tone mapping");
    rows.number(kExposure, {-4, 4, 0, 2, " stops"});
    rows.background();
    rows.toggle("Transparent", &RenderSettings::transparent,
                "Saved pictures keep their transparency; the background is left out of them");
}

}  // namespace

void drawRenderPanel(Workspace& workspace) {
    drawRenderer(workspace);
    Rows rows{workspace};
    rows.number(kStep, {0.1, 4, 0, 2, "", true});
    rows.toggle("Shading", &RenderSettings::shading, "Light surfaces by the gradient of the data");
    if (rows.now.shading) {
        ui::heading("Light");
        drawLight(rows);
        ui::heading("Surfaces");
        drawSurfaces(rows);
    }
    ui::heading("Picture");
    drawTones(rows);
}

}  // namespace voledit
