#include "app/io/module_loader.h"

#include <dlfcn.h>

#include "app/io/limits.h"
#include "core/base/error.h"
#include "core/base/paths.h"

namespace voledit {

void* moduleSymbol(const char* module, const char* name) {
    // Libraries map much address space that they do not use.
    const MemoryLimitLifted lifted;
    void* handle = dlopen((programFolder() / module).c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = handle ? dlsym(handle, name) : nullptr;
    if (!symbol)
        throw Error(module, "cannot be opened (" + std::string(dlerror()) + ")",
                    "install it beside voledit-io, with the libraries it needs");
    return symbol;
}

}  // namespace voledit
