#pragma once
// Terms by hand.

#include "core/objects/solid_shapes.h"
#include "core/objects/term.h"
#include "core/stf/transfer_definition.h"

namespace voledit::test {

TermPtr solid(const SolidShape& shape, const Vec3& color, double falloff = 0, const std::string& opacity = "0.8");
/// A formula over x, y, z.
FieldPtr expression(const std::string& formula);
TermPtr through(const TransferPtr& map, const TermPtr& of, Combine combine = Combine::Union);
/// A transfer of the library over `box`; what is not given is as its file suggests.
TransferPtr library(const std::string& name, const Box3& box,
                    const std::map<std::string, TransferArgument>& arguments = {}, double amount = 1);
inline TransferArgument number(double value) {
    return std::vector<double>{value};
}
inline TransferArgument axis(int a) {
    return std::vector<int>{a};
}

}  // namespace voledit::test
