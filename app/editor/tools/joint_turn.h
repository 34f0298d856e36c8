#pragma once
// One turn of joints: from a pointer that goes round a pivot, an axis lock, typed degrees to an angle.

#include <optional>
#include <string>
#include <string_view>

#include "core/base/types.h"

namespace voledit {

/// Follows the pointer about a pivot on the screen. A value; knows nothing of what is turned. Pixels count from the
/// upper left.
class JointTurn {
public:
    /// @param pivot    pixel that is turned about
    /// @param pointer  where the turn begins
    /// @param axes     the joint's own axes in the camera's: columns; x right, y up, z towards the eye; unit
    /// @param lock     0, 1, 2: begins locked to that axis, as from its ring
    JointTurn(const Vec2& pivot, const Vec2& pointer, const Mat3& axes, std::optional<int> lock);

    /// The pointer is at `to` now; `slow` counts a tenth of the way, `steps` rounds to five degrees (with `slow` one).
    void follow(const Vec2& to, bool slow, bool steps);
    /// "X", "Y", "Z" lock to the joint's own axis, or back to the view's when it was locked already; digits, ".", "-",
    /// "Backspace" edit typed degrees. False for any other key.
    bool key(std::string_view key);

    /// Degrees, counterclockwise as seen against the axis: the view's towards the eye, or the locked one.
    double degrees() const;
    /// 0, 1, 2 where locked.
    std::optional<int> axis() const { return axis_; }
    /// "Rotate X 12.5°".
    std::string readout() const;
    const Vec2& pivot() const { return pivot_; }

private:
    Vec2 pivot_;
    Mat3 axes_;
    std::optional<int> axis_;
    Vec2 last_;         // the true pointer
    double swept_ = 0;  // degrees about the pivot, counterclockwise as seen
    Vec2 path_{0};      // pixels from the start, slowed down where asked
    double reach_ = 1;  // pixels from the pivot to the start
    bool slow_ = false, steps_ = false;
    std::string typed_;
};

}  // namespace voledit
