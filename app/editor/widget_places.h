#pragma once
// Where widgets are on the screen, by name: what "@widget("Panel/Label")" of recorded events finds.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// Rectangle of a widget in window pixels from the upper left.
struct WidgetPlace {
    Vec2 min{0}, max{0};
    bool visible = true;  // false where it is scrolled out of its window's view
    bool front = false;   // in a menu or dialog: goes before a panel's widget of the same name
    Vec2 center() const { return 0.5 * (min + max); }
};

/// The widgets of the last complete frame, by "Panel/Label". One belongs to each ImGui context (io.UserData).
class WidgetPlaces {
public:
    /// Ends a frame: what was noted since the last call can be found from now on.
    void newFrame();
    void note(const std::string& path, const WidgetPlace& place);
    std::optional<WidgetPlace> find(const std::string& path) const;
    /// All names, for error messages.
    std::vector<std::string> names() const;

    /// Has the widget of that name, where it is scrolled out of sight, brought into view in the frame after the next.
    void reveal(const std::string& path) { wanted_ = path; }
    /// True once for the widget that `reveal` named.
    bool takeWanted(const std::string& path);

    std::vector<std::string> scopes;  // names that the next `noteWidget` puts before its label

private:
    std::map<std::string, WidgetPlace> noted_, shown_;
    std::string wanted_;
};

/// The current ImGui context's; null where it has none (unit tests of single widgets).
WidgetPlaces* widgetPlaces();

/// Names the panel of the widgets noted while it lives: "Lattice" gives "Lattice/Amount". Scopes within scopes join by
/// "/".
class WidgetScope {
public:
    explicit WidgetScope(std::string_view name);
    ~WidgetScope();
    WidgetScope(const WidgetScope&) = delete;
    WidgetScope& operator=(const WidgetScope&) = delete;
};

/// Notes the ImGui item drawn last as "Panel/label". Call it after every widget a user may want to reach; what stands
/// after "##" in a label is left out. Icons before the label may be left out by passing only the words.
void noteWidget(std::string_view label);
/// The same for a rectangle that is no ImGui item (a tab, a handle in a plot), screen pixels.
void noteWidget(std::string_view label, const Vec2& min, const Vec2& max);

}  // namespace voledit
