#include "app/editor/renderer_choice.h"

#include "core/base/error.h"
#include "render/slice_plan.h"

namespace voledit {

std::string whySlicesCannotDraw(const TermPtr& root) {
    try {
        checkSlices(root);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace voledit
