// The graph that `use` makes of a scene: no circles, not too deep.
#include <map>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "core/scene/limits.h"
#include "core/scene/scene_reader.h"

namespace voledit {

namespace {

class GraphCheck {
public:
    GraphCheck(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    void check() {
        for (const auto& entry : scene_.transfers) followTransfer(entry.first);
        for (const auto& entry : scene_.objects) {
            names_.assign(1, entry.first);
            heightOfNamed(entry.first, 0);
        }
        names_.assign(1, "root");
        height(*scene_.root, 0);
    }

private:
    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& remedy) const {
        throw Error(file_ + ": " + pointer, what, remedy);
    }

    /// Levels of compiled objects under `object`, which itself stands `depth` below the top. Recursion is bounded since
    /// every level counts.
    std::size_t height(const Object& object, std::size_t depth) {
        if (depth > kDeepestNesting) failDepth();
        std::size_t result = 1;
        if (const auto* use = std::get_if<ObjectUse>(&object.kind)) {
            names_.push_back(use->name);
            result += heightOfNamed(use->name, depth + 1);
            names_.pop_back();
        } else if (const auto* place = std::get_if<PlaceObject>(&object.kind)) {
            result += height(*place->of, depth + 1);
        } else if (const auto* transfer = std::get_if<TransferObject>(&object.kind)) {
            result += transfer->by.size() + height(*transfer->of, depth + 1);
        }
        if (depth + result > kDeepestNesting + 1) failDepth();
        return result;
    }

    std::size_t heightOfNamed(const std::string& name, std::size_t depth) {
        auto [entry, isNew] = heights_.try_emplace(name, std::nullopt);
        if (!isNew && !entry->second) failCircle("/objects", name);
        if (!isNew) {
            if (depth + *entry->second > kDeepestNesting + 1) failDepth();
            return *entry->second;
        }
        const std::size_t result = height(*scene_.objects.at(name), depth);
        heights_[name] = result;
        return result;
    }

    void followTransfer(const std::string& first) {
        std::set<std::string> seen;
        names_.assign(1, first);
        for (std::string name = first; seen.insert(name).second;) {
            const auto* use = std::get_if<TransferUse>(&scene_.transfers.at(name)->kind);
            if (!use) return;
            name = use->name;
            names_.push_back(name);
        }
        failCircle("/transfers", names_.back());
    }

    [[noreturn]] void failDepth() const {
        fail(names_.front() == "root" ? "/root" : memberOf("/objects", names_.front()),
             "objects and transfers nest deeper than " + std::to_string(kDeepestNesting) + " levels",
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
    std::map<std::string, std::optional<std::size_t>> heights_;  // nullopt while being walked
    std::vector<std::string> names_;                             // from the top to where the walk is
};

}  // namespace

void checkGraph(const Scene& scene, const std::string& file) {
    GraphCheck(scene, file).check();
}

}  // namespace voledit
