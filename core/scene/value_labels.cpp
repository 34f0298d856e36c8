#include "core/scene/value_labels.h"

#include <array>
#include <vector>

#include "core/scene/scene_children.h"

namespace voledit {

namespace {

/// The last token of a JSON pointer, as a name.
std::string lastToken(const std::string& pointer) {
    std::string name;
    for (std::size_t i = pointer.rfind('/') + 1; i < pointer.size(); ++i) {
        const bool escaped = pointer[i] == '~' && i + 1 < pointer.size();
        name += escaped ? (pointer[++i] == '0' ? '~' : '/') : pointer[i];
    }
    return name;
}

bool isEntry(const NodePath& path) {
    for (const std::string list : {"/objects/", "/transfers/", "/displacements/"})
        if (path.starts_with(list) && path.find('/', list.size()) == std::string::npos) return true;
    return false;
}

std::string labelOf(const Object& object) {
    static constexpr std::array<const char*, 10> kTypes{"use",      "volume",   "solid", "fields",  "",
                                                        "transfer", "displace", "place", "recolor", "actor"};
    static_assert(kTypes.size() == std::variant_size_v<decltype(Object::kind)>);
    static constexpr const char* kOperators[] = {"union", "intersection", "difference", "merge",
                                                 "cap",   "trim",         "blend"};
    if (const auto* actor = std::get_if<ActorObject>(&object.kind); actor && !actor->name.empty()) return actor->name;
    if (const auto* volume = std::get_if<VolumeObject>(&object.kind)) return volume->asset;
    if (const auto* cvg = std::get_if<CvgObject>(&object.kind)) return kOperators[std::size_t(cvg->by)];
    return kTypes[object.kind.index()];
}

std::string labelOf(const Transfer& transfer) {
    static constexpr std::array<const char*, 10> kTypes{"affine", "lattice",  "use",         "",       "expression",
                                                        "fields", "sequence", "transferred", "mapped", "skeleton"};
    static_assert(kTypes.size() == std::variant_size_v<decltype(Transfer::kind)>);
    if (!transfer.name.empty()) return transfer.name;
    if (const auto* library = std::get_if<LibraryTransfer>(&transfer.kind)) return library->definition;
    return kTypes[transfer.kind.index()];
}

/// Tokens that say where a value stands and nothing to people.
bool isContainer(std::string_view token) {
    for (const char* word : {"skeleton", "joints", "pose", "limbs", "appearance", "shape", "move"})
        if (token == word) return true;
    return false;
}

}  // namespace

std::string nodeLabel(const Scene& scene, const NodePath& path) {
    if (isEntry(path)) return lastToken(path);
    if (const Object* object = findObjectAt(scene, path)) return labelOf(*object);
    if (const Transfer* transfer = findTransferAt(scene, path)) return labelOf(*transfer);
    if (findDisplacementAt(scene, path)) return "displacement";
    return findFieldAt(scene, path) ? "field" : "";
}

std::string valueLabel(const Scene& scene, const NodePath& node, const ValueName& name) {
    // A number that is a field goes by its place in the node around it.
    const bool isField = name.member.empty() && name.index == ValueName::kNone;
    if (isField) return nodeLabel(scene, parentOf(scene, node)) + " · " + lastToken(node);
    std::vector<std::string> words;
    for (const ValueName* at = &name; at; at = at->outer) {
        const bool isPoint = at->index != ValueName::kNone;
        const bool leaf = at == &name;
        if (isPoint) words.insert(words.begin(), "point " + std::to_string(at->index));
        // Where a control point has moved to, or by how much, is its position all the same.
        else if ((leaf || !isContainer(at->member)) && !(leaf && at->outer && at->outer->index != ValueName::kNone))
            words.insert(words.begin(), std::string(at->member));
    }
    std::string label = node.empty() ? "" : nodeLabel(scene, node);
    const char* separator = label.empty() ? "" : " · ";
    for (const std::string& word : words) {
        label += separator + word;
        separator = node.empty() && &word == &words.front() ? " · " : " ";
    }
    return label;
}

}  // namespace voledit
