#pragma once
// From checked JSON to a scene value. For scene_json.cpp and scene_reader*.cpp alone.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/json_text.h"
#include "core/scene/scene.h"

namespace voledit {

/// A JSON value and where it stands. Must not outlive the value or the place around it.
struct JsonView {
    const nlohmann::json& value;
    JsonPlace place;

    /// Whether an object has this member.
    bool has(const char* member) const { return value.contains(member); }
    JsonView operator[](const char* member) const { return {value[member], place.at(member)}; }
    JsonView operator[](std::size_t element) const { return {value[element], place.at(element)}; }
    JsonView operator[](int element) const { return (*this)[std::size_t(element)]; }
};

/// Reads JSON that the schema has found right. Throws Error, naming file and JSON pointer, for the rules that a schema
/// cannot say and for what the contract has but this version has not.
class SceneReader {
public:
    /// `file` names the scene in errors; checkAssetPath(path) returns what is wrong with an asset's path, or "".
    SceneReader(std::string file, std::function<std::string(const std::string&)> checkAssetPath)
        : file_(std::move(file)), checkAssetPath_(std::move(checkAssetPath)) {}

    Scene read(const nlohmann::json& scene);

private:
    struct Reference {
        std::string name, pointer;
    };

    [[noreturn]] void fail(const JsonPlace& place, const std::string& what, const std::string& remedy) const;
    [[noreturn]] void notBuilt(const JsonPlace& place, const std::string& what, const std::string& remedy) const;

    // scene_reader_values.cpp
    double number(const JsonView& view) const;
    Vec3 vector(const JsonView& view) const;
    Vec3 direction(const JsonView& view) const;
    Vec3 numberOrThree(const JsonView& view) const;
    Index3 indices(const JsonView& view) const;
    Frame frame(const JsonView& view) const;
    Placement placement(const JsonView& view) const;
    PiecewiseLinear piecewiseLinear(const JsonView& view) const;
    ColorTable colorTable(const JsonView& view) const;
    Appearance appearance(const JsonView& view) const;
    Camera camera(const JsonView& view) const;
    RenderSettings renderSettings(const JsonView& view) const;
    Timeline timeline(const JsonView& view) const;

    // scene_reader.cpp
    Asset asset(const JsonView& view) const;
    Object object(const JsonView& view);
    VolumeObject volume(const JsonView& view);
    TransferObject transferObject(const JsonView& view);
    Transfer transfer(const JsonView& view);
    FfdTransfer lattice(const JsonView& view);
    void readControl(FfdTransfer& ffd, const JsonView& view) const;
    void readMoves(FfdTransfer& ffd, const JsonView& view) const;
    void checkReferences(const Scene& scene) const;

    std::string file_;
    std::function<std::string(const std::string&)> checkAssetPath_;
    std::vector<Reference> objectUses_, transferUses_, assetUses_;
    double cells_ = 0, controlPoints_ = 0;  // of all lattices so far
};

/// Throws Error (with `file` and a JSON pointer) where `use` goes round in a circle or objects and transfers nest
/// deeper than kDeepestNesting. Every name that is used must exist.
void checkGraph(const Scene& scene, const std::string& file);

}  // namespace voledit
