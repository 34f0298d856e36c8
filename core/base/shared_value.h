#pragma once
// A value that is cheap to copy however big it is.

#include <memory>
#include <utility>

namespace voledit {

/// An immutable T behind a shared pointer that behaves as a value: copies share, comparison is by value (at once when
/// the two share), `edit` copies first where somebody else shares. It also lets a type hold itself (scene nodes do).
template <class T>
class SharedValue {
public:
    SharedValue() : value_(std::make_shared<T>()) {}
    SharedValue(T value) : value_(std::make_shared<T>(std::move(value))) {}  // NOLINT: implicit, as values are

    const T& operator*() const { return *value_; }
    const T* operator->() const { return value_.get(); }

    /// The value for changing; unshared first if need be.
    T& edit() {
        if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
        return *value_;
    }

    /// True if both are one object in memory, hence equal.
    bool sharesWith(const SharedValue& other) const { return value_ == other.value_; }

    friend bool operator==(const SharedValue& a, const SharedValue& b) {
        return a.value_ == b.value_ || *a.value_ == *b.value_;
    }

private:
    std::shared_ptr<T> value_;
};

}  // namespace voledit
