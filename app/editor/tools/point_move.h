#pragma once
// One move of points: from the pointer, an axis lock and typed numbers to an offset in space.

#include <optional>
#include <string>
#include <string_view>

#include "core/scene/camera.h"

namespace voledit {

/// Moves an anchor with the pointer in the plane of the view through it, or along a world axis. A value; knows nothing
/// of what is moved. Pixels are positions from the picture's upper left, pixel centres at ½.
class PointMove {
public:
    /// @param anchor   the grabbed point, world units, in front of the eye
    /// @param pointer  its distance from the anchor's pixel is kept, so that nothing jumps
    PointMove(const Vec3& anchor, const Camera& camera, Index2 size, const Vec2& pointer);

    /// The pointer is at `to` now; `slow` counts a tenth of the way since the last call.
    void follow(const Vec2& to, bool slow);
    /// "X", "Y", "Z" lock to that world axis, or free it when it was locked already; digits, ".", "-", "Backspace" edit
    /// a typed distance. False for any other key.
    bool key(std::string_view key);

    /// What the anchor moves by, world units. Along a locked axis it is the point of the axis that is seen nearest to
    /// the pointer. A typed distance stands before the pointer (without a lock: along x).
    Vec3 offset() const;
    /// 0, 1, 2 where locked to x, y, z.
    std::optional<int> axis() const { return axis_; }
    const Vec3& anchor() const { return anchor_; }
    /// "X 12.5" or "3.2, 0.0, −7.1", to be read while moving; as many decimals as a pixel tells apart.
    std::string readout() const;

private:
    bool type(char c);
    Vec3 offsetInView(const Vec2& pixel) const;
    double distanceAlong(int axis, const Vec2& pixel) const;
    double unitsPerPixel() const;

    Vec3 anchor_;
    Camera camera_;
    Index2 size_;
    Vec2 grab_;     // the anchor's pixel − the pointer's at the start
    Vec2 virtual_;  // the pointer, slowed down where asked
    Vec2 last_;     // the true pointer
    std::optional<int> axis_;
    std::string typed_;
};

}  // namespace voledit
