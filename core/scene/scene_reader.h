#pragma once
// From checked JSON to a scene value. For scene_json.cpp and scene_reader*.cpp alone.

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/expression/formula.h"
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
    const std::string& text() const { return value.get_ref<const std::string&>(); }
};

/// Reads JSON that the schema has found right. Throws Error, naming file and JSON pointer, for the rules that a schema
/// cannot say and for what the contract has but this version has not; FormulaError for formulas.
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
    /// Numbers laid flat, and the tracks among them.
    struct Numbers {
        std::vector<double> values;
        std::vector<PartTrack> tracks;
    };
    /// Extents of lists within lists, the outer first; kAny: any. None: a single number.
    using Shape = std::span<const int>;
    static constexpr int kAny = -1;

    [[noreturn]] void fail(const JsonPlace& place, const std::string& what, const std::string& remedy) const;
    [[noreturn]] void notBuilt(const JsonPlace& place, const std::string& what, const std::string& remedy) const;
    [[noreturn]] void failUnknown(const JsonView& name, const std::string& what, const std::vector<std::string>& known,
                                  const std::string& otherwise) const;

    // scene_reader_tracks.cpp
    Track track(const JsonView& view, Shape shape) const;
    void collect(const JsonView& view, Shape shape, Numbers& numbers, bool whole) const;
    template <class T>
    Tracked<T> tracked(const JsonView& view, std::initializer_list<int> shape) const;
    Tracked<double> number(const JsonView& view) const;
    Tracked<Vec2> pair(const JsonView& view) const;
    Tracked<Vec3> vector(const JsonView& view) const;
    Tracked<Rotation> rotation(const JsonView& view) const;
    Tracked<Vec3> numberOrThree(const JsonView& view) const;
    Tracked<Mat4> matrix(const JsonView& view) const;
    Tracked<std::vector<Vec3>> vectors(const JsonView& view) const;
    Tracked<std::vector<double>> numbers(const JsonView& view) const;
    Tracked<PiecewiseLinear> piecewiseLinear(const JsonView& view) const;
    Tracked<ColorTable> colorTable(const JsonView& view) const;
    void checkAscending(const JsonView& table, const std::vector<double>& numbers, std::size_t columns) const;

    // scene_reader_values.cpp
    Tracked<Vec3> direction(const JsonView& view) const;
    Index3 indices(const JsonView& view) const;
    TrackedBox box(const JsonView& view, const char* what) const;
    TrackedFrame frame(const JsonView& view) const;
    Placement placement(const JsonView& view) const;
    Appearance appearance(const JsonView& view) const;
    TrackedCamera camera(const JsonView& view) const;
    TrackedRender renderSettings(const JsonView& view) const;
    Timeline timeline(const JsonView& view) const;

    // scene_reader_objects.cpp
    Object object(const JsonView& view);
    VolumeObject volume(const JsonView& view);
    SolidObject solid(const JsonView& view);
    FieldsObject fieldsObject(const JsonView& view);
    CvgObject cvgObject(const JsonView& view, CvgOperator by);
    TransferObject transferObject(const JsonView& view);
    RecolorObject recolor(const JsonView& view);

    // scene_reader_actors.cpp
    ActorObject actor(const JsonView& view);
    SkeletonTransfer skeletonTransfer(const JsonView& view);
    ActorRig rig(const JsonView& view);
    SceneSkeleton skeleton(const JsonView& view);
    Placement fit(const JsonView& view) const;
    SceneJoint joint(const JsonView& view) const;
    SceneLimb limb(const JsonView& view);
    void checkJoints(const JsonView& view, const std::vector<SceneJoint>& joints) const;
    void checkLimbs(const JsonView& view, const SceneSkeleton& skeleton) const;
    void checkJointNames(const JsonView& view, const ActorRig& rig) const;
    std::string motionAsset(const JsonView& name);

    // scene_reader_fields.cpp
    Field field(const JsonView& view);
    std::array<FieldRef, 3> fields(const JsonView& view);
    ComponentOf component(const JsonView& view);
    Displacement displacement(const JsonView& view);
    std::string volumeAsset(const JsonView& name);
    std::string formula(const JsonView& view, const char* variables) const;
    FormulaText formulaText(const JsonView& view) const;

    // scene_reader_transfers.cpp
    Transfer transfer(const JsonView& view);
    std::vector<TransferRef> transferList(const JsonView& view);
    LibraryTransfer libraryOrFile(const JsonView& view) const;
    LibraryTransfer::Argument argument(const JsonView& view) const;
    ExpressionTransfer expression(const JsonView& view) const;
    FieldsTransfer fieldsTransfer(const JsonView& view);

    // scene_reader_lattices.cpp
    FfdTransfer lattice(const JsonView& view);
    void readControl(FfdTransfer& ffd, const JsonView& view) const;
    void readMoves(FfdTransfer& ffd, const JsonView& view) const;
    MappedTransfer mapped(const JsonView& view);
    void countCells(double more, const JsonPlace& place);

    // scene_reader.cpp
    Asset asset(const JsonView& view) const;
    void checkPath(const JsonView& path) const;
    void checkReferences(const Scene& scene) const;
    void checkKinds(const Scene& scene, const std::vector<Reference>& uses, AssetKind kind, const char* word) const;

    std::string file_;
    std::function<std::string(const std::string&)> checkAssetPath_;
    std::set<std::string> namesOfDisplacements_, namesOfTransfers_;  // of all, known before any is read
    std::vector<Reference> objectUses_, transferUses_, displacementUses_, assetUses_, motionUses_;
    double cells_ = 0, controlPoints_ = 0;  // of all lattices and limbs so far
};

/// Throws Error (with `file` and a JSON pointer) where `use` goes round in a circle, where nodes nest deeper than
/// kDeepestNesting, and where a point of a term would visit more than kMostTermNodes. Every name that is used must
/// exist.
void checkGraph(const Scene& scene, const std::string& file);

}  // namespace voledit
