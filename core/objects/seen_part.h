#pragma once
// Which part of a term is seen at a point, and where that part ends: what a cut face is the boundary of.

#include <cstdint>
#include <optional>

#include "core/objects/term.h"

namespace voledit {

/// The way from a term down to the one leaf that decides what is seen at a point. A point is *within* it where every
/// map on the way is defined and what it comes to has material, seen or not: a volume or mesh has values, fields lie in
/// their box, a solid's opacity is above 0; and where no solid on the way takes it off or leaves it out.
class SeenPart {
public:
    /// `term` must outlive it.
    SeenPart(const Term& term, const Vec3& p);

    /// within[i] = 1 where p[i] is within the part, else 0. Sizes must be equal.
    void within(std::span<const Vec3> p, std::span<std::uint8_t> within) const;
    bool within(const Vec3& p) const;
    /// A plane face at which the part may end: of the solid that a map's cells come from, or of a volume's (or fields')
    /// box.
    struct Face {
        std::size_t maps = 0;  // on the way to the space in which …
        Vec3 normal{0};        // … this is the face's, of any length and sign
    };
    /// The face that p, which is within, lies on but for a hundred-thousandth of its solid (of a volume, a hundredth of
    /// a voxel); nullopt where p is on none.
    std::optional<Face> face(const Vec3& p) const;
    /// The normal of a face as it appears at p, unit, of either sign: turned by the Jacobians that turn gradients, so
    /// that it shows no facets of cells. 0 where they give none.
    Vec3 normalOf(const Face& face, const Vec3& p) const;
    /// True if p is out of a map's cells.
    bool isOutOfCells(const Vec3& p) const;
    /// False where a map on the way may have several pre-images, where a solid shades itself, or nothing was found: its
    /// surface is no cut.
    bool isData() const { return data_; }

private:
    const Term* term_;
    std::vector<std::uint32_t> choices_;  // operands taken, from the root inwards
    bool data_ = false;
};

/// True if `term` holds anything but solids.
bool holdsData(const Term& term);

/// True for maps of cells that fold or keep what is outside: what is seen under them is combined of several pre-images,
/// which need not end where the first does.
bool mayCombine(const SpatialTransferFunction& map);
/// True if there is such a map anywhere in `term`.
bool anyMayCombine(const Term& term);

/// Union, merge and blend show their operands; the others cut one of them.
bool operandsJoin(CvgOperator by);
/// Of those others the operand that is cut: the first that holds data.
std::size_t operandThatIsCut(const CvgTerm& node);
/// Whether operand n, a solid, leaves what is within it and takes off the rest, or the other way round.
bool leavesItsInside(const CvgTerm& node, std::size_t n);

}  // namespace voledit
