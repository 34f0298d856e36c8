#pragma once
// Arguments of actions that render: a path, which may have spaces, and words behind it.

#include <string>

#include "core/base/types.h"

namespace voledit {

/// Takes the last word of `text` off where it is one of the regular expression `pattern` and something stands before
/// it; else gives nothing.
std::string takeLastWord(std::string& text, const char* pattern);

/// Takes a last word "WxH" off; `otherwise` where there is none. Throws Error for a size that no picture has; `action`
/// names what asked.
Index2 takeLastSize(std::string& text, Index2 otherwise, const std::string& action);

}  // namespace voledit
