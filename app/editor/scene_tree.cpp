#include "app/editor/scene_tree.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>

#include "app/editor/icons.h"
#include "core/scene/nodes.h"
#include "core/scene/scene_children.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

namespace {

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

const char* wordOf(CvgOperator by) {
    static constexpr const char* kWords[] = {"Union", "Intersection", "Difference", "Merge", "Cap", "Trim", "Blend"};
    return kWords[std::size_t(by)];
}

const char* wordOf(CombinedDisplacement::Kind kind) {
    static constexpr const char* kWords[] = {"Sum", "Union", "Intersection"};
    return kWords[std::size_t(kind)];
}

const char* wordOf(const SolidObject& solid) {
    static constexpr const char* kWords[] = {"Sphere", "Box", "Cylinder", "Capsule", "Torus", "Text", "Shape"};
    return kWords[solid.shape.index()];
}

std::string titleOf(const LibraryTransfer& library) {
    if (library.isFile) return std::filesystem::path(library.definition).stem().string();
    const TransferDefinitionPtr definition = libraryTransfer(library.definition);
    return definition ? definition->title() : library.definition;
}

/// "2 deformations"
std::string count(std::size_t n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// A few words behind the name.
std::string detailOf(const Transfer& transfer) {
    std::string text;
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "  ·  ") + more; };
    if (const auto* ffd = std::get_if<FfdTransfer>(&transfer.kind))
        add(std::to_string(ffd->points.x) + "×" + std::to_string(ffd->points.y) + "×" + std::to_string(ffd->points.z));
    if (const auto* library = std::get_if<LibraryTransfer>(&transfer.kind); library && library->isFile) add("file");
    if (const auto* formula = std::get_if<ExpressionTransfer>(&transfer.kind); formula && formula->world) add("world");
    if (*transfer.amount != 1 && !transfer.amount.animated()) add(number(*transfer.amount));
    return text;
}

std::string detailOf(const Object& object) {
    if (const auto* solid = std::get_if<SolidObject>(&object.kind))
        if (const auto* text = std::get_if<SolidText>(&solid->shape)) return "“" + text->string + "”";
    if (const auto* transfer = std::get_if<TransferObject>(&object.kind))
        return count(transfer->by.size(), "deformation");
    if (const auto* volume = std::get_if<VolumeObject>(&object.kind)) return volume->asset;
    if (const auto* actor = std::get_if<ActorObject>(&object.kind)) return actor->rig.motion;
    return {};
}

/// Any node of a scene.
using Node = std::variant<const Object*, const Transfer*, const Displacement*, const Field*>;

struct Child {
    std::string step;    // behind the parent's path
    std::string member;  // said before the label; "" where the place says enough
    Node node;
};
using Children = std::vector<Child>;

/// Fields that are made of other nodes; the others are a line of their owner's inspector.
bool isCompound(const Field& field) {
    return std::holds_alternative<ComponentOf>(field.kind) || std::holds_alternative<AttributeOf>(field.kind) ||
           std::holds_alternative<MappedField>(field.kind);
}

/// What is said before the label of a child: nothing where its place says enough.
std::string memberLabel(const ChildStep& step, bool isField, bool isTransferred) {
    static constexpr const char* kColors[] = {"red", "green", "blue"};
    if (isField && step.member == "color") return kColors[step.element];
    return isField || isTransferred ? std::string(step.member) : "";
}

template <class T>
Children childrenOf(const T& node) {
    Children children;
    bool transferred = false;
    if constexpr (std::is_same_v<T, Transfer>) transferred = std::holds_alternative<TransferredTransfer>(node.kind);
    visitChildren(node, [&](const ChildStep& step, const auto& child) {
        constexpr bool kField = std::is_same_v<std::remove_cvref_t<decltype(*child)>, Field>;
        if constexpr (kField)
            if (!isCompound(*child)) return;
        children.push_back({childPath("", step), memberLabel(step, kField, transferred), &*child});
    });
    return children;
}

/// What a `use` means, and the path where that stands.
struct Resolved {
    Node node;
    std::string path;
    std::string name;
};

template <class Use, class Map, class T>
std::optional<Resolved> followed(const T& node, const Map& named, NodePath (*pathOf)(const std::string&)) {
    const auto* use = std::get_if<Use>(&node.kind);
    if (!use) return std::nullopt;
    const auto found = named.find(use->name);
    if (found == named.end()) return std::nullopt;
    return Resolved{&*found->second, pathOf(use->name), use->name};
}

