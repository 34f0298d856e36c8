#pragma once
// What a formula file (resources/transfers/NAME.stf, or a user's) defines: parameters, formulas, image. The inspector,
// the docs and the evaluators are all made from it. The format stands in resources/transfers/README.md.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/stf/formula_map.h"

namespace voledit {

/// `line` of insideOut and rotationalSweep.
struct LineValue {
    Vec3 point{0};
    Vec3 direction{0, 0, 1};
    bool operator==(const LineValue&) const = default;
};

/// A parameter's value as a scene gives it: one number, or two (a range, taper's scale), or three (a vector); axes as
/// numbers 0, 1, 2 in `axes` (one for an axis, several for a list).
using TransferArgument = std::variant<std::vector<double>, LineValue, std::vector<int>>;

struct TransferParameter {
    enum class Kind : std::uint8_t { Number, Pair, Vector, Line, Axis, Axes };
    std::string name;
    Kind kind = Kind::Number;
    std::string unit;  // "" (normalised or a ratio), "degrees", "length" (world units), "position" (world coordinates)
    std::string description;                  // one line
    std::optional<TransferArgument> initial;  // what a missing member means; nullopt: required
    /// What the editor starts with. Where it is not `initial`, lengths are in sides of the operand's box and positions
    /// in its normalised coordinates: see suggestedFor.
    TransferArgument suggested;
    bool uniform = false;  // a vector for which one number may stand, meaning three equal ones
    /// Allowed values of each number, and the range of the editor's slider within it; see sliderFor.
    Interval allowed;
    Interval slider{0, 1};
    bool strength = false;  // `amount` multiplies it (definitions.md §3.1); several may be
    double identity = 0;    // what the strength is at amount 0: value = identity + amount · (value − identity)
};

/// What the editor starts with, for an operand within `box`: `suggested`, in world units.
TransferArgument suggestedFor(const TransferParameter& parameter, const Box3& box);
/// The slider's range for an operand within `box`, in the units of files (degrees, world units).
Interval sliderFor(const TransferParameter& parameter, const Box3& box);

/// "at least 0 and below 1", "any number".
std::string allowedInWords(const Interval& allowed);

/// A formula file, read and checked. Immutable.
class TransferDefinition {
public:
    /// `file` names it in errors; `name` is what scenes call it. Throws FormulaError or Error.
    static std::shared_ptr<const TransferDefinition> parse(const std::string& text, const std::string& name,
                                                           const std::string& file);
    /// Reads at most 1 MiB. Throws Error.
    static std::shared_ptr<const TransferDefinition> load(const std::filesystem::path& file);

    const std::string& name() const { return name_; }                // "twist"
    const std::string& title() const { return title_; }              // "Twist"
    const std::string& description() const { return description_; }  // one line
    const std::string& source() const { return source_; }            // paper, equation
    const std::vector<TransferParameter>& parameters() const { return parameters_; }
    const TransferParameter* find(const std::string& parameter) const;
    bool usesFrame() const { return usesFrame_; }      // false: world coordinates only (insideOut, deflect …)
    bool usesOutside() const { return usesOutside_; }  // a bounded STF (definitions.md §3.2, Domain)
    /// All formulas as written: (what it is, text), those of the map first, then "check …" and "image …".
    const std::vector<std::pair<std::string, std::string>>& formulas() const { return formulas_; }

    /// What an application of it needs.
    struct Use {
        std::map<std::string, TransferArgument> arguments;  // missing ones take `initial`
        Frame frame;
        Outside outside = Outside::Hide;
        double amount = 1;
        double time = 0;  // seconds, `t`
    };
    /// Throws Error that names the parameter for a missing, unknown, ill-formed or forbidden value. `warning`, where
    /// not null, takes what is allowed but odd (deflect folds).
    TransferPtr make(const Use& use, std::string* warning = nullptr) const;

    struct Formulas;  // transfer_definition.cpp

private:
    TransferDefinition() = default;
    std::string name_, title_, description_, source_;
    std::vector<TransferParameter> parameters_;
    bool usesFrame_ = true, usesOutside_ = false;
    std::vector<std::pair<std::string, std::string>> formulas_;
    std::shared_ptr<const Formulas> compiled_;
};

using TransferDefinitionPtr = std::shared_ptr<const TransferDefinition>;

/// The library: all of resources/transfers, sorted by name; read once. Throws Error where a file is wrong.
const std::vector<TransferDefinitionPtr>& transferLibrary();
/// Null where the library has no such name.
TransferDefinitionPtr libraryTransfer(const std::string& name);

/// `expression` of a scene.
struct ExpressionUse {
    std::vector<FormulaLet> lets;
    FormulaText x, y, z;
    std::optional<FormulaText> undefined;
    bool world = false;  // else normalised coordinates of `frame`
    Frame frame;
    std::optional<Frame> image;  // that the image lies in; else the operand's box
    double time = 0;
};
/// Throws FormulaError.
TransferPtr makeExpressionMap(const ExpressionUse& use);

}  // namespace voledit
