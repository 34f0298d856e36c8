#pragma once
// Pieces of a scene as JSON, members in the order of scene-format.md. For scene_to_json*.cpp alone.

#include <nlohmann/json.hpp>

#include "core/scene/scene.h"

namespace voledit {

// ---- scene_to_json_values.cpp
nlohmann::ordered_json toJson(const Vec3& v);
nlohmann::ordered_json toJson(const Index3& v);
nlohmann::ordered_json toJson(const Tracked<double>& value);
nlohmann::ordered_json toJson(const Tracked<Vec2>& value);
nlohmann::ordered_json toJson(const Tracked<Vec3>& value);
nlohmann::ordered_json toJson(const Tracked<Rotation>& value);
nlohmann::ordered_json toJson(const Tracked<Mat4>& value);
/// A number where it is one.
nlohmann::ordered_json toJson(const Tracked<std::vector<double>>& value);
nlohmann::ordered_json toJson(const Tracked<std::vector<Vec3>>& value);
nlohmann::ordered_json toJson(const Tracked<PiecewiseLinear>& table);
nlohmann::ordered_json toJson(const Tracked<ColorTable>& table);
nlohmann::ordered_json toJson(const TrackedBox& box);
/// As a box where that gives the very same frame back.
nlohmann::ordered_json toJson(const TrackedFrame& frame);
nlohmann::ordered_json toJson(const Appearance& appearance);
/// Adds the members of `placement` that are not at their defaults.
void add(nlohmann::ordered_json& object, const Placement& placement);

// ---- scene_to_json_transfers.cpp
nlohmann::ordered_json toJson(const Field& field);
nlohmann::ordered_json toJson(const Transfer& transfer);
nlohmann::ordered_json toJson(const Displacement& displacement);

// ---- scene_to_json_actors.cpp
nlohmann::ordered_json toJson(const SceneSkeleton& skeleton);
/// Adds `skeleton` and the other members of the rig that are not at their defaults.
void add(nlohmann::ordered_json& object, const ActorRig& rig);

// ---- scene_to_json.cpp
nlohmann::ordered_json toJson(const Object& object);

/// A list of shared nodes.
template <class Node>
nlohmann::ordered_json listToJson(const std::vector<SharedValue<Node>>& nodes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& node : nodes) list.push_back(toJson(*node));
    return list;
}

}  // namespace voledit
