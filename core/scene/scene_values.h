#pragma once
// Values of a scene that are made of several tracked ones: boxes, frames, placements, camera, light.

#include <array>
#include <memory>
#include <optional>
#include <variant>

#include "core/base/box3.h"
#include "core/scene/camera.h"
#include "core/scene/tracked.h"

namespace voledit {

/// A box { min, max }, world units.
struct TrackedBox {
    Tracked<Vec3> min{Vec3(-1)}, max{Vec3(1)};

    TrackedBox() = default;
    TrackedBox(const Box3& box) : min(box.min), max(box.max) {}  // NOLINT: implicit, as values are
    bool operator==(const TrackedBox&) const = default;
    operator Box3() const { return {min, max}; }  // NOLINT: reads as a box
};

/// A frame as a file has it. Reads as a Frame; one without tracks is that and nothing else, whichever way it was
/// written.
class TrackedFrame {
public:
    struct Oblique {
        Tracked<Vec3> corner;
        std::array<Tracked<Vec3>, 3> edge;
        bool operator==(const Oblique&) const = default;
    };
    using Form = std::variant<TrackedBox, Oblique>;

    TrackedFrame(const Frame& frame = {}) : value_(frame) {}  // NOLINT: implicit, as values are
    explicit TrackedFrame(const Form& form);

    /// Without tracks; with them, of their first keys.
    const Frame& operator*() const { return value_; }
    operator const Frame&() const { return value_; }  // NOLINT: reads as a frame

    bool animated() const { return form_ != nullptr; }
    /// The form that has tracks; null where none has.
    const Form* form() const { return form_.get(); }
    Frame at(double t) const;

    bool operator==(const TrackedFrame& other) const;
    bool operator==(const Frame& other) const { return !form_ && value_ == other; }

private:
    Frame value_;
    std::shared_ptr<const Form> form_;  // null without tracks
};

/// How `frame` is written: as it was, or, without tracks, as a box where that gives the very same frame back.
TrackedFrame::Form formOf(const TrackedFrame& frame);

/// `translate`, `rotate` [degrees], `scale`, or a matrix (q to p) in their stead.
struct Placement {
    Tracked<Vec3> translate{Vec3(0)};
    Tracked<Vec3> rotate{Vec3(0)};  // degrees about x, y, z
    Tracked<Vec3> scale{Vec3(1)};
    std::optional<Tracked<Mat4>> matrix;

    bool operator==(const Placement&) const = default;
};
/// p from q, for either form. (Tracks: their first keys.)
Mat4 worldFromRest(const Placement& placement);

/// The scene's camera. Reads as a Camera.
struct TrackedCamera {
    Tracked<Vec3> eye, target, up;
    Tracked<double> fovY;  // degrees, vertical

    TrackedCamera(const Camera& camera = {})  // NOLINT: implicit, as values are
        : eye(camera.eye), target(camera.target), up(camera.up), fovY(camera.fovY) {}
    bool operator==(const TrackedCamera&) const = default;
    bool operator==(const Camera& other) const { return *this == TrackedCamera(other); }
    operator Camera() const { return {eye, target, up, fovY}; }  // NOLINT: reads as a camera
};

/// The scene's render settings. Reads as RenderSettings, which say what the members mean.
struct TrackedRender {
    Tracked<Vec3> background;
    Tracked<double> step;
    bool shading;
    Tracked<double> ambient, diffuse, specular, shininess;
    std::optional<Tracked<Vec3>> light;
    LightRig rig;
    Tracked<double> shadows, occlusion, occlusionRadius;
    ToneMapping toneMapping;
    Tracked<double> exposure;
    bool transparent;

    TrackedRender(const RenderSettings& settings = {});  // NOLINT: implicit, as values are
    bool operator==(const TrackedRender&) const = default;
    bool operator==(const RenderSettings& other) const { return *this == TrackedRender(other); }
    operator RenderSettings() const;  // NOLINT: reads as settings
};

}  // namespace voledit
