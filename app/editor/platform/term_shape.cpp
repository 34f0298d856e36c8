#include "app/editor/platform/term_shape.h"

#include <map>
#include <typeinfo>

namespace voledit {

namespace {

std::uint64_t identity(const void* piece) {
    return std::uint64_t(reinterpret_cast<std::uintptr_t>(piece));
}

class Collector {
public:
    explicit Collector(TermShape& shape) : shape_(shape) {}

    void add(const TermPtr& term) {
        if (!term) return;
        const auto [seen, isNew] = seen_.try_emplace(term.get(), seen_.size());
        shape_.push_back(isNew ? term->node.index() : kSeen + seen->second);
        if (isNew) std::visit([&](const auto& node) { inside(node); }, term->node);
    }

private:
    static constexpr std::uint64_t kSeen = 1000;

    void inside(const VolumeTerm& node) { shape_.push_back(identity(node.volume.get())); }
    void inside(const MeshTerm& node) { shape_.push_back(identity(node.field.get())); }
    void inside(const TransferTerm& node) {
        const auto& map = *node.by;
        shape_.push_back(typeid(map).hash_code());
        add(node.of);
    }
    void inside(const SolidTerm&) {}
    void inside(const FieldsTerm&) {}
    void inside(const CvgTerm& node) {
        shape_.push_back(node.of.size());
        for (const TermPtr& part : node.of) add(part);
    }
    void inside(const RecolorTerm& node) { add(node.of); }

    TermShape& shape_;
    std::map<const Term*, std::uint64_t> seen_;
};

}  // namespace

TermShape shapeOf(const CompiledScene& scene) {
    const RenderSettings& render = scene.render;
    TermShape shape{std::uint64_t(render.shading) + 2 * std::uint64_t(render.shading && render.shadows > 0) +
                    4 * std::uint64_t(render.shading && render.occlusion > 0)};
    Collector(shape).add(scene.root);
    return shape;
}

}  // namespace voledit
