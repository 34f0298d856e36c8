#pragma once
// Pieces of rays where maps are not affine: at cuts, gaps and borders.

#include <vector>

#include "core/rays/cell_look.h"
#include "core/rays/cell_raster.h"

namespace voledit {

/// Finds the affine pieces of stretches of rays by halving these until their middles fall, to a tenth of a voxel, where
/// their ends say, or they are an eighth of a step long and are left out. Ends and middles are mapped exactly, those of
/// a whole tile together.
class RaggedPieces {
public:
    struct Piece {
        std::uint32_t pixel;
        float begin, end;  // steps
    };

    /// Forgets all pieces.
    void clear();
    /// Appends the stretch of a pixel's ray, which passes base + u · along, from the origin of `look`'s cells.
    void add(const Piece& stretch, const std::array<float, 3>& base, const std::array<float, 3>& along);
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
        Vec3 base, along;
    };

    Vec3 placeOn(const CellLook& look, const Stretch& stretch, double part) const;
    void mapEnds(const CellLook& look);
    void mapMiddles(const CellLook& look);
    void halve(const CellLook& look);
    void keep(const CellLook& look, const Stretch& stretch);
    void turn(const CellLook& look);

    std::vector<Ray> rays_;
    std::vector<Stretch> open_, next_;
    std::vector<Piece> pieces_;
    std::vector<OwnPiece> maps_;
    std::vector<Vec3> middles_;  // of the pieces, in the space of the deformed cells
    std::vector<Vec3> points_;
    std::vector<GradientTurn> turns_;
};

}  // namespace voledit
