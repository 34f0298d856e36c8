#pragma once
// Places on the screen as recorded events name them (scene-format.md §4).

#include <string>

#include "core/base/types.h"

namespace voledit {

/// A place on the screen as an event names it; found when its line runs.
struct Place {
    enum class Kind : unsigned char { Pixel, View, Point, Joint, Key, Widget, Here };
    Kind kind = Kind::Pixel;
    Vec2 at{0};        // Pixel: window pixels; View: fractions of the viewport
    std::string name;  // Point: lattice; Joint; Key: track; Widget: "Panel/Label"
    Index3 point{0};   // Point: i, j, k; Key: the number in x
    Vec2 offset{0};    // "+DX,DY", pixels; Here: from where the mouse is

    bool operator==(const Place&) const = default;
};

/// "X,Y", "@point(pull,3,3,3)+40,-20" … Throws Error.
Place parsePlace(const std::string& text);
/// Inverse of `parsePlace`.
std::string textOf(const Place& place);

}  // namespace voledit
