#pragma once
// Pieces of rays where maps are not affine: at cuts, gaps and borders.

#include <vector>

#include "core/rays/cell_look.h"
#include "core/rays/cell_raster.h"

namespace voledit {

/// Finds the affine pieces of stretches of rays by halving these until their middles fall, to a tenth of a voxel, where
/// their ends say, or they are a quarter of a step long, when the half that holds a cut is left out. Ends and middles
/// are mapped exactly, those of a whole tile together.
class RaggedPieces {
public:
    struct Piece {
        std::uint32_t pixel;
        float begin, end;  // steps
    };

    /// Forgets all pieces.
    void clear();
    /// Appends the stretch, in ragged cell `cell` of `look`, of a pixel's ray, which passes base + u · along in cell
    /// space.
    void add(const CellLook& look, const Piece& stretch, std::uint32_t cell, const std::array<float, 3>& base,
             const std::array<float, 3>& along);
    /// Finds the pieces of what was added since clear().
    void find(const CellLook& look);

    /// In no order; with the same numbers …
    std::span<const Piece> pieces() const { return pieces_; }
    /// … their maps.
    std::span<const OwnPiece> maps() const { return maps_; }

private:
    struct Stretch {
        Piece piece;
        std::uint32_t ray;
        Vec3 first, middle, last;  // index space
    };
    struct Ray {
        Vec3 start, step;  // where the inner maps go on from: start + u · step
        Vec3 base, along;  // in cell space
        std::uint32_t cell;
    };

    Vec3 placeOn(const Stretch& stretch, double part) const;
    Mat3 outerAt(const CellLook& look, const Stretch& stretch, double part) const;
    void mapEnds(const CellLook& look);
    void mapMiddles(const CellLook& look);
    void halve(const CellLook& look);
    static bool maySee(const CellLook& look, const Stretch& stretch);
    void keep(const CellLook& look, const Stretch& stretch);
    void keepHalves(const CellLook& look, const Stretch& stretch, float half);
    void turn(const CellLook& look);

    std::vector<Ray> rays_;
    std::vector<Stretch> open_, next_;
    std::vector<Piece> pieces_;
    std::vector<OwnPiece> maps_;
    std::vector<Vec3> middles_;  // of the pieces, where the inner maps go on from …
    std::vector<Mat3> outer_;    // … and the Jacobians there
    std::vector<Vec3> points_;
    std::vector<GradientTurn> turns_;
};

}  // namespace voledit
