#pragma once
// What slices need of a scene on the GPU and the CPU, kept between pictures.

#include <memory>
#include <optional>

#include "render/cell_mesh.h"
#include "render/gl_objects.h"
#include "render/located_maps.h"
#include "render/slice_plan.h"
#include "render/transfer_table.h"
#include "render/visibility.h"
#include "render/volume_texture.h"

namespace voledit {

/// What is left out of the cells, and how far slabs reach.
struct CullRequest {
    bool bricks = true, cells = true;  // leave out what cannot be seen
    double slab = 0;                   // extent of a slab along a ray at most, world units
    bool separate = false;             // cells whose fragments are complete become a mesh of their own

    bool operator==(const CullRequest&) const = default;
};

/// Textures, tables, visibility and cells of the term drawn last. `prepare` makes anew only what differs: volumes and
/// maps are compared by identity, transfer functions and matrices by value.
class SliceResources {
public:
    void prepare(const SlicePlan& plan, const CullRequest& cull);
    /// The volume's texture alone, for those that need no more: `volume()`, `bindVolume()`.
    void prepareTexture(const VolumeTerm& term);

    const VolumeTexture& volume() const { return volume_->texture; }
    const TransferTable& table() const { return table_->table; }
    const Visibility& visibility() const { return *visibility_; }
    /// From the source space of the outermost forward map (the world, without one) to what the cells carry: index
    /// coordinates, or the grid coordinates of the first located map.
    Mat4 entryFromSource() const { return located_ ? located_->entryFromSource : mesh_->indexFromSource; }
    /// From each located map's source space on (LocatedMaps::nextFromSource).
    std::span<const Mat4> nextFromSource() const {
        return located_ ? std::span<const Mat4>(located_->nextFromSource) : std::span<const Mat4>();
    }
    /// The outermost forward map's cells; without one, the volume's bricks.
    const CellMesh& mesh() const { return mesh_->mesh; }
    /// Those of the cells that overlap no other and are not nearly flat, where `CullRequest::separate` asked; `mesh`
    /// then holds the others.
    const CellMesh* alone() const { return mesh_->alone ? &*mesh_->alone : nullptr; }
    /// Bricks of the operand where it stands, for a map that keeps what is outside its cells; else null.
    const CellMesh* uncovered() const { return mesh_->uncovered ? &*mesh_->uncovered : nullptr; }
    /// Binds the volume and the tables to texture units 0…3: volume, thickness, colour, gradient factor; located maps
    /// to the storage buffers of shaders/common/located.glsl.
    void bind() const;
    /// The volume alone, to unit 0.
    void bindVolume() const;

private:
    struct Volumes {
        std::weak_ptr<const Volume> source;
        int channel;
        VolumeTexture texture;
        std::optional<ValueBricks> bricks = {};  // and the range of their values; both of slices only
        std::pair<double, double> range = {};
    };
    struct Tables {
        TransferFunction source;
        double min, max;
        TransferTable table;
        Texture thickness, color, gradient;
    };
    struct Located {
        std::vector<std::weak_ptr<const SpatialTransferFunction>> sources;
        std::vector<Mat4> affine;  // between them, and after the last
        Mat4 entryFromSource;
        std::vector<Mat4> nextFromSource;
        std::array<Buffer, 5> buffers;
    };
    struct Meshes {
        std::weak_ptr<const SpatialTransferFunction> source;
        bool mapped;
        Mat4 worldFromDeformed, indexFromSource;
        CullRequest cull;
        CellMesh mesh;
        std::optional<CellMesh> uncovered, alone;
    };

    void prepareBricks(const VolumeTerm& term);
    void prepareTable(const TransferFunction& function);
    void prepareLocated(const SlicePlan& plan);
    bool holdsLocated(const SlicePlan& plan) const;
    CellMesh cellsOf(const SlicePlan& plan, const CullRequest& cull, const std::vector<char>& wanted) const;
    CellMesh uncoveredOf(const SlicePlan& plan, const CullRequest& cull) const;
    void prepareMesh(const SlicePlan& plan, const CullRequest& cull);

    std::optional<Volumes> volume_;
    std::optional<Tables> table_;
    std::optional<Visibility> visibility_;  // of volume_ and table_
    std::optional<Located> located_;
    std::optional<Meshes> mesh_;  // of visibility_ and located_
};

}  // namespace voledit
