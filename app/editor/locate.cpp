#include "app/editor/locate.h"

#include <algorithm>
#include <cctype>
#include <glm/common.hpp>

#include "app/editor/timeline/dope_rows.h"
#include "app/editor/tools/actor_view.h"
#include "app/editor/tools/tool_actions.h"
#include "core/base/error.h"

namespace voledit {

namespace {

// Case, and the dots of "Open…", do not matter in a widget's name.
std::string plainName(std::string name) {
    if (name.ends_with("…")) name.erase(name.size() - std::string("…").size());
    while (name.ends_with('.')) name.pop_back();
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return name;
}

// Widgets of the same panel, or with the same label; else all panels.
std::string alternatives(const std::string& wanted, const std::vector<std::string>& names) {
    const auto panelOf = [](const std::string& name) { return plainName(name.substr(0, name.find('/'))); };
    const auto labelOf = [](const std::string& name) { return plainName(name.substr(name.rfind('/') + 1)); };
    std::string near, panels, lastPanel;
    for (const std::string& name : names) {
        if (panelOf(name) == panelOf(wanted) || labelOf(name) == labelOf(wanted)) near += "\n  " + name;
        if (panelOf(name) != lastPanel) panels += (panels.empty() ? "" : ", ") + name.substr(0, name.find('/'));
        lastPanel = panelOf(name);
    }
    if (!near.empty()) return "; there are:" + near;
    return "; there are widgets of " + panels;
}

Vec2 widgetAt(const std::string& wanted, const WidgetPlaces& widgets) {
    const std::optional<WidgetPlace> place = widgets.find(widgetNamed(wanted, widgets));
    if (!place)
        throw Error("there is no widget \"" + wanted + "\" on the screen" + alternatives(wanted, widgets.names()));
    if (!place->visible) throw Error("the widget \"" + wanted + "\" is scrolled out of sight");
    return place->center();
}

Vec2 pointAt(const Place& place, const Workspace& workspace) {
    const std::string name = "@point(" + place.name + "," + std::to_string(place.point.x) + "," +
                             std::to_string(place.point.y) + "," + std::to_string(place.point.z) + ")";
    const auto world = shownControlPoint(workspace, place.name, place.point);
    if (!world) throw Error(name + ": there is no such control point");
    const Vec3 pixel = project(workspace.camera, workspace.viewSize, *world);
    const Vec2 size(workspace.viewSize);
    if (!(pixel.z > 0 && pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y))
        throw Error(name + " is not on the screen; turn the view, or frame it first (do view.frame)");
    return Vec2(workspace.viewOrigin) + Vec2(pixel);
}

Vec2 shownJointAt(const Place& place, const Workspace& workspace) {
    const CompiledScene* compiled = workspace.compiled.root ? &workspace.compiled : nullptr;
    const JointRef joint = jointNamed(workspace.document.scene(), compiled, workspace.selection, place.name);
    const Vec3 pixel = project(workspace.camera, workspace.viewSize, shownJoint(*joint.actor, joint.joint));
    const Vec2 size(workspace.viewSize);
    if (!(pixel.z > 0 && pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y))
        throw Error(textOf(place) + " is not on the screen; turn the view, or frame it first (do view.frame)");
    return Vec2(workspace.viewOrigin) + Vec2(pixel);
}

Vec2 keyAt(const Place& place, const Workspace& workspace) {
    const std::string name = textOf({.kind = Place::Kind::Key, .name = place.name, .point = place.point});
    const Scene& scene = workspace.document.scene();
    const auto path = trackNamed(scene, place.name);
    if (!path) {
        std::string labels;
        for (const KeyableValue& value : animatedValues(scene))
            labels += "\n  " + value.label + "  (" + value.path + ")";
        throw Error(name + ": nothing of that name has keys" + (labels.empty() ? "" : "; there are:" + labels));
    }
    const auto count = int(keysOf(scene, *path).size());
    if (place.point.x >= count)
        throw Error(name + ": it has " + std::to_string(count) + (count == 1 ? " key" : " keys") + ", counted from 0");
    for (const ShownKey& key : workspace.timeline.shownKeys)
        if (key.path == *path && key.index == place.point.x && key.visible) return key.at;
    throw Error(name +
                " is not on the screen; show the timeline (do view.timeline on) and frame it (do "
                "timeline.frame-all)");
}

Vec2 placeAt(const Place& place, const Workspace& workspace, const WidgetPlaces& widgets) {
    switch (place.kind) {
        case Place::Kind::Pixel:
        case Place::Kind::Here:
            return place.at;
        case Place::Kind::View: {
            if (!(place.at.x >= 0 && place.at.x <= 1 && place.at.y >= 0 && place.at.y <= 1))
                throw Error(textOf(place) + " is not on the screen: fractions go from 0 to 1");
            const Vec2 size(workspace.viewSize);
            // The last pixel, where the fraction is 1.
            return Vec2(workspace.viewOrigin) + glm::min(place.at * size, size - 0.5);
        }
        case Place::Kind::Point:
            return pointAt(place, workspace);
        case Place::Kind::Widget:
            return widgetAt(place.name, widgets);
        case Place::Kind::Joint:
            return shownJointAt(place, workspace);
        case Place::Kind::Key:
            return keyAt(place, workspace);
    }
    return {};
}

}  // namespace

std::string widgetNamed(const std::string& wanted, const WidgetPlaces& widgets) {
    const std::vector<std::string> names = widgets.names();
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
    const auto like = std::find_if(names.begin(), names.end(),
                                   [&](const std::string& name) { return plainName(name) == plainName(wanted); });
    return like != names.end() ? *like : wanted;
}

Vec2 locatePlace(const Place& place, const Workspace& workspace, const WidgetPlaces& widgets, Index2 window) {
    const Vec2 at = placeAt(place, workspace, widgets) + place.offset;
    if (!(at.x >= 0 && at.y >= 0 && at.x < window.x && at.y < window.y))
        throw Error(textOf(place) + " is not on the screen, which is " + std::to_string(window.x) + " x " +
                    std::to_string(window.y) + " pixels");
    return at;
}

}  // namespace voledit
