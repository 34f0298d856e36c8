#include "app/opening/formula_files_of.h"

#include <set>

#include "core/scene/scene_children.h"

namespace voledit {

namespace {

template <class Node>
void collect(const Node& node, std::set<std::string>& files) {
    if constexpr (std::is_same_v<Node, Transfer>) {
        const auto* library = std::get_if<LibraryTransfer>(&node.kind);
        if (library && library->isFile) files.insert(library->definition);
    }
    visitChildren(node, [&](const ChildStep&, const auto& child) { collect(*child, files); });
}

}  // namespace

std::vector<std::string> formulaFilesOf(const Scene& scene) {
    std::set<std::string> files;
    collect(*scene.root, files);
    for (const auto& [name, object] : scene.objects) collect(*object, files);
    for (const auto& [name, transfer] : scene.transfers) collect(*transfer, files);
    for (const auto& [name, displacement] : scene.displacements) collect(*displacement, files);
    return {files.begin(), files.end()};
}

}  // namespace voledit
