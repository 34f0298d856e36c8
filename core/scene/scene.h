#pragma once
// The editable scene: a value. Copy it, compare it, save it, undo it.

#include <map>
#include <optional>
#include <string>

#include "core/scene/scene_objects.h"

namespace voledit {

enum class AssetKind : std::uint8_t { Volume, Motion, Images };

struct Asset {
    AssetKind kind = AssetKind::Volume;
    std::string path;  // as written in the file: relative to the scene file, or absolute when it lies outside
    bool operator==(const Asset&) const = default;
};

struct Timeline {
    double fps = 24;
    int start = 0;
    int end = 48;  // exclusive
    bool operator==(const Timeline&) const = default;
};

struct Scene {
    std::map<std::string, Asset> assets;
    std::map<std::string, ObjectRef> objects;
    std::map<std::string, TransferRef> transfers;
    std::map<std::string, DisplacementRef> displacements;
    ObjectRef root;
    std::optional<Tracked<double>> opacityDistance;  // world units
    std::optional<TrackedCamera> camera;             // nullopt: fits the root
    TrackedRender render;
    Timeline timeline;

    bool operator==(const Scene&) const = default;
};

}  // namespace voledit
