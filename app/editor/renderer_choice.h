#pragma once
// What slices can draw, found out without OpenGL.

#include <string>

#include "core/objects/term.h"

namespace voledit {

/// Why slices cannot draw the term, with a remedy behind the last "; "; empty where they can. A GPU may still refuse
/// it, for its size.
std::string whySlicesCannotDraw(const TermPtr& root);

}  // namespace voledit
