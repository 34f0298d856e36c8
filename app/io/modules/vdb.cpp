#include "app/io/modules/vdb.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <cmath>

#include "app/io/checks.h"
#include "core/base/error.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;  // x fastest, as ours

/// Float grids by name, in the file's order; the rest of the file is left alone.
std::vector<openvdb::FloatGrid::Ptr> floatGrids(const Source& source, VolumeSink& sink) {
    openvdb::io::File file(source.path.string());
    file.open(false);  // delayed loading would copy the file to a temporary one
    std::vector<openvdb::FloatGrid::Ptr> grids;
    std::string others;
    const auto all = file.readAllGridMetadata();
    for (const auto& grid : *all) {
        const bool channel = !grids.empty() && grid->getName() == "channel" + std::to_string(grids.size()) &&
                             grids.front()->getName() == "channel0";
        if (!grid->isType<openvdb::FloatGrid>() || !(grids.empty() || channel)) {
            others += (others.empty() ? "" : ", ") + inQuotes(grid->getName()) + " (" + grid->valueType() + ")";
            continue;
        }
        grids.push_back(openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(grid->getName())));
    }
    if (grids.empty())
        throw Error(source.name, "holds no float grid" + (others.empty() ? "" : ", only " + others),
                    "save it with a float grid");
    if (!others.empty())
        sink.warn(source.name + ": holds other grids too: " + others + "; " + inQuotes(grids[0]->getName()) +
                  " was read");
    return grids;
}

/// LPS from the index space of `grid`, whose index `low` becomes (0, 0, 0).
Mat4 worldFromIndex(const Source& source, const openvdb::FloatGrid& grid, const openvdb::Coord& low) {
    if (!grid.transform().isLinear())
        throw Error(source.name, "its grid lies in a frustum, which is not read", "save it with a linear transform");
    const openvdb::Mat4R m = grid.transform().baseMap()->getAffineMap()->getMat4();  // of row vectors
    Mat4 world(1);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) world[c][r] = m(c, r);
    world[3] = world * Vec4(low.x(), low.y(), low.z(), 1);
    return world;
}

VolumeHeader headerOf(const Source& source, const std::vector<openvdb::FloatGrid::Ptr>& grids,
                      openvdb::CoordBBox& box) {
    openvdb::Index64 active = 0;
    for (const auto& grid : grids) {
        box.expand(grid->evalActiveVoxelBoundingBox());
        active = std::max(active, grid->activeVoxelCount());
        if (grid->transform() != grids.front()->transform())
            throw Error(source.name, "its channels lie in different places", "save them as one");
    }
    if (active == 0) throw Error(source.name, "its grid has no active voxels", "save a grid with values");
    VolumeHeader header;
    std::array<std::uint64_t, 3> size;
    for (int a = 0; a < 3; ++a) {
        size[std::size_t(a)] = std::uint64_t(std::int64_t(box.max()[a]) - std::int64_t(box.min()[a]) + 1);
        header.grid.size[a] = int(size[std::size_t(a)]);
    }
    checkSizes(source.name, size, grids.size());
    // A few stray voxels must not fill the memory with background.
    const double voxels = double(size[0]) * double(size[1]) * double(size[2]);
    if (voxels > 256e6 && double(active) < 1e-4 * voxels)
        throw Error(source.name,
                    "its few active voxels are scattered over a box of " + std::to_string(size[0]) + "x" +
                        std::to_string(size[1]) + "x" + std::to_string(size[2]),
                    "prune or crop the grid");
    header.grid.channels = int(grids.size());
    header.grid.worldFromIndex = worldFromIndex(source, *grids.front(), box.min());
    checkAffine(source.name, header.grid.worldFromIndex);
    header.type = VoxelType::Float;
    header.format = "vdb";
    header.storedType = grids.front()->saveFloatAsHalf() ? "half" : "float";
    return header;
}

/// The volume's channel as floats, x fastest.
std::vector<float> channelOf(const VolumeOutput& volume, int channel) {
    const std::size_t count = volume.grid.sampleCount(), step = std::size_t(volume.grid.channels);
    std::vector<float> values(count);
    withVoxelType(volume.type, [&](auto t) {
        const auto* in = reinterpret_cast<const decltype(t)*>(volume.voxels.data()) + channel;
        for (std::size_t i = 0; i < count; ++i) values[i] = float(in[i * step]);
    });
    return values;
}

openvdb::Coord coordOf(Index3 size, std::size_t sample) {
    const std::size_t nx = std::size_t(size.x), ny = std::size_t(size.y);
    return {int(sample % nx), int(sample / nx % ny), int(sample / nx / ny)};
}

openvdb::FloatGrid::Ptr gridOf(const VolumeOutput& volume, int channel) {
    const Index3 n = volume.grid.size;
    const openvdb::CoordBBox box(openvdb::Coord(0), openvdb::Coord(n.x - 1, n.y - 1, n.z - 1));
    std::vector<float> values = channelOf(volume, channel);
    const auto grid = openvdb::FloatGrid::create(0.0f);
    openvdb::tools::copyFromDense(Dense(box, values.data()), *grid, 0.0f);
    // copyFromDense takes what is not a number for background.
    auto accessor = grid->getAccessor();
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isnan(values[i])) accessor.setValueOn(coordOf(n, i), values[i]);
    grid->tree().setValueOn(box.min());
    grid->tree().setValueOn(box.max());
    openvdb::Mat4R m = openvdb::Mat4R::identity();
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) m(c, r) = volume.grid.worldFromIndex[c][r];
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setName(volume.grid.channels == 1 ? "density" : "channel" + std::to_string(channel));
    return grid;
}

}  // namespace

void voleditReadVdb(const Source& source, VolumeSink& sink) {
    openvdb::initialize();
    const auto grids = floatGrids(source, sink);
    openvdb::CoordBBox box;
    const VolumeHeader header = headerOf(source, grids, box);
    auto* voxels = reinterpret_cast<float*>(sink.allocate(source.name, header).data());
    sink.progress(0.5);
    if (grids.size() == 1) {
        Dense dense(box, voxels);
        openvdb::tools::copyToDense(*grids.front(), dense);
        return;
    }
    std::vector<float> plane(header.grid.sampleCount());
    for (std::size_t c = 0; c < grids.size(); ++c) {
        Dense dense(box, plane.data());
        openvdb::tools::copyToDense(*grids[c], dense);
        for (std::size_t i = 0; i < plane.size(); ++i) voxels[i * grids.size() + c] = plane[i];
        sink.progress(0.5 + 0.5 * double(c + 1) / double(grids.size()));
    }
}

void voleditWriteVdb(const VolumeOutput& volume) {
    openvdb::initialize();
    openvdb::GridPtrVec grids;
    for (int c = 0; c < volume.grid.channels; ++c) {
        grids.push_back(gridOf(volume, c));
        volume.progress(0.8 * double(c + 1) / double(volume.grid.channels));
    }
    openvdb::io::File file(volume.target.path.string());
    file.write(grids);
    file.close();
}

}  // namespace voledit
