#pragma once
// What a compilation made, found again by the values that it was made from.

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "core/scene/scene.h"
#include "core/skeleton/limb_regions.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

/// The inputs of a piece, laid flat: equal keys make equal pieces. Pieces, volumes and other shared things count by
/// their address; the key keeps them alive, so that no other thing can come to stand there.
class PieceKey {
public:
    /// `kind` tells what is made, hence its type; then its inputs, always as many and in the same order.
    template <class... Input>
    explicit PieceKey(std::string_view kind, const Input&... inputs) {
        add(std::string(kind));
        (add(inputs), ...);
    }

    /// One more input.
    template <class Input>
    void add(const Input& input) {
        if constexpr (kIsFlat<Input>)
            bytes_.append(reinterpret_cast<const char*>(&input), sizeof(Input));
        else
            addParts(input);
    }

    const std::string& bytes() const { return bytes_; }
    const std::vector<std::shared_ptr<const void>>& owners() const { return owners_; }

private:
    /// Types whose bytes are their value: no padding, nothing unset (an empty optional has both).
    template <class T>
    static constexpr bool kIsFlat =
        std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_pointer_v<T> || std::is_same_v<T, Vec2> ||
        std::is_same_v<T, Vec3> || std::is_same_v<T, Mat3> || std::is_same_v<T, Mat4> || std::is_same_v<T, Index3> ||
        std::is_same_v<T, Box3> || std::is_same_v<T, Frame> || std::is_same_v<T, LineValue> ||
        std::is_same_v<T, ColorTable::Point> || std::is_same_v<T, PosedJoint>;

    void addParts(const std::string& text) {
        add(text.size());
        bytes_ += text;
    }
    template <class T>
    void addParts(const std::shared_ptr<const T>& shared) {
        add(static_cast<const void*>(shared.get()));
        owners_.push_back(shared);
    }
    template <class T>
    void addParts(const std::vector<T>& list) {
        add(list.size());
        for (const T& element : list) add(element);
    }
    void addParts(const Limb& limb) {
        add(limb.name);
        add(limb.from);
        add(limb.to);
        add(limb.size);
        add(limb.offset);
        add(limb.roll);
        add(limb.pad);
    }
    template <class Key, class Value>
    void addParts(const std::map<Key, Value>& map) {
        add(map.size());
        for (const auto& [key, value] : map) {
            add(key);
            add(value);
        }
    }
    template <class T, std::size_t n>
    void addParts(const std::array<T, n>& list) {
        for (const T& element : list) add(element);
    }
    template <class T>
    void addParts(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }
    template <class T>
    void addParts(const Tracked<T>& value) {
        add(*value);
    }
    template <class First, class Second>
    void addParts(const std::pair<First, Second>& pair) {
        add(pair.first);
        add(pair.second);
    }
    template <class... Kind>
    void addParts(const std::variant<Kind...>& value) {
        add(value.index());
        std::visit([this](const auto& kind) { add(kind); }, value);
    }
    void addParts(const PiecewiseLinear& table) { add(table.points); }
    void addParts(const ColorTable& table) { add(table.points); }
    void addParts(const Appearance& appearance) {
        add(appearance.preset);
        add(appearance.color);
        add(appearance.opacity);
        add(appearance.gradientOpacity);
    }

    std::string bytes_;
    std::vector<std::shared_ptr<const void>> owners_;
};

/// Pieces by key.
class Pieces {
public:
    /// Null where there is none. The key's kind must say that it is a T.
    template <class T>
    std::shared_ptr<const T> find(const PieceKey& key) const {
        const auto found = made_.find(key.bytes());
        return found == made_.end() ? nullptr : std::static_pointer_cast<const T>(found->second.piece);
    }
    template <class T>
    void insert(const PieceKey& key, const std::shared_ptr<const T>& piece) {
        made_.emplace(key.bytes(), Entry{piece, key.owners()});
    }

private:
    struct Entry {
        std::shared_ptr<const void> piece;
        std::vector<std::shared_ptr<const void>> owners;
    };
    std::unordered_map<std::string, Entry> made_;
};

}  // namespace voledit
