#include "core/objects/seen_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/stf/mapped_cells.h"
#include "core/stf/mesh_field.h"

namespace voledit {

namespace {

ObjectSample sampleAt(const Term& term, const Vec3& p) {
    ObjectSample s;
    sample(term, std::span(&p, 1), std::span(&s, 1), false, "");
    return s;
}

/// Which operand of a CVG node is seen at p.
std::uint32_t chosenOperand(const CvgTerm& node, const Vec3& p) {
    if (!operandsJoin(node.by)) return std::uint32_t(operandThatIsCut(node));
    std::uint32_t best = 0;
    double most = -1;
    for (std::uint32_t n = 0; n < node.of.size(); ++n)
        if (const double opacity = sampleAt(*node.of[n], p).opacity; opacity > most) {
            most = opacity;
            best = n;
        }
    return best;
}

/// Follows the way from a term to a leaf: through(map), operand(node, n), leaf(term).
template <class Visitor>
void follow(const Term& term, Visitor& visitor) {
    const Term* at = &term;
    while (at) {
        const Term* next = nullptr;
        if (const auto* transfer = std::get_if<TransferTerm>(&at->node)) {
            visitor.through(*transfer->by);
            next = transfer->of.get();
        } else if (const auto* recolor = std::get_if<RecolorTerm>(&at->node)) {
            next = recolor->of.get();
        } else if (const auto* cvg = std::get_if<CvgTerm>(&at->node)) {
            next = cvg->of[visitor.operand(*cvg)].get();
        } else {
            visitor.leaf(*at);
        }
        at = next;
    }
}

/// Makes the choices for one point.
struct Chooser {
    Vec3 p;
    std::vector<std::uint32_t>& choices;
    bool data = false, several = false;

    void through(const SpatialTransferFunction& map) {
        several = several || mayCombine(map);
        map.map(std::span(&p, 1), std::span(&p, 1));
    }
    std::uint32_t operand(const CvgTerm& node) {
        choices.push_back(chosenOperand(node, p));
        return choices.back();
    }
    void leaf(const Term& term) { data = !several && isDefined(p) && !std::holds_alternative<SolidTerm>(term.node); }
};

/// Takes out of `within` what is not within a part, along choices that were made.
struct Tester {
    std::vector<Vec3> p;
    std::span<std::uint8_t> within;
    std::span<const std::uint32_t> choices;
    std::size_t next = 0;

    template <class Keep>
    void keepWhere(const Keep& keep) {
        for (std::size_t i = 0; i < p.size(); ++i)
            if (within[i] && !(isDefined(p[i]) && keep(i))) within[i] = 0;
    }
    std::vector<ObjectSample> samplesOf(const Term& term) const {
        std::vector<ObjectSample> samples(p.size());
        sample(term, p, samples, false, "");
        return samples;
    }

    void through(const SpatialTransferFunction& map) {
        map.map(p, p);
        keepWhere([](std::size_t) { return true; });
    }
    std::uint32_t operand(const CvgTerm& node) {
        const std::uint32_t chosen = choices[next++];
        if (operandsJoin(node.by)) return chosen;
        for (std::size_t n = 0; n < node.of.size(); ++n) {
            if (n == chosen || holdsData(*node.of[n])) continue;
            const auto cutter = samplesOf(*node.of[n]);
            const bool inside = leavesItsInside(node, n);
            keepWhere([&](std::size_t i) { return (cutter[i].opacity > 0) == inside; });
        }
        return chosen;
    }
    void leaf(const Term& term) {
        if (const auto* volume = std::get_if<VolumeTerm>(&term.node)) {
            const VolumeGrid& grid = volume->volume->grid();
            const Mat4& indexFromWorld = volume->volume->indexFromWorld();
            const Box3 domain = grid.indexDomain();
            keepWhere([&](std::size_t i) { return domain.contains(transformPoint(indexFromWorld, p[i])); });
        } else if (const auto* mesh = std::get_if<MeshTerm>(&term.node)) {
            std::vector<double> value(p.size());
            mesh->field->sample(p, value);
            keepWhere([&](std::size_t i) { return value[i] == value[i]; });
        } else if (const auto* fields = std::get_if<FieldsTerm>(&term.node)) {
            keepWhere([&](std::size_t i) { return fields->box.contains(p[i]); });
        } else {
            const auto samples = samplesOf(term);
            keepWhere([&](std::size_t i) { return samples[i].opacity > 0; });
        }
    }
};

/// Finds the face that a point within lies on.
struct FaceFinder {
    Vec3 p;
    std::span<const std::uint32_t> choices;
    std::size_t next = 0, maps = 0;
    double nearest = 1;  // shares of the reach within which a face counts
    std::optional<SeenPart::Face> face = std::nullopt;
    bool outOfCells = false;

