#pragma once
// A deformed volume made ready for packets of rays.

#include <memory>
#include <vector>

#include "core/rays/packet_cells.h"
#include "core/rays/volume_look.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

class MappedCells;

/// What leads from a picture's rays to a volume under maps.
struct CellWay {
    TermPtr term;                 // the outermost map's transfer, whose space is that of the deformed cells
    Mat4 cellsFromWorld{1.0};     // from the root's space
    std::vector<TransferPtr> by;  // the maps, the outermost first
    Mat4 indexFromRest{1.0};      // from what the last map gives to the volume's index space

    bool operator==(const CellWay&) const = default;

    /// Whether the only map is mapped cells and nothing shows outside: then those are the cells.
    bool isMappedCells() const;
    /// The outermost map's cells, where nothing shows outside them and they are hexahedra: they lead to the inner maps.
    /// Null: all maps are inner ones.
    const MappedCells* outerCells() const;
    /// x[n] = index space of q[n], which the inner maps go on from; kUndefined where one of them is. Sizes must be
    /// equal; may alias.
    void toIndex(std::span<const Vec3> q, std::span<Vec3> x) const;
    /// turn[n] = what turns gradients where the inner maps go on from q[n] and dq/dp = outer[n] (none: the identity).
    /// Sizes must be equal.
    void turns(std::span<const Vec3> q, std::span<const Mat3> outer, std::span<GradientTurn> turn) const;
    /// What turns gradients where the maps' Jacobian is `jacobian`.
    GradientTurn turnOf(const Mat3& jacobian) const;
};

/// Immutable; holds what can be seen of `look` on `way`.
struct CellLook {
    CellWay way;
    std::shared_ptr<const VolumeLook> look;
    bool turned = false;  // whether gradients' turns are known
    bool rough = false;   // whether maps are followed less closely than pictures at rest ask for
    std::shared_ptr<const PacketCells> packed;

    const PacketCells& cells() const { return *packed; }
};

/// What a picture asks of a look.
struct CellWish {
    bool turned = false;  // it is shaded
    bool rough = false;   // something moves: a fast edit counts for more than the tenth of a voxel
};

/// The look on `way`; `previous` (may be null) if that is it, and with its cells where only the step changed. In
/// parallel; some 2 ms for 16³ mapped cells.
std::shared_ptr<const CellLook> cellLook(const CellWay& way, std::shared_ptr<const VolumeLook> look, CellWish wish,
                                         const std::shared_ptr<const CellLook>& previous);

}  // namespace voledit
