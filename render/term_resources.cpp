#include "render/term_resources.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/stf/mesh_field.h"
#include "render/cell_buffers.h"
#include "render/term_tables.h"

namespace voledit {

namespace {

GLint limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void check(bool fits, const std::string& what) {
    if (!fits) throw Error("OpenGL", "the driver cannot hold " + what, "use --renderer rays");
}

std::shared_ptr<const void> identityOf(const ProgramCells& cells) {
    if (cells.map) return cells.map;
    return cells.mesh;
}

/// Where vertices lead; points less `origin`.
std::vector<CellArrays::Vertex> verticesOf(const ProgramCells& of, const Vec3& origin) {
    const MappedCells& cells = of.cells();
    std::vector<CellArrays::Vertex> vertices(cells.source().size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (of.map) {
            vertices[v] = {Vec3f(cells.source()[v] - origin), Mat3f(cells.jacobians()[v])};
            continue;
        }
        const Mesh& mesh = *of.mesh->mesh();
        const float value = mesh.values()[v * std::size_t(mesh.channels()) + std::size_t(of.mesh->channel())];
        const Vec3f gradient(of.mesh->vertexGradients()[v]);
        vertices[v] = {Vec3f(value, gradient.x, gradient.y), Mat3f(0)};
        vertices[v].jacobian[0].x = gradient.z;
    }
    return vertices;
}

}  // namespace

void TermResources::prepare(TermProgram program) {
    check(program.volumes.size() + 1 <= std::size_t(limit(GL_MAX_TEXTURE_IMAGE_UNITS)), "so many volumes at once");
    check(program.numbers.size() * sizeof(float) <= std::size_t(limit(GL_MAX_UNIFORM_BLOCK_SIZE)), "so many numbers");
    check(program.tables.size() <= std::size_t(limit(GL_MAX_ARRAY_TEXTURE_LAYERS)), "so many tables");
    program_ = std::move(program);
    prepareVolumes();
    prepareTables();
    prepareCells();
    fill(numbers_, std::span<const float>(program_->numbers), GL_STATIC_DRAW);
}

void TermResources::setGroup(int group, const Vec4& numbers) {
    for (int n = 0; n < 4; ++n) program_->numbers[std::size_t(4 * group + n)] = float(numbers[n]);
}

void TermResources::setMatrix(int group, const Mat4& m) {
    for (int row = 0; row < 3; ++row) setGroup(group + row, {m[0][row], m[1][row], m[2][row], m[3][row]});
}

void TermResources::prepareVolumes() {
    const auto wanted = [&](const Volumes& kept) {
        const auto source = kept.source.lock();
        return source && std::any_of(program_->volumes.begin(), program_->volumes.end(), [&](const ProgramVolume& v) {
                   return v.volume == source && v.channel == kept.channel;
               });
    };
    // What is not needed goes first, so that old and new ones never need to fit together.
    volumes_.erase(std::remove_if(volumes_.begin(), volumes_.end(), [&](const Volumes& v) { return !wanted(v); }),
                   volumes_.end());
    std::vector<Volumes> made;
    for (const ProgramVolume& volume : program_->volumes) {
        const auto kept = std::find_if(volumes_.begin(), volumes_.end(), [&](const Volumes& v) {
            return v.source.lock() == volume.volume && v.channel == volume.channel;
        });
        if (kept != volumes_.end())
            made.push_back(std::move(*kept));
        else
            made.push_back({volume.volume, volume.channel, makeVolumeTexture(*volume.volume, volume.channel)});
        setGroup(volume.scale, {made.back().texture.valueScale, made.back().texture.valueOffset, 0, 0});
    }
    volumes_ = std::move(made);
}

void TermResources::prepareTables() {
    if (tables_ == program_->tables && tableTexture_) return;
    const int rows = std::max(int(program_->tables.size()), 1);
    std::vector<float> entries;
    for (const ProgramTable& table : program_->tables) {
        const std::vector<float> row = entriesOf(table);
        entries.insert(entries.end(), row.begin(), row.end());
    }
    entries.resize(std::size_t(rows) * kTableEntries * 4);
    tableTexture_ = makeTables(kTableEntries, rows, entries);
    tables_ = program_->tables;
}

void TermResources::prepareCells() {
    const std::vector<ProgramCells>& wanted = program_->cells;
    bool same = cells_.size() == wanted.size() && cellsOrigin_ == program_->origin;
    for (std::size_t c = 0; same && c < cells_.size(); ++c) same = cells_[c].lock() == identityOf(wanted[c]);
    if (!same) {
        cells_.clear();
        gridFromDeformed_.clear();
        CellArrays arrays;
        for (const ProgramCells& of : wanted) {
            const CellGrid grid = gridOver(of.cells());
            const Index3& r = grid.resolution;
            arrays.maps.push_back({Mat4f(1), {r.x, r.y, r.z, std::int32_t(arrays.cells.size())}, {}});
            appendCells(of.cells(), grid, arrays);
            appendVertices(of.cells(), verticesOf(of, program_->origin), arrays);
            gridFromDeformed_.push_back(grid.gridFromDeformed);
        }
        cellBuffers_ = cellBuffers(arrays);
        for (const ProgramCells& of : wanted) cells_.push_back(identityOf(of));
        cellsOrigin_ = program_->origin;
    }
    for (std::size_t c = 0; c < wanted.size(); ++c)
        setMatrix(wanted[c].grid, gridFromDeformed_[c] * glm::translate(Mat4(1), program_->origin));
}

void TermResources::bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, numbers_.name());
    glBindTextureUnit(0, tableTexture_.name());
    for (std::size_t v = 0; v < volumes_.size(); ++v)
        glBindTextureUnit(GLuint(v + 1), volumes_[v].texture.texture.name());
    if (!cells_.empty()) bindCells(cellBuffers_);
}

}  // namespace voledit