    void through(const SpatialTransferFunction& map) {
        const MappedCells* cells = map.cells();
        const bool known = isDefined(p);
        CellLocation at{};
        // What is kept as it is comes from no cell.
        const bool comesFromCell = cells && (map.outside() == Outside::Hide || (known && cells->locate(p, at)));
        map.map(std::span(&p, 1), std::span(&p, 1));
        ++maps;
        outOfCells = outOfCells || (known && !isDefined(p) && cells);
        if (!comesFromCell || !isDefined(p)) return;
        double reach = 0;
        for (const Vec4& plane : cells->sourceFaces()) reach = std::max(reach, distanceTo(plane));
        for (const Vec4& plane : cells->sourceFaces()) take(distanceTo(plane), 1e-5 * reach, Vec3(plane));
    }
    std::uint32_t operand(const CvgTerm&) { return choices[next++]; }
    void leaf(const Term& term) {
        if (!isDefined(p)) return;
        if (const auto* volume = std::get_if<VolumeTerm>(&term.node)) {
            const Mat4& indexFromWorld = volume->volume->indexFromWorld();
            takeBox(volume->volume->grid().indexDomain(), indexFromWorld, 0.01);
        } else if (const auto* fields = std::get_if<FieldsTerm>(&term.node)) {
            const Vec3 size = fields->box.size();
            takeBox(fields->box, Mat4(1), 1e-5 * std::max({size.x, size.y, size.z}));
        }
    }

private:
    double distanceTo(const Vec4& plane) const { return std::abs(glm::dot(Vec3(plane), p) + plane.w); }
    void takeBox(const Box3& box, const Mat4& boxFromSpace, double reach) {
        const Vec3 at = transformPoint(boxFromSpace, p);
        for (int a = 0; a < 3; ++a)
            take(std::min(std::abs(at[a] - box.min[a]), std::abs(at[a] - box.max[a])), reach,
                 Vec3(glm::transpose(boxFromSpace)[a]));
    }
    void take(double distance, double reach, const Vec3& normal) {
        if (!(distance < nearest * reach)) return;
        nearest = distance / reach;
        face = SeenPart::Face{maps, normal};
    }
};

/// Turns a normal back to where a point comes from.
struct Turner {
    Vec3 p;
    std::span<const std::uint32_t> choices;
    std::size_t maps;  // to go through
    std::size_t next = 0;
    Mat3 turn{1.0};  // d p / d the first p

    void through(const SpatialTransferFunction& map) {
        if (maps == 0) return;
        --maps;
        Mat3 jacobian(1.0);
        map.jacobian(std::span(&p, 1), std::span(&jacobian, 1));
        map.map(std::span(&p, 1), std::span(&p, 1));
        turn = jacobian * turn;
    }
    std::uint32_t operand(const CvgTerm&) { return choices[next++]; }
    void leaf(const Term&) {}
};

}  // namespace

bool holdsData(const Term& term) {
    if (const auto* transfer = std::get_if<TransferTerm>(&term.node)) return holdsData(*transfer->of);
    if (const auto* recolor = std::get_if<RecolorTerm>(&term.node)) return holdsData(*recolor->of);
    if (const auto* cvg = std::get_if<CvgTerm>(&term.node))
        return std::any_of(cvg->of.begin(), cvg->of.end(), [](const TermPtr& of) { return holdsData(*of); });
    return !std::holds_alternative<SolidTerm>(term.node);
}

bool mayCombine(const SpatialTransferFunction& map) {
    return map.cells() && (map.cells()->mayOverlap() || map.outside() == Outside::Keep);
}

bool anyMayCombine(const Term& term) {
    if (const auto* transfer = std::get_if<TransferTerm>(&term.node))
        return mayCombine(*transfer->by) || anyMayCombine(*transfer->of);
    if (const auto* recolor = std::get_if<RecolorTerm>(&term.node)) return anyMayCombine(*recolor->of);
    if (const auto* cvg = std::get_if<CvgTerm>(&term.node))
        return std::any_of(cvg->of.begin(), cvg->of.end(), [](const TermPtr& of) { return anyMayCombine(*of); });
    return false;
}

bool operandsJoin(CvgOperator by) {
    return by == CvgOperator::Union || by == CvgOperator::Merge || by == CvgOperator::Blend;
}

std::size_t operandThatIsCut(const CvgTerm& node) {
    const auto data = std::find_if(node.of.begin(), node.of.end(), [](const TermPtr& of) { return holdsData(*of); });
    return data == node.of.end() ? 0 : std::size_t(data - node.of.begin());
}

bool leavesItsInside(const CvgTerm& node, std::size_t n) {
    return n == 0 || node.by == CvgOperator::Intersection || node.by == CvgOperator::Cap;
}

SeenPart::SeenPart(const Term& term, const Vec3& p) : term_(&term) {
    Chooser chooser{p, choices_};
    follow(term, chooser);
    data_ = chooser.data;
}

void SeenPart::within(std::span<const Vec3> p, std::span<std::uint8_t> within) const {
    std::fill(within.begin(), within.end(), std::uint8_t(1));
    Tester tester{{p.begin(), p.end()}, within, choices_};
    follow(*term_, tester);
}

bool SeenPart::within(const Vec3& p) const {
    std::uint8_t found = 0;
    within(std::span(&p, 1), std::span(&found, 1));
    return found != 0;
}

std::optional<SeenPart::Face> SeenPart::face(const Vec3& p) const {
    FaceFinder finder{.p = p, .choices = choices_};
    follow(*term_, finder);
    return finder.face;
}

Vec3 SeenPart::normalOf(const Face& face, const Vec3& p) const {
    Turner turner{.p = p, .choices = choices_, .maps = face.maps};
    follow(*term_, turner);
    const Vec3 turned = glm::transpose(turner.turn) * face.normal;
    const double length = glm::length(turned);
    return length > 0 && std::isfinite(length) ? turned / length : Vec3(0);
}

bool SeenPart::isOutOfCells(const Vec3& p) const {
    FaceFinder finder{.p = p, .choices = choices_};
    follow(*term_, finder);
    return finder.outOfCells;
}

}  // namespace voledit