std::optional<Resolved> followed(const Scene& scene, const Node& node) {
    return std::visit(
        Overloaded{
            [&](const Object* o) { return followed<ObjectUse>(*o, scene.objects, objectPath); },
            [&](const Transfer* t) { return followed<TransferUse>(*t, scene.transfers, transferPath); },
            [&](const Displacement* d) { return followed<DisplacementUse>(*d, scene.displacements, displacementPath); },
            [&](const Field*) { return std::optional<Resolved>(); }},
        node);
}

/// Whether two words differ in nothing but case.
bool alike(const std::string& a, const std::string& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// What a row says of a node, by the node alone.
void describe(SceneRow& row, const Resolved& shown) {
    row.kind = SceneRow::Kind(shown.node.index());
    row.name = shown.name;
    std::visit(Overloaded{[&](const Object* o) {
                              row.label = titleOf(*o);
                              row.detail = detailOf(*o);
                              row.icon = iconOf(*o);
                              const auto* actor = std::get_if<ActorObject>(&o->kind);
                              if (actor && row.name.empty()) row.name = actor->name;
                          },
                          [&](const Transfer* t) {
                              row.label = titleOf(*t);
                              row.detail = detailOf(*t);
                              row.icon = iconOf(*t);
                              row.on = t->enabled;
                              if (row.name.empty()) row.name = t->name;
                          },
                          [&](const Displacement* d) {
                              row.label = titleOf(*d);
                              row.icon = icons::kDisplace;
                          },
                          [&](const Field* f) {
                              row.label = titleOf(*f);
                              row.icon = icons::kFields;
                          }},
               shown.node);
    if (row.name.empty()) return;
    // "twist  Twist" would say the same twice.
    if (!alike(row.label, row.name)) row.detail = row.label + (row.detail.empty() ? "" : "  ·  " + row.detail);
    row.label = row.name;
}

Children childrenOf(const Node& node) {
    return std::visit([](const auto* n) { return childrenOf(*n); }, node);
}

/// Paths of the named nodes that `start` reaches, itself left out. Without recursion: terms may be deep.
std::set<std::string> reachedFrom(const Scene& scene, const Node& start) {
    std::set<std::string> reached;
    std::vector<Node> open{start};
    while (!open.empty()) {
        const Node node = open.back();
        open.pop_back();
        if (const auto target = followed(scene, node)) {
            if (reached.insert(target->path).second) open.push_back(target->node);
            continue;
        }
        for (const Child& child : childrenOf(node)) open.push_back(child.node);
    }
    return reached;
}

class Rows {
public:
    Rows(const Scene& scene, const std::set<std::string>& closed) : scene_(scene), closed_(closed) {}

    std::vector<SceneRow> all() {
        const Node root = &*scene_.root;
        add(kRootPath, "", "", root, 0);
        unused_ = true;
        const std::set<std::string> shown = reachedFrom(scene_, root);
        std::map<std::string, Resolved> unused;
        const auto collect = [&](NodePath (*pathOf)(const std::string&), const auto& named) {
            for (const auto& [name, value] : named)
                if (const NodePath path = pathOf(name); !shown.contains(path))
                    unused.emplace(path, Resolved{&*value, path, name});
        };
        collect(objectPath, scene_.objects);
        collect(transferPath, scene_.transfers);
        collect(displacementPath, scene_.displacements);
        // One that another of them uses stands below that.
        std::set<std::string> below;
        for (const auto& [path, node] : unused) below.merge(reachedFrom(scene_, node.node));
        for (const auto& [path, node] : unused)
            if (!below.contains(path)) add(path, node.name, "", node.node, 0);
        nameWidgets();
        return std::move(rows_);
    }

private:
    const Scene& scene_;
    const std::set<std::string>& closed_;
    std::vector<SceneRow> rows_;
    std::set<std::string> met_;  // named nodes that have their rows
    bool unused_ = false;

    void add(const std::string& path, const std::string& name, const std::string& member, const Node& node, int depth) {
        Resolved shown{node, path, name};
        SceneRow row;
        // A `use` of a `use` ends where one stands for something; cycles are refused on loading.
        while (auto target = followed(scene_, shown.node)) {
            shown = *std::move(target);
            row.link = true;
            row.repeated = !met_.insert(shown.path).second;
        }
        describe(row, shown);
        if (!member.empty()) row.label = member + ": " + row.label;
        row.path = path;
        row.target = shown.path;
        row.depth = depth;
        row.unused = unused_;
        const Children children = childrenOf(shown.node);
        row.parent = !children.empty() && !row.repeated && depth < kDeepestRow;
        row.open = row.parent && !closed_.contains(path);
        const bool open = row.open;
        rows_.push_back(std::move(row));
        if (open)
            for (const Child& child : children) add(shown.path + child.step, "", child.member, child.node, depth + 1);
    }

    void nameWidgets() {
        std::map<std::string, int> counts;
        for (SceneRow& row : rows_) {
            const int n = ++counts[row.label];
            row.widget = row.label + (n > 1 ? " " + std::to_string(n) : "");
        }
    }
};

}  // namespace

