#include "core/base/paths.h"

#include <cstdlib>

namespace voledit {

namespace {
std::filesystem::path find(const char* variable, const char* installed, const char* source) {
    if (const char* set = std::getenv(variable)) return set;
    const auto beside = programFolder() / ".." / "share" / "voledit" / installed;
    std::error_code ignored;
    return std::filesystem::is_directory(beside, ignored) ? beside : std::filesystem::path(source);
}
}  // namespace

std::filesystem::path programFolder() {
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::filesystem::path resourceFolder() {
    return find("VOLEDIT_RESOURCES", "resources", VOLEDIT_SOURCE_RESOURCES);
}

std::filesystem::path shaderFolder() {
    return find("VOLEDIT_SHADERS", "shaders", VOLEDIT_SOURCE_SHADERS);
}

}  // namespace voledit
