#pragma once
// Letters as a solid: signed distances from the outlines of a font.

#include <string>

#include "core/fields/scalar_field.h"
#include "core/fields/volume.h"

namespace voledit {

/// Signed distance, world units, negative inside, of a line of text that stands in the x–z plane: letters advance along
/// +x from x = 0, capitals stand on z = 0 and are `height` tall, the extrusion is y from −depth/2 to depth/2. The
/// distance to the outlines is tabulated on a fine grid over x and z (exact at its samples) and joined with the
/// extrusion: with d₂ the distance in the plane and e = |y| − depth/2, min(max(d₂, e), 0) + length(max(d₂, 0),
/// max(e, 0)). Beyond the grid the distance to the grid is added.
class TextField final : public ScalarField {
public:
    /// `text` in UTF-8, one line. Throws Error where no font is found, a character is missing, the text is empty or
    /// longer than 200 characters, or a size is not positive.
    TextField(const std::string& text, double height, double depth);

    /// The table: samples along x (i) and z (k), one along y; float.
    const std::shared_ptr<const Volume>& outline() const { return outline_; }
    double depth() const { return depth_; }
    /// Box of the letters.
    const Box3& bounds() const { return bounds_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    std::shared_ptr<const Volume> outline_;
    double depth_ = 1;
    Box3 bounds_;
};

}  // namespace voledit
