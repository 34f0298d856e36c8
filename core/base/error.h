#pragma once
// The one exception for what a user can mend.

#include <stdexcept>
#include <string>

namespace voledit {

/// Something that the user can mend: a file, a scene, a limit. The message names what failed, where (file and place
/// in it), the cause and the remedy. Caught in two places only: the editor's frame (a notice) and the command line's
/// `main` (standard error, exit status 1).
class Error : public std::runtime_error {
public:
    explicit Error(const std::string& message) : std::runtime_error(message) {}

    /// `where`: file, or file and JSON pointer; `what`: cause and what was expected; `remedy`: what to do.
    Error(const std::string& where, const std::string& what, const std::string& remedy)
        : std::runtime_error(where + ": " + what + (remedy.empty() ? "" : "; " + remedy)) {}
};

/// Thrown out of long work that its caller cancelled. Not an error: nothing is reported.
class Cancelled : public std::exception {
public:
    const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace voledit
