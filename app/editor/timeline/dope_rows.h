#pragma once
// The rows of the dope sheet: which values have keys, and where.

#include <string>
#include <vector>

#include "core/scene/compile.h"
#include "core/scene/keys.h"

namespace voledit {

/// A mark on a row: the keys that it stands for, all of one time.
struct DopeMark {
    double time = 0;           // seconds
    std::vector<KeyRef> keys;  // of one value, or of all values below
    Track::Interpolation interpolation = Track::Interpolation::Linear;
    bool mixed = false;  // the keys below are interpolated in several ways
};

struct DopeRow {
    enum class Kind : unsigned char { Summary, Node, Value, Motion };
    Kind kind = Kind::Value;
    std::string id;     // of a value its path, of a node its path (settings: "camera"), of a motion its asset
    std::string label;  // what stands at the left
    std::vector<DopeMark> marks;
    std::vector<ValuePath> values;  // that the row stands for
    bool open = false;              // of a node: its values are shown below
    double from = 0, to = 0;        // of a motion: what it covers, seconds
};

/// All keys in one row on top, then the animated values, each node's below its own, but for those of `closed`; last the
/// motions. Nothing but the summary where nothing is animated.
std::vector<DopeRow> dopeRows(const Scene& scene, const LoadedAssets& assets, const std::vector<std::string>& closed);

/// Equal times, as core/scene/keys.h counts them.
bool sameTime(double a, double b);
bool contains(const std::vector<KeyRef>& keys, const KeyRef& key);

/// What the user means by TRACK: a value's path, its label ("bend · angle"), or the last words of either ("angle").
/// nullopt where no value that has keys is meant.
std::optional<ValuePath> trackNamed(const Scene& scene, const std::string& name);

/// Times of the keys of `values` (empty: of all), ascending, each once.
std::vector<double> keyTimes(const Scene& scene, const std::vector<ValuePath>& values);

}  // namespace voledit
