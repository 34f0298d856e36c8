#pragma once
// From a VoxelType at run time to a C++ type at compile time.

#include <cassert>
#include <cstdint>
#include <utility>

#include "core/fields/volume.h"

namespace voledit {

/// Calls `body` with a value of the C++ type that `type` names (its value says nothing: use decltype), so that one
/// generic lambda gives a loop for each type.
template <class Body>
decltype(auto) withVoxelType(VoxelType type, Body&& body) {
    switch (type) {
        case VoxelType::Int8:
            return body(std::int8_t{});
        case VoxelType::UInt8:
            return body(std::uint8_t{});
        case VoxelType::Int16:
            return body(std::int16_t{});
        case VoxelType::UInt16:
            return body(std::uint16_t{});
        case VoxelType::Int32:
            return body(std::int32_t{});
        case VoxelType::UInt32:
            return body(std::uint32_t{});
        case VoxelType::Float:
            return body(float{});
        case VoxelType::Double:
            break;
    }
    assert(type == VoxelType::Double);
    return body(double{});
}

/// The VoxelType of a C++ type.
template <class T>
constexpr VoxelType voxelTypeFor();
template <>
constexpr VoxelType voxelTypeFor<std::int8_t>() {
    return VoxelType::Int8;
}
template <>
constexpr VoxelType voxelTypeFor<std::uint8_t>() {
    return VoxelType::UInt8;
}
template <>
constexpr VoxelType voxelTypeFor<std::int16_t>() {
    return VoxelType::Int16;
}
template <>
constexpr VoxelType voxelTypeFor<std::uint16_t>() {
    return VoxelType::UInt16;
}
template <>
constexpr VoxelType voxelTypeFor<std::int32_t>() {
    return VoxelType::Int32;
}
template <>
constexpr VoxelType voxelTypeFor<std::uint32_t>() {
    return VoxelType::UInt32;
}
template <>
constexpr VoxelType voxelTypeFor<float>() {
    return VoxelType::Float;
}
template <>
constexpr VoxelType voxelTypeFor<double>() {
    return VoxelType::Double;
}

}  // namespace voledit
