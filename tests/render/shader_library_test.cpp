#include "render/shader_library.h"

#include <gmock/gmock.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "render/slice_variants.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using testing::HasSubstr;
using namespace test;

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

std::string errorOf(const std::filesystem::path& folder, const ProgramVariant& variant) {
    ShaderLibrary library(folder);
    try {
        library.get(variant);
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

TEST(ShaderLibrary, EveryProgramAndVariantCompiles) {
    offscreen();
    ShaderLibrary library(shaderFolder());
    const auto programs = allPrograms();
    EXPECT_GT(programs.size(), 8u);
    for (const ProgramVariant& variant : programs) EXPECT_NO_THROW(library.get(variant)) << variant.fragment;
    // Those of terms, with and without cells.
    const TermPtr plain = solid(SphereShape{}, Vec3(1)), bent = through(foldedLattice(plain->bounds), plain);
    for (const TermPtr& term : {plain, bent}) {
        const TermProgram made = makeTermProgram(term);
        for (const bool mapped : {false, true})
            for (const bool shaded : {false, true}) {
                EXPECT_NO_THROW(library.get(termVariant(made, mapped, shaded)));
                EXPECT_NO_THROW(library.get(withSurroundings(termVariant(made, mapped, shaded))));
            }
        EXPECT_NO_THROW(library.get({"fullscreen.vert", "term_probe.frag", made.defines(), made.text}));
    }
}

TEST(ShaderLibrary, ErrorsNameFileAndLineOfIncludedFiles) {
    offscreen();
    const auto folder = scratchFolder();
    write(folder / "a.vert", "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n");
    write(folder / "part.glsl", "float one() { return 1.0; }\nfloat bad() { return nothing; }\n");
    write(folder / "a.frag",
          "#version 450 core\n#include \"part.glsl\"\nout vec4 c;\nvoid main() { c = vec4(one()); }\n");
    EXPECT_THAT(errorOf(folder, {"a.vert", "a.frag", {"X", "Y=2"}}), HasSubstr("part.glsl:2"));
    write(folder / "part.glsl", "float one() { return 1.0; }\n");
    EXPECT_EQ(errorOf(folder, {"a.vert", "a.frag", {}}), "");
    write(folder / "a.frag",
          "#version 450 core\n#include \"part.glsl\"\nout vec4 c;\nvoid main() { c = vec4(two()); }\n");
    EXPECT_THAT(errorOf(folder, {"a.vert", "a.frag", {"X", "Y=2"}}), HasSubstr("a.frag:4"));
}

TEST(ShaderLibrary, DefinesReachIncludedFiles) {
    const auto folder = scratchFolder();
    write(folder / "b.frag", "#version 450 core\n#include \"c.glsl\"\n#include \"c.glsl\"\n");
    write(folder / "c.glsl", "int twice;\n");
    const ShaderSource source = loadShader(folder, "b.frag", {"A", "N=3"});
    EXPECT_THAT(source.text, HasSubstr("#define A 1\n#define N 3\n"));
    EXPECT_EQ(source.text.find("int twice"), source.text.rfind("int twice"));
}

TEST(ShaderLibrary, GeneratedTextIsPutInPlaceAndTheOldestGoes) {
    offscreen();
    const auto folder = scratchFolder();
    write(folder / "e.vert", "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n");
    write(folder / "e.frag",
          "#version 450 core\n#include \"generated\"\nout vec4 c;\nvoid main() { c = vec4(one()); }\n");
    const auto variant = [](std::size_t n) {
        return ProgramVariant{"e.vert", "e.frag", {}, "float one() { return " + std::to_string(n) + ".0; }\n"};
    };
    ShaderLibrary library(folder);
    for (const std::size_t n : {1u, 1u, 2u, 1u}) library.get(variant(n));
    EXPECT_EQ(library.compiled(), 2u);
    for (std::size_t n = 3; n < ShaderLibrary::kMostGenerated + 3; ++n) {
        library.get(variant(n));
        library.get(variant(1));
    }
    const std::size_t compiled = library.compiled();
    library.get(variant(1));
    EXPECT_EQ(library.compiled(), compiled) << "what is used often stays";
    library.get(variant(2));
    EXPECT_EQ(library.compiled(), compiled + 1);
    EXPECT_THAT(errorOf(folder, {"e.vert", "e.frag", {}, "float one() {\n    return nothing;\n}\n"}),
                HasSubstr("generated:2"));
}

TEST(ShaderLibrary, MissingAndOutsideFilesAreErrors) {
    const auto folder = scratchFolder();
    write(folder / "d.frag", "#version 450 core\n#include \"../secret.glsl\"\n");
    write(folder / ".." / "secret.glsl", "int secret;\n");
    EXPECT_THROW(loadShader(folder, "d.frag", {}), Error);
    EXPECT_THROW(loadShader(folder, "absent.frag", {}), Error);
    std::filesystem::remove(folder / ".." / "secret.glsl");
}

}  // namespace
}  // namespace voledit
