#pragma once
// Opens a module's shared libraries when its format is met.

namespace voledit {

/// The function `name` of the module file `module`, which lies beside this program. Throws Error where it cannot be
/// opened.
void* moduleSymbol(const char* module, const char* name);

/// As above, with its type.
template <class Function>
Function* moduleFunction(const char* module, const char* name) {
    return reinterpret_cast<Function*>(moduleSymbol(module, name));
}

}  // namespace voledit
