#pragma once
// Tetrahedral meshes and curvilinear grids: values at vertices, barycentric interpolation between (definitions.md §2).

#include "core/fields/mesh_data.h"
#include "core/fields/scalar_field.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

/// A mesh and the values of its vertices, in the file's physical space. Its cells' `source` equals `deformed`.
class Mesh {
public:
    /// Throws Error as MappedCells does, and where values are missing. Values that are not finite
    /// become NaN: the field is undefined in the tetrahedra about them.
    explicit Mesh(MeshData data);

    const MappedCells& cells() const { return cells_; }
    std::span<const float> values() const { return values_; }
    int channels() const { return channels_; }
    /// Smallest and largest finite value of a channel; from infinity to −infinity where there is none.
    Interval range(int channel) const;

private:
    MappedCells cells_;
    std::vector<float> values_;
    int channels_;
    std::vector<Interval> ranges_;
};

/// One channel of a mesh: within a tetrahedron the value is affine; where cells overlap, the first counts; NaN outside.
/// The gradient is constant in a tetrahedron; at a point it is interpolated from the vertices, each having the mean
/// of the tetrahedra about it by their volumes, so that shading shows no facets.
class MeshField final : public ScalarField {
public:
    /// Throws Error for a channel that the mesh does not have.
    MeshField(std::shared_ptr<const Mesh> mesh, int channel);
    const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
    int channel() const { return channel_; }
    /// One for each vertex.
    std::span<const Vec3> vertexGradients() const { return gradients_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    /// Over the vertices of the tetrahedra that may reach into `box`; from infinity to −infinity where none does.
    Interval range(const Box3& box) const override;
    Box3 domain() const override { return mesh_->cells().bounds(); }
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    double valueOf(std::uint32_t vertex) const;
    /// Calls visit(i, vertices of the tetrahedron of p[i] or null, weights).
    template <class Visit>
    void forLocated(std::span<const Vec3> p, const Visit& visit) const;

    std::shared_ptr<const Mesh> mesh_;
    int channel_;
    std::vector<Vec3> gradients_;
};

}  // namespace voledit