std::string titleOf(const Object& object) {
    return std::visit(Overloaded{[](const ObjectUse& use) { return use.name; },
                                 [](const VolumeObject&) { return std::string("Volume"); },
                                 [](const SolidObject& solid) { return std::string(wordOf(solid)); },
                                 [](const FieldsObject&) { return std::string("Fields"); },
                                 [](const CvgObject& cvg) { return std::string(wordOf(cvg.by)); },
                                 [](const TransferObject&) { return std::string("Transfer"); },
                                 [](const DisplaceObject&) { return std::string("Displace"); },
                                 [](const PlaceObject&) { return std::string("Place"); },
                                 [](const RecolorObject&) { return std::string("Recolour"); },
                                 [](const ActorObject&) { return std::string("Actor"); }},
                      object.kind);
}

std::string titleOf(const Transfer& transfer) {
    return std::visit(Overloaded{[](const AffineTransfer&) { return std::string("Affine"); },
                                 [](const FfdTransfer&) { return std::string("Lattice"); },
                                 [](const TransferUse& use) { return use.name; },
                                 [](const LibraryTransfer& library) { return titleOf(library); },
                                 [](const ExpressionTransfer&) { return std::string("Expression"); },
                                 [](const FieldsTransfer&) { return std::string("Fields"); },
                                 [](const SequenceTransfer&) { return std::string("Sequence"); },
                                 [](const TransferredTransfer&) { return std::string("Transferred"); },
                                 [](const MappedTransfer&) { return std::string("Mapped cells"); },
                                 [](const SkeletonTransfer& limb) { return limb.limb; }},
                      transfer.kind);
}

std::string titleOf(const Displacement& displacement) {
    return std::visit(Overloaded{[](const DisplacementUse& use) { return use.name; },
                                 [](const OfDisplacement&) { return std::string("Displacement of"); },
                                 [](const ScaleDisplacement&) { return std::string("Scale"); },
                                 [](const CombinedDisplacement& c) { return std::string(wordOf(c.kind)); },
                                 [](const BlendDisplacement&) { return std::string("Blend"); },
                                 [](const FieldsDisplacement&) { return std::string("Fields"); }},
                      displacement.kind);
}

std::string titleOf(const Field& field) {
    static constexpr const char* kAxes[] = {"x", "y", "z"};
    return std::visit(Overloaded{[](const NumberField& value) { return number(*value.value); },
                                 [](const FormulaField& formula) { return formula.expression; },
                                 [](const ComponentOf& c) { return std::string(kAxes[std::size_t(c.axis)]) + " of"; },
                                 [](const AttributeOf& attribute) { return attribute.name + " of"; },
                                 [](const AssetField& asset) { return asset.asset; },
                                 [](const MappedField&) { return std::string("Table"); }},
                      field.kind);
}

const char* iconOf(const Object& object) {
    static constexpr const char* kIcons[] = {icons::kLink,    icons::kVolume,   icons::kSolid,    icons::kFields,
                                             icons::kCombine, icons::kTransfer, icons::kDisplace, icons::kPlace,
                                             icons::kRecolor, icons::kActor};
    return kIcons[object.kind.index()];
}

const char* iconOf(const Transfer& transfer) {
    if (const auto* library = std::get_if<LibraryTransfer>(&transfer.kind); library && library->isFile)
        return icons::kFormulaFile;
    static constexpr const char* kIcons[] = {icons::kPlace,   icons::kLattice, icons::kLink,     icons::kMagic,
                                             icons::kFormula, icons::kFields,  icons::kSequence, icons::kTransfer,
                                             icons::kLattice, icons::kActor};
    return kIcons[transfer.kind.index()];
}

std::vector<SceneRow> sceneRows(const Scene& scene, const std::set<std::string>& closed) {
    return Rows(scene, closed).all();
}

const SceneRow* rowAt(const std::vector<SceneRow>& rows, const std::string& path) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const SceneRow& row) { return row.path == path; });
    return at == rows.end() ? nullptr : &*at;
}

}  // namespace voledit
