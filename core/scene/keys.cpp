#include "core/scene/keys.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/scene/scene_children.h"
#include "core/scene/scene_walk.h"
#include "core/scene/value_labels.h"
#include "core/scene/when.h"

namespace voledit {

namespace {

// ---- A value by its numbers -----------------------------------------------------------------------------------------

/// What any tracked value is, whatever its type.
struct Channel {
    std::vector<double> numbers;  // without tracks; with them, of the first keys
    std::vector<PartTrack> tracks;
};

template <class T>
Channel channelOf(const Tracked<T>& value) {
    return {numbersOf(*value), value.tracks()};
}

template <class T>
void assign(Tracked<T>& value, Channel channel) {
    T plain;
    setNumbers(plain, channel.numbers);
    value = std::move(plain);
    value.setTracks(std::move(channel.tracks));
}

/// Calls use(name, part) on `value`, or on the parts of a frame; const where `value` is. `use` gives whether it changed
/// the part.
template <class Value, class Use>
void forEachPart(const ValueName& name, Value& value, const Use& use) {
    if constexpr (std::is_same_v<std::remove_const_t<Value>, TrackedFrame>) {
        TrackedFrame::Form form = formOf(value);
        bool changed = false;
        if (auto* box = std::get_if<TrackedBox>(&form)) {
            changed = use(name.in("min"), box->min);
            changed = use(name.in("max"), box->max) || changed;
        } else {
            auto& oblique = std::get<TrackedFrame::Oblique>(form);
            changed = use(name.in("corner"), oblique.corner);
            static constexpr std::string_view kEdges[] = {"x", "y", "z"};
            for (std::size_t a = 0; a < 3; ++a) changed = use(name.in(kEdges[a]), oblique.edge[a]) || changed;
        }
        if constexpr (!std::is_const_v<Value>)
            if (changed) value = TrackedFrame(form);
    } else {
        use(name, value);
    }
}

// ---- Where values stand ---------------------------------------------------------------------------------------------

/// Calls visit(name, value) on all values of `node`, frames in their parts.
template <class Node, class Use>
void forEachValueOf(Node& node, const Use& use) {
    visitTracked(node, [&](const ValueName& name, auto& value) { forEachPart(name, value, use); });
}
template <class SceneType, class Use>
void forEachSetting(SceneType& scene, const Use& use) {
    visitTrackedSettings(scene, [&](const ValueName& name, auto& value) { forEachPart(name, value, use); });
}

/// Calls use(node) on the node at `path`; false where there is none.
template <class Use>
bool atNode(const Scene& scene, const NodePath& path, const Use& use) {
    if (const Object* object = findObjectAt(scene, path)) return use(*object), true;
    if (const Transfer* transfer = findTransferAt(scene, path)) return use(*transfer), true;
    if (const Displacement* displacement = findDisplacementAt(scene, path)) return use(*displacement), true;
    if (const Field* field = findFieldAt(scene, path)) return use(*field), true;
    return false;
}

/// Calls use(node path, label, value) on the value at `path`; false where there is none.
template <class Use>
bool withValue(const Scene& scene, const ValuePath& path, const Use& use) {
    bool found = false;
    const auto look = [&](const NodePath& node, std::string_view name) {
        return [&, node, name](const ValueName& of, const auto& value) {
            if (!found && of.is(name)) {
                found = true;
                use(node, of, value);
            }
            return false;
        };
    };
    for (std::size_t end = path.size(); end != std::string::npos && end > 0 && !found; end = path.rfind('/', end - 1)) {
        const NodePath node = path.substr(0, end);
        const std::string_view name = std::string_view(path).substr(end);
        atNode(scene, node, [&](const auto& at) { forEachValueOf(at, look(node, name)); });
    }
    if (!found) forEachSetting(scene, look("", path));
    return found;
}

[[noreturn]] void failMissing(const ValuePath& path) {
    throw Error(path, "the scene has no value there that may have keys", "it may have been removed");
}

/// Lets change(channel) edit the value at `path`. Throws Error where there is none.
void editValue(Scene& scene, const ValuePath& path, const std::function<void(Channel&)>& change) {
    NodePath node;
    if (!withValue(scene, path, [&](const NodePath& at, const ValueName&, const auto&) { node = at; }))
        failMissing(path);
    const std::string_view name = std::string_view(path).substr(node.size());
    const auto edit = [&](const ValueName& of, auto& value) {
        if (!of.is(name)) return false;
        Channel channel = channelOf(value);
        change(channel);
        assign(value, std::move(channel));
        return true;
    };
    const auto editNode = [&](auto& at) { forEachValueOf(at, edit); };
    if (node.empty())
        forEachSetting(scene, edit);
    else if (findObjectAt(scene, node))
        editObjectAt(scene, node, editNode);
    else if (findTransferAt(scene, node))
        editTransferAt(scene, node, editNode);
    else if (findDisplacementAt(scene, node))
        editDisplacementAt(scene, node, editNode);
    else
        editFieldAt(scene, node, editNode);
}

template <class T>
KeyableValue keyable(const Scene& scene, const NodePath& node, const ValueName& name, const Tracked<T>& value) {
    return {node + name.pointer(), node, valueLabel(scene, node, name), numbersOf(*value), value.animated()};
}

// ---- Keys -----------------------------------------------------------------------------------------------------------

bool sameTime(double a, double b) {
    return std::abs(a - b) <= kSameKeyTime;
}

void checkTime(const ValuePath& path, double t) {
    if (!std::isfinite(t)) throw Error(path, "a key's time is not finite", "give it in seconds");
}

void putKey(Channel& channel, double t, std::vector<double> numbers) {
    if (channel.tracks.empty()) {
        channel.numbers = numbers;
        channel.tracks = {{PartTrack::kWhole, {{{t, std::move(numbers)}}}}};
        return;
    }
    for (const PartTrack& part : channel.tracks)
        for (const auto& key : part.track.keys)
            if (sameTime(key.time, t)) t = key.time;
    channel.numbers = numbers;
    setKeysAt(channel.tracks, numbers, t);
}

/// Numbers that `part` sets become `value`.
void setPart(std::vector<double>& numbers, int part, const std::vector<double>& value) {
    if (part == PartTrack::kWhole)
        numbers = value;
    else
        std::copy(value.begin(), value.end(), numbers.begin() + part);
}

/// The keys of `track` that stand at one of `times`, moved by `delta`.
std::vector<Track::Key> takenAt(const Track& track, const std::vector<double>& times, double delta) {
    std::vector<Track::Key> taken;
    for (const auto& key : track.keys)
        if (std::any_of(times.begin(), times.end(), [&](double t) { return sameTime(t, key.time); })) {
            taken.push_back(key);
            taken.back().time += delta;
        }
    return taken;
}

/// Moves or copies the keys at `times`.
void moveKeysOf(Track& track, const std::vector<double>& times, double delta, bool copy) {
    const std::vector<Track::Key> moved = takenAt(track, times, delta);
    if (!copy)
        std::erase_if(track.keys, [&](const auto& key) {
            return std::any_of(times.begin(), times.end(), [&](double t) { return sameTime(t, key.time); });
        });
    std::erase_if(track.keys, [&](const auto& key) {
        return std::any_of(moved.begin(), moved.end(), [&](const auto& m) { return sameTime(m.time, key.time); });
    });
    track.keys.insert(track.keys.end(), moved.begin(), moved.end());
    std::stable_sort(track.keys.begin(), track.keys.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
}

}  // namespace

std::vector<KeyableValue> animatedValues(const Scene& scene) {
    std::vector<KeyableValue> values;
    const auto collect = [&](const NodePath& node) {
        return [&, node](const ValueName& name, const auto& value) {
            if (value.animated()) values.push_back(keyable(scene, node, name, value));
            return false;
        };
    };
    forEachNode(scene, [&](const NodePath& path, const NodePointer& node) {
        std::visit([&](const auto* at) { forEachValueOf(*at, collect(path)); }, node);
    });
    forEachSetting(scene, collect(""));
    return values;
}

std::vector<KeyMark> keysOf(const Scene& scene, const ValuePath& path) {
    std::vector<KeyMark> marks;
    withValue(scene, path, [&](const NodePath&, const ValueName&, const auto& value) {
        for (const PartTrack& part : value.tracks())
            for (std::size_t k = 0; k < part.track.keys.size(); ++k)
                marks.push_back({part.track.keys[k].time, part.track.interpolationFrom(k)});
    });
    std::stable_sort(marks.begin(), marks.end(), [](const KeyMark& a, const KeyMark& b) { return a.time < b.time; });
    // Of keys at one time the last says how its track goes on.
    std::vector<KeyMark> merged;
    for (const KeyMark& mark : marks)
        if (!merged.empty() && sameTime(merged.back().time, mark.time))
            merged.back().interpolation = mark.interpolation;
        else
            merged.push_back(mark);
    return merged;
}

std::optional<KeyableValue> valueAt(const Scene& scene, const ValuePath& path) {
    std::optional<KeyableValue> found;
    withValue(scene, path, [&](const NodePath& node, const ValueName& name, const auto& value) {
        found = keyable(scene, node, name, value);
    });
    return found;
}

std::vector<KeyableValue> valuesOf(const Scene& scene, const NodePath& node) {
    std::vector<KeyableValue> values;
    const auto collect = [&](const ValueName& name, const auto& value) {
        values.push_back(keyable(scene, node, name, value));
        return false;
    };
    if (node.empty())
        forEachSetting(scene, collect);
    else
        atNode(scene, node, [&](const auto& at) { forEachValueOf(at, collect); });
    return values;
}

std::vector<double> numbersAt(const Scene& scene, const ValuePath& path, double t) {
    std::vector<double> numbers;
    if (!withValue(scene, path,
                   [&](const NodePath&, const ValueName&, const auto& value) { numbers = numbersOf(value.at(t)); }))
        failMissing(path);
    return numbers;
}

void setKey(Scene& scene, const ValuePath& path, double t) {
    setKey(scene, path, t, numbersAt(scene, path, t));
}

void setKey(Scene& scene, const ValuePath& path, double t, const std::vector<double>& numbers) {
    checkTime(path, t);
    editValue(scene, path, [&](Channel& channel) {
        if (numbers.size() != channel.numbers.size())
            throw Error(path,
                        "it has " + std::to_string(channel.numbers.size()) + " numbers, the key " +
                            std::to_string(numbers.size()),
                        "give as many");
        putKey(channel, t, numbers);
    });
}

void removeKey(Scene& scene, const ValuePath& path, double t) {
    editValue(scene, path, [&](Channel& channel) {
        for (auto& [part, track] : channel.tracks) {
            const std::vector<double> last = track.keys.back().value;
            std::erase_if(track.keys, [&](const auto& key) { return sameTime(key.time, t); });
            if (track.keys.empty()) setPart(channel.numbers, part, last);
        }
        std::erase_if(channel.tracks, [](const PartTrack& part) { return part.track.keys.empty(); });
    });
}

void clearKeys(Scene& scene, const ValuePath& path, double t) {
    const std::vector<double> now = numbersAt(scene, path, t);
    editValue(scene, path, [&](Channel& channel) { channel = {now, {}}; });
}

std::vector<KeyRef> moveKeys(Scene& scene, const std::vector<KeyRef>& keys, double delta, bool copy) {
    std::map<ValuePath, std::vector<double>> times;
    for (const KeyRef& key : keys) {
        checkTime(key.path, key.time + delta);
        times[key.path].push_back(key.time);
    }
    Scene moved = scene;
    for (const auto& [path, ofPath] : times)
        editValue(moved, path, [&, &of = ofPath](Channel& channel) {
            for (auto& [part, track] : channel.tracks) moveKeysOf(track, of, delta, copy);
        });
    std::vector<KeyRef> result;
    for (const KeyRef& key : keys) {
        const auto marks = keysOf(scene, key.path);
        if (std::any_of(marks.begin(), marks.end(), [&](const KeyMark& mark) { return sameTime(mark.time, key.time); }))
            result.push_back({key.path, key.time + delta});
    }
    scene = std::move(moved);
    return result;
}

void setInterpolation(Scene& scene, const KeyRef& ref, Track::Interpolation interpolation) {
    editValue(scene, ref.path, [&](Channel& channel) {
        for (auto& [part, track] : channel.tracks)
            for (auto& key : track.keys)
                if (sameTime(key.time, ref.time)) {
                    key.interpolation = interpolation;
                    if (interpolation == track.interpolation) key.interpolation.reset();
                }
    });
}

void setTimeline(Scene& scene, const Timeline& timeline) {
    if (!(std::isfinite(timeline.fps) && timeline.fps > 0))
        throw Error("timeline", "its frame rate is not above 0", "give frames a second, such as 24");
    if (timeline.end <= timeline.start)
        throw Error("timeline",
                    "it ends at frame " + std::to_string(timeline.end) + ", not after its start at " +
                        std::to_string(timeline.start),
                    "`end` is exclusive: make it at least start + 1");
    scene.timeline = timeline;
}

}  // namespace voledit
