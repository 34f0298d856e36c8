#pragma once
// A compiled term as GLSL: one generated function for each node, and what those functions read.

#include <memory>
#include <string>
#include <vector>

#include "core/objects/term.h"

namespace voledit {

/// A channel of a volume as a 3-D texture; `scale` is the group of numbers that holds value = raw · x + y.
struct ProgramVolume {
    std::shared_ptr<const Volume> volume;
    int channel = 0;
    int scale = 0;
};

/// A piecewise-linear table: a row of the tables' texture (term_tables.h).
struct ProgramTable {
    ColorTable color;
    PiecewiseLinear value;
    double low = 0, high = 1;  // what its first and last entry stand for
    bool operator==(const ProgramTable&) const = default;
};

/// Mapped cells to locate points in, of a forward map or of a mesh. `grid` is the first of three groups of numbers:
/// the arrays' grid coordinates of a point (cell_arrays.h).
struct ProgramCells {
    TransferPtr map;                        // or null
    std::shared_ptr<const MeshField> mesh;  // or null
    int grid = 0;

    const MappedCells& cells() const;
};

/// GLSL functions for any term, joined from its nodes' (shaders/term has what is written by hand). Points are world
/// points less `origin`, in every space of the term, so that single precision is relative to where the object stands.
/// The text depends on the term's structure only: which nodes there are, what their formulas look like. Numbers come in
/// `numbers`, so a parameter that changes compiles nothing.
struct TermProgram {
    TermPtr root;
    Vec3 origin{0};
    /// `Sample termAt(vec3 p)` with colour and opacity, `Sample litTermAt(vec3 p)` with the gradient too,
    /// `bool withinTermAt(vec3 p)`, whether data are there, and `void startHints()`, to be called first; and what they
    /// need, samplers too.
    std::string text;
    std::vector<float> numbers;          // groups of four, as term/numbers.glsl reads them
    std::vector<ProgramVolume> volumes;  // texture units 1, 2, …
    std::vector<ProgramTable> tables;    // texture unit 0
    std::vector<ProgramCells> cells;
    std::size_t size = 0;  // statements when all is put in place, as compilers do

    /// What a program that includes `text` must define.
    std::vector<std::string> defines() const;
};

/// How large programs may be, so that compiling takes seconds at most (README.md).
inline constexpr std::size_t kLargestTermProgram = 4000;
/// Levels of terms, maps and fields below each other.
inline constexpr int kDeepestTermProgram = 100;

/// Throws Error, which says to use rays, for a term that is too large.
TermProgram makeTermProgram(const TermPtr& root);

}  // namespace voledit
