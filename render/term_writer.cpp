#include "render/term_writer.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/stf/mesh_field.h"
#include "render/term_tables.h"

namespace voledit {

namespace {

[[noreturn]] void tooLarge(const std::string& what) {
    throw Error("scene", what, "use --renderer rays");
}

std::size_t statements(const std::string& text) {
    return std::size_t(std::count(text.begin(), text.end(), ';'));
}

}  // namespace

const MappedCells& ProgramCells::cells() const {
    return map ? *map->cells() : mesh->mesh()->cells();
}

std::vector<std::string> TermProgram::defines() const {
    std::vector<std::string> names{"TERM_QUADS=" + std::to_string(numbers.size() / 4)};
    if (!cells.empty()) names.push_back("TERM_CELLS");
    return names;
}

GlslBody& GlslBody::operator<<(const std::string& line) {
    text_ += "    " + line + "\n";
    size_ += statements(line);
    return *this;
}

std::string GlslBody::call(const GlslFunction& function) {
    size_ += function.size;
    return function.name;
}

TermWriter::TermWriter(const TermPtr& root) {
    program_.root = root;
    program_.origin = root->bounds.empty() ? Vec3(0) : root->bounds.center();
    for (int a = 0; a < 3; ++a)
        if (!std::isfinite(program_.origin[a])) tooLarge("the object has no bounds");
}

GlslFunction TermWriter::function(const NodeKey& key, const std::string& signature,
                                  const std::function<void(GlslBody&)>& write) {
    const auto known = written_.find(key);
    if (known != written_.end()) return known->second;
    if (++depth_ > kDeepestTermProgram)
        tooLarge("objects lie more than " + std::to_string(kDeepestTermProgram) + " levels below each other");
    GlslBody body;
    write(body);
    --depth_;
    const GlslFunction made{"f" + std::to_string(named_++), body.size()};
    if (made.size > kLargestTermProgram) tooLarge("the object is too complex for slices");
    std::string head = signature;
    head.replace(head.find("NAME"), 4, made.name);
    functions_ += head + " {\n" + body.text() + "}\n";
    return written_[key] = made;
}

GlslFunction TermWriter::formula(const FormulaGraph& graph, std::span<const double> parameters, int& base) {
    std::vector<double> uniforms = graph.glslUniforms(parameters);
    base = int(program_.numbers.size());
    for (const double number : uniforms) program_.numbers.push_back(float(number));
    program_.numbers.resize((program_.numbers.size() + 3) / 4 * 4);

    const FormulaGlsl glsl = graph.glsl("NAME");
    const auto known = formulaOf_.find(glsl.text);
    if (known != formulaOf_.end()) return known->second;
    const GlslFunction made{"formula" + std::to_string(formulaOf_.size()), statements(glsl.text)};
    if (made.size > kLargestTermProgram) tooLarge("a formula is too complex for slices");
    formulas_ += graph.glsl(made.name).text;
    return formulaOf_[glsl.text] = made;
}

int TermWriter::group(const Vec4& numbers) {
    const int at = int(program_.numbers.size() / 4);
    for (int n = 0; n < 4; ++n) program_.numbers.push_back(float(numbers[n]));
    return at;
}

int TermWriter::matrix(const Mat4& m) {
    const int at = group({m[0][0], m[1][0], m[2][0], m[3][0]});
    group({m[0][1], m[1][1], m[2][1], m[3][1]});
    group({m[0][2], m[1][2], m[2][2], m[3][2]});
    return at;
}

int TermWriter::box(const Box3& box) {
    const int at = group(box.min - program_.origin);
    group(box.max - program_.origin);
    return at;
}

int TermWriter::origin() {
    if (origin_ < 0) origin_ = group(program_.origin);
    return origin_;
}

Mat4 TermWriter::fromLocal(const Mat4& m) const {
    return m * glm::translate(Mat4(1), program_.origin);
}

Mat4 TermWriter::toLocal(const Mat4& m) const {
    return glm::translate(Mat4(1), -program_.origin) * m;
}

std::string TermWriter::volume(const std::shared_ptr<const Volume>& volume, int channel, int& scale) {
    std::vector<ProgramVolume>& volumes = program_.volumes;
    auto at = std::find_if(volumes.begin(), volumes.end(), [&](const ProgramVolume& known) {
        return known.volume == volume && known.channel == channel;
    });
    if (at == volumes.end()) {
        volumes.push_back({volume, channel, group(Vec4(0))});
        at = volumes.end() - 1;
    }
    scale = at->scale;
    return "volume" + std::to_string(at - volumes.begin());
}

int TermWriter::table(ColorTable color, PiecewiseLinear value, std::optional<Interval> range) {
    ProgramTable made{std::move(color), std::move(value), 0, 1};
    setRange(made, range);
    program_.tables.push_back(std::move(made));
    const ProgramTable& table = program_.tables.back();
    const double scale = (kTableEntries - 1) / (table.high - table.low);
    return group({scale, -table.low * scale, double(program_.tables.size() - 1), 0});
}

TermWriter::Cells TermWriter::cells(const void* key, const ProgramCells& made) {
    const auto [at, isNew] = cellsOf_.try_emplace({key, made.mesh != nullptr}, int(program_.cells.size()));
    if (isNew) {
        program_.cells.push_back(made);
        program_.cells.back().grid = matrix(Mat4(1));
    }
    const auto number = std::size_t(at->second);
    return {std::to_string(number) + ", " + std::to_string(program_.cells[number].grid),
            "hint" + std::to_string(number)};
}

TermWriter::Cells TermWriter::cells(const TransferPtr& map) {
    return cells(map.get(), {map, nullptr, 0});
}

TermWriter::Cells TermWriter::cells(const std::shared_ptr<const MeshField>& mesh) {
    return cells(mesh.get(), {nullptr, mesh, 0});
}

TermProgram TermWriter::finish(const GlslFunction& term, const GlslFunction& lit, const GlslFunction& within) {
    std::string head, hints = "void startHints() {\n";
    for (std::size_t v = 0; v < program_.volumes.size(); ++v)
        head += "layout(binding = " + std::to_string(v + 1) + ") uniform sampler3D volume" + std::to_string(v) + ";\n";
    for (std::size_t c = 0; c < program_.cells.size(); ++c) {
        head += "uint hint" + std::to_string(c) + ";\n";
        hints += "    hint" + std::to_string(c) + " = kNowhere;\n";
    }
    program_.text = head + formulas_ + functions_ + hints + "}\nSample termAt(vec3 p) {\n    return " + term.name +
                    "(p);\n}\nSample litTermAt(vec3 p) {\n    return " + lit.name +
                    "(p);\n}\nbool withinTermAt(vec3 p) {\n    return " + within.name + "(p);\n}\n";
    program_.size = term.size + lit.size + within.size;
    if (program_.size > kLargestTermProgram) tooLarge("the object is too complex for slices");
    if (program_.numbers.empty()) group(Vec4(0));
    return std::move(program_);
}

TermProgram makeTermProgram(const TermPtr& root) {
    TermWriter writer(root);
    const GlslFunction term = writeTerm(writer, root, false), lit = writeTerm(writer, root, true),
                       within = writeWithin(writer, root);
    return writer.finish(term, lit, within);
}

}  // namespace voledit
