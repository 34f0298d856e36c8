// The graph that `use` makes of a scene: no circles, not too deep, not too much for one point.
#include <algorithm>
#include <map>
#include <optional>

#include "core/base/error.h"
#include "core/scene/limits.h"
#include "core/scene/scene_children.h"
#include "core/scene/scene_reader.h"

namespace voledit {

namespace {

/// What evaluating a node takes.
struct Cost {
    std::size_t height = 1;  // levels of nodes, itself counted
    double nodes = 1;        // visited for one point, what is shared as often as it is used
};

/// Levels that a node takes by itself: a list of STFs nests as deep as it is long, an actor is a union of transfers.
std::size_t ownHeight(const Object& object) {
    if (const auto* transfer = std::get_if<TransferObject>(&object.kind)) return 1 + transfer->by.size();
    return std::holds_alternative<ActorObject>(object.kind) ? 2 : 1;
}
std::size_t ownHeight(const Transfer& transfer) {
    const auto* sequence = std::get_if<SequenceTransfer>(&transfer.kind);
    return 1 + (sequence ? sequence->of.size() : 0);
}
std::size_t ownHeight(const Displacement&) {
    return 1;
}
std::size_t ownHeight(const Field&) {
    return 1;
}

class GraphCheck {
public:
    GraphCheck(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    void check() {
        checkNamed("transfers", scene_.transfers);
        checkNamed("displacements", scene_.displacements);
        checkNamed("objects", scene_.objects);
        const JsonPlace top;
        names_.assign(1, "root");
        entry_ = "/root";
        cost(*scene_.root, top.at("root"), 0);
    }

private:
    template <class Map>
    void checkNamed(const char* member, const Map& named) {
        for (const auto& [name, node] : named) {
            names_.assign(1, name);
            entry_ = memberOf(std::string("/") + member, name);
            costOfNamed(member, named, name, 0);
        }
    }

    /// The cost of `node`, which stands `depth` levels below the top. Recursion is bounded since every level counts.
    template <class Node>
    Cost cost(const Node& node, const JsonPlace& place, std::size_t depth) {
        if (depth > kDeepestNesting) failDepth();
        Cost below{0, 0};
        const auto add = [&](const Cost& more) {
            below.height = std::max(below.height, more.height);
            below.nodes += more.nodes;
        };
        const auto named = costOfUse(node, depth + 1);
        if (named) add(*named);
        visitChildren(node, [&](const ChildStep& step, const auto& child) {
            const JsonPlace outer = step.outer.empty() ? place : place.at(step.outer);
            const JsonPlace member = outer.at(step.member);
            const JsonPlace element = step.element == ChildStep::kNone ? member : member.at(step.element);
            add(cost(*child, step.inner.empty() ? element : element.at(step.inner), depth + 1));
        });
        const Cost result{ownHeight(node) + below.height, (named ? 0 : 1) + below.nodes};
        if (depth + result.height > kDeepestNesting + 1) failDepth();
        if (result.nodes > double(kMostTermNodes))
            fail(place.pointer(),
                 "one point of this would take more than " + std::to_string(kMostTermNodes) +
                     " nodes to evaluate, since what is used twice is evaluated twice",
                 "use shared things less often within each other");
        return result;
    }

    std::optional<Cost> costOfUse(const Object& node, std::size_t depth) {
        return costOfUse<ObjectUse>(node, "objects", scene_.objects, depth);
    }
    std::optional<Cost> costOfUse(const Transfer& node, std::size_t depth) {
        return costOfUse<TransferUse>(node, "transfers", scene_.transfers, depth);
    }
    std::optional<Cost> costOfUse(const Displacement& node, std::size_t depth) {
        return costOfUse<DisplacementUse>(node, "displacements", scene_.displacements, depth);
    }
    std::optional<Cost> costOfUse(const Field&, std::size_t) { return std::nullopt; }

    template <class Use, class Node, class Map>
    std::optional<Cost> costOfUse(const Node& node, const char* member, const Map& named, std::size_t depth) {
        const auto* use = std::get_if<Use>(&node.kind);
        if (!use) return std::nullopt;
        names_.push_back(use->name);
        const Cost result = costOfNamed(member, named, use->name, depth);
        names_.pop_back();
        return result;
    }

    template <class Map>
    Cost costOfNamed(const char* member, const Map& named, const std::string& name, std::size_t depth) {
        const auto key = std::pair(std::string_view(member), name);
        const auto [entry, isNew] = costs_.try_emplace(key, std::nullopt);
        if (!isNew && !entry->second) failCircle(std::string("/") + member, name);
        if (!isNew) {
            if (depth + entry->second->height > kDeepestNesting + 1) failDepth();
            return *entry->second;
        }
        const JsonPlace top;
        const JsonPlace entries = top.at(member);
        const Cost result = cost(*named.at(name), entries.at(name), depth);
        costs_[key] = result;
        return result;
    }

    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& remedy) const {
        throw Error(file_ + ": " + pointer, what, remedy);
    }

    [[noreturn]] void failDepth() const {
        fail(entry_, "objects and transfers nest deeper than " + std::to_string(kDeepestNesting) + " levels",
             "split the scene into fewer levels");
    }

    [[noreturn]] void failCircle(const std::string& member, const std::string& name) const {
        std::string chain;
        bool inside = false;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            inside = inside || names_[i] == name;
            if (inside) chain += (chain.empty() ? "" : " → ") + abridged(names_[i]);
            if (chain.size() > 200) {
                chain += " → …";
                break;
            }
        }
        fail(memberOf(member, name), "a cycle: it uses itself (" + chain + ")", "break the circle of `use`");
    }

    const Scene& scene_;
    std::string file_;
    std::map<std::pair<std::string_view, std::string>, std::optional<Cost>> costs_;  // nullopt while being walked
    std::vector<std::string> names_;  // used, from the top to where the walk is
    std::string entry_;               // the top's JSON pointer
};

}  // namespace

void checkGraph(const Scene& scene, const std::string& file) {
    GraphCheck(scene, file).check();
}

}  // namespace voledit
