#pragma once
// Terms whose volumes are small enough for whoever draws them.

#include <map>
#include <string>
#include <vector>

#include "core/objects/term.h"

namespace voledit {

/// Replaces volumes that are too long along an axis by ones at reduced resolution. Keeps what it made as long as it is
/// asked for: the same term gives the same term.
class VolumeFitter {
public:
    /// `root` with no volume of more than `largest` samples along any axis; itself where that is so. Volumes that serve
    /// as scalar fields of other objects stay as they are.
    TermPtr fitted(const TermPtr& root, int largest);
    /// What the last term lost, a line for each volume; empty where nothing.
    const std::vector<std::string>& notices() const { return notices_; }

private:
    struct Reduced {
        std::weak_ptr<const Volume> source;
        std::shared_ptr<const Volume> volume;
        std::string notice;
    };
    const Reduced& reduced(const std::shared_ptr<const Volume>& volume);
    TermPtr made(const TermPtr& term);
    TermPtr madeVolume(const VolumeTerm& node, const TermPtr& term);

    int largest_ = 0;
    TermPtr root_, result_;
    std::vector<Reduced> volumes_;
    std::map<const Term*, TermPtr> made_;  // of root_
    std::vector<std::string> notices_;
};

}  // namespace voledit
