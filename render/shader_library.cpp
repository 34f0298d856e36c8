#include "render/shader_library.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "core/base/error.h"

namespace voledit {

namespace {

void append(ShaderSource& source, const std::filesystem::path& folder, const std::string& file,
            const std::vector<std::string>* defines, const std::string& generated) {
    if (std::find(source.files.begin(), source.files.end(), file) != source.files.end()) return;
    const int number = int(source.files.size());
    source.files.push_back(file);
    if (!defines && file == "generated") {
        source.text += "#line 1 " + std::to_string(number) + "\n" + generated;
        return;
    }
    std::ifstream in(folder / file);
    if (!in || file.find("..") != std::string::npos)
        throw Error((folder / file).string(), "this shader cannot be read", "install voledit's shaders again");

    static const std::regex include(R"(^\s*#include\s+\"([^\"]+)\"\s*$)");
    const auto place = [&](int line) {
        source.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
    };
    if (!defines) place(1);
    std::string line;
    for (int n = 1; std::getline(in, line); ++n) {
        std::smatch match;
        if (std::regex_match(line, match, include)) {
            append(source, folder, match[1], nullptr, generated);
            place(n + 1);
        } else {
            source.text += line + "\n";
            if (defines && line.starts_with("#version")) {
                for (const std::string& d : *defines) {
                    const auto equals = d.find('=');
                    source.text += "#define " + d.substr(0, equals) + " " +
                                   (equals == std::string::npos ? "1" : d.substr(equals + 1)) + "\n";
                }
                place(n + 1);
            }
        }
    }
}

/// Drivers write "FILE:LINE(COLUMN): …" or "FILE(LINE): …", FILE being #line's number.
std::string withFileNames(const std::string& log, const std::vector<std::string>& files) {
    std::istringstream in(log);
    std::string result, line;
    static const std::regex place(R"(^(ERROR: |WARNING: )?(\d+)([:(])(\d+)(.*)$)");
    while (std::getline(in, line)) {
        std::smatch match;
        if (std::regex_match(line, match, place) && std::stoul(match[2]) < files.size())
            line = "shaders/" + files[std::stoul(match[2])] + match[3].str() + match[4].str() + match[5].str();
        result += line + "\n";
    }
    return result;
}

GLuint compileStage(GLenum stage, const ShaderSource& source) {
    const GLuint shader = glCreateShader(stage);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint good = 0, length = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    glDeleteShader(shader);
    throw Error("a shader does not compile:\n" + withFileNames(log.c_str(), source.files));
}

}  // namespace

ShaderSource loadShader(const std::filesystem::path& folder, const std::string& file,
                        const std::vector<std::string>& defines, const std::string& generated) {
    ShaderSource source;
    append(source, folder, file, &defines, generated);
    return source;
}

ShaderLibrary::ShaderLibrary(std::filesystem::path folder) : folder_(std::move(folder)) {}

Program& ShaderLibrary::get(const ProgramVariant& variant) {
    const auto found = programs_.find(variant);
    if (found != programs_.end()) {
        found->second.lastUse = ++uses_;
        return found->second.program;
    }
    if (!variant.generated.empty()) dropOldest();
    Program program = compile(variant);
    ++compiled_;
    return programs_.emplace(variant, Kept{std::move(program), ++uses_}).first->second.program;
}

void ShaderLibrary::dropOldest() {
    auto oldest = programs_.end();
    std::size_t count = 0;
    for (auto at = programs_.begin(); at != programs_.end(); ++at) {
        if (at->first.generated.empty()) continue;
        ++count;
        if (oldest == programs_.end() || at->second.lastUse < oldest->second.lastUse) oldest = at;
    }
    if (count >= kMostGenerated) programs_.erase(oldest);
}

Program ShaderLibrary::compile(const ProgramVariant& variant) {
    const ShaderSource vertexSource = loadShader(folder_, variant.vertex, variant.defines);
    const ShaderSource fragmentSource = loadShader(folder_, variant.fragment, variant.defines, variant.generated);
    const GLuint vertex = compileStage(GL_VERTEX_SHADER, vertexSource);
    GLuint fragment = 0;
    try {
        fragment = compileStage(GL_FRAGMENT_SHADER, fragmentSource);
    } catch (const Error&) {
        glDeleteShader(vertex);
        throw;
    }
    Program program(glCreateProgram());
    for (const GLuint shader : {vertex, fragment}) {
        glAttachShader(program.name(), shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program.name());
    GLint good = 0, length = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
    if (!good) {
        glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
        std::string log(std::size_t(std::max(length, 1)), '\0');
        glGetProgramInfoLog(program.name(), length, nullptr, log.data());
        throw Error("shaders/" + variant.vertex + " and shaders/" + variant.fragment + " do not link:\n" + log.c_str());
    }
    return program;
}

}  // namespace voledit
