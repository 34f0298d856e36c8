#pragma once
// From a StoredType at run time to a C++ type at compile time.

#include "app/io/stored_volume.h"
#include "core/fields/voxel_type.h"

namespace voledit {

/// As `withVoxelType`, for the types that files have.
template <class Body>
decltype(auto) withStoredType(StoredType type, Body&& body) {
    if (type == StoredType::Int64) return body(std::int64_t{});
    if (type == StoredType::UInt64) return body(std::uint64_t{});
    return withVoxelType(VoxelType(type), std::forward<Body>(body));
}

}  // namespace voledit
