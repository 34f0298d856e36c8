#include "core/scene/scene_values.h"

#include <glm/trigonometric.hpp>

#include "core/stf/affine.h"

namespace voledit {

namespace {

bool anyTracks(const TrackedBox& box) {
    return box.min.animated() || box.max.animated();
}
bool anyTracks(const TrackedFrame::Oblique& frame) {
    return frame.corner.animated() || frame.edge[0].animated() || frame.edge[1].animated() || frame.edge[2].animated();
}

Frame frameAt(const TrackedBox& box, double t) {
    return frameOf({box.min.at(t), box.max.at(t)});
}
Frame frameAt(const TrackedFrame::Oblique& frame, double t) {
    return {frame.corner.at(t), {frame.edge[0].at(t), frame.edge[1].at(t), frame.edge[2].at(t)}};
}

Frame frameAt(const TrackedFrame::Form& form, double t) {
    return std::visit([t](const auto& one) { return frameAt(one, t); }, form);
}

}  // namespace

TrackedFrame::TrackedFrame(const Form& form) : value_(frameAt(form, -kInfinity)) {
    if (std::visit([](const auto& one) { return anyTracks(one); }, form)) form_ = std::make_shared<const Form>(form);
}

Frame TrackedFrame::at(double t) const {
    return form_ ? frameAt(*form_, t) : value_;
}

bool TrackedFrame::operator==(const TrackedFrame& other) const {
    if (form_ == other.form_) return value_ == other.value_;
    return form_ && other.form_ && *form_ == *other.form_;
}

TrackedFrame::Form formOf(const TrackedFrame& tracked) {
    if (tracked.form()) return *tracked.form();
    const Frame& frame = tracked;
    const Vec3 size{frame.edge[0].x, frame.edge[1].y, frame.edge[2].z};
    const Box3 box{frame.corner, frame.corner + size};
    if (size.x > 0 && size.y > 0 && size.z > 0 && frameOf(box) == frame) return TrackedBox(box);
    return TrackedFrame::Oblique{frame.corner, {frame.edge[0], frame.edge[1], frame.edge[2]}};
}

Mat4 worldFromRest(const Placement& placement) {
    if (placement.matrix) return *placement.matrix;
    return placementMatrix(placement.translate, glm::radians(*placement.rotate), placement.scale);
}

TrackedRender::TrackedRender(const RenderSettings& settings)
    : background(settings.background),
      step(settings.step),
      shading(settings.shading),
      ambient(settings.ambient),
      diffuse(settings.diffuse),
      specular(settings.specular),
      shininess(settings.shininess),
      rig(settings.rig),
      shadows(settings.shadows),
      occlusion(settings.occlusion),
      occlusionRadius(settings.occlusionRadius),
      toneMapping(settings.toneMapping),
      exposure(settings.exposure),
      transparent(settings.transparent) {
    if (settings.light) light = *settings.light;
}

TrackedRender::operator RenderSettings() const {
    RenderSettings settings;
    settings.background = background;
    settings.step = step;
    settings.shading = shading;
    settings.ambient = ambient;
    settings.diffuse = diffuse;
    settings.specular = specular;
    settings.shininess = shininess;
    if (light) settings.light = **light;
    settings.rig = rig;
    settings.shadows = shadows;
    settings.occlusion = occlusion;
    settings.occlusionRadius = occlusionRadius;
    settings.toneMapping = toneMapping;
    settings.exposure = exposure;
    settings.transparent = transparent;
    return settings;
}

}  // namespace voledit
