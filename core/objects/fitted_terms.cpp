#include "core/objects/fitted_terms.h"

#include <algorithm>

#include "core/fields/reduced_volume.h"

namespace voledit {

namespace {

int longest(const Volume& volume) {
    const Index3 size = volume.grid().size;
    return std::max({size.x, size.y, size.z});
}

std::string sizeText(const Index3& n) {
    return std::to_string(n.x) + "x" + std::to_string(n.y) + "x" + std::to_string(n.z);
}

}  // namespace

const VolumeFitter::Reduced& VolumeFitter::reduced(const std::shared_ptr<const Volume>& volume) {
    std::erase_if(volumes_, [](const Reduced& r) { return r.source.expired(); });
    for (const Reduced& r : volumes_)
        if (r.source.lock() == volume) return r;
    const Index3 size = volume->grid().size;
    Index3 box(1);
    for (int a = 0; a < 3; ++a)
        while (size[a] / box[a] > largest_) box[a] *= 2;
    Reduced made{volume, reducedVolume(*volume, box), ""};
    made.notice = "a volume of " + sizeText(size) + " voxels is drawn at reduced resolution, " +
                  sizeText(made.volume->grid().size) + ": OpenGL holds at most " + std::to_string(largest_) +
                  " along an axis here; rays draw it whole";
    volumes_.push_back(std::move(made));
    return volumes_.back();
}

TermPtr VolumeFitter::madeVolume(const VolumeTerm& node, const TermPtr& term) {
    if (longest(*node.volume) <= largest_) return term;
    const Reduced& r = reduced(node.volume);
    if (std::find(notices_.begin(), notices_.end(), r.notice) == notices_.end()) notices_.push_back(r.notice);
    return makeVolumeTerm(r.volume, node.channel, node.appearance, node.interpolation);
}

TermPtr VolumeFitter::made(const TermPtr& term) {
    if (const auto known = made_.find(term.get()); known != made_.end()) return known->second;
    TermPtr result = term;
    if (const auto* volume = std::get_if<VolumeTerm>(&term->node)) {
        result = madeVolume(*volume, term);
    } else if (const auto* transfer = std::get_if<TransferTerm>(&term->node)) {
        if (const TermPtr of = made(transfer->of); of != transfer->of)
            result = makeTransferTerm(transfer->by, of, transfer->combine, transfer->name, transfer->role);
    } else if (const auto* recolor = std::get_if<RecolorTerm>(&term->node)) {
        RecolorTerm changed = *recolor;
        changed.of = made(recolor->of);
        if (changed.of != recolor->of) result = makeRecolorTerm(std::move(changed));
    } else if (const auto* operation = std::get_if<CvgTerm>(&term->node)) {
        std::vector<TermPtr> of;
        for (const TermPtr& operand : operation->of) of.push_back(made(operand));
        if (of != operation->of) result = makeCvgTerm(operation->by, std::move(of), operation->weight);
    }
    made_.emplace(term.get(), result);
    return result;
}

TermPtr VolumeFitter::fitted(const TermPtr& root, int largest) {
    if (root == root_ && largest == largest_) return result_;
    if (largest != largest_) volumes_.clear();
    largest_ = largest;
    notices_.clear();
    made_.clear();
    result_ = made(root);
    made_.clear();
    root_ = root;
    return result_;
}

}  // namespace voledit
